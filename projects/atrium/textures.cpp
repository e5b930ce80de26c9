// SPDX-License-Identifier: MIT
#include "projects/atrium/atrium.h"
#include "projects/png_writer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

namespace limn::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kSize = 512;

// A number in [0, 1) for each integer pair (lowbias32 of Chris Wellons).
double hashed(std::uint32_t x, std::uint32_t y) {
    std::uint32_t h = x * 0x9e3779b9u ^ (y + 0x7f4a7c15u) * 0x85ebca6bu;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return double(h ^ (h >> 16)) / 4294967296.0;
}

// Smooth noise in [0, 1] over the unit square, `cells` across, without a seam.
double noise(dvec2 p, int cells, std::uint32_t seed) {
    const dvec2 q = p * double(cells), base = glm::floor(q);
    const dvec2 f = (q - base) * (q - base) * (3.0 - 2.0 * (q - base));
    const auto value = [&](int dx, int dy) {
        const auto wrap = [&](int i) { return std::uint32_t((i % cells + cells) % cells); };
        return hashed(wrap(int(base.x) + dx) + 1000u * seed, wrap(int(base.y) + dy));
    };
    return glm::mix(glm::mix(value(0, 0), value(1, 0), f.x),
                    glm::mix(value(0, 1), value(1, 1), f.x), f.y);
}

double cloudiness(dvec2 p, int cells, std::uint32_t seed) {
    double sum = 0, weight = 0.5;
    for (int octave = 0; octave < 5; ++octave, cells *= 2, weight /= 2)
        sum += weight * noise(p, cells, seed + std::uint32_t(octave));
    return sum / 0.96875;
}

// The curve of sRGB, quantised.
unsigned char encoded(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<unsigned char>(std::lround(s * 255));
}

// Marble squares of half a metre, each with a lozenge of the other stone, in dark joints. 2 m
// across.
dvec3 paving(dvec2 p) {
    const dvec2 tile = p * 4.0, cell = glm::floor(tile), q = glm::abs(tile - cell - 0.5);
    const bool light = (int(cell.x) + int(cell.y)) % 2 == 0;
    const double veins = 1 - std::abs(2 * cloudiness(p, 6, light ? 3 : 40) - 1);
    const double tone = 0.85 + 0.3 * hashed(std::uint32_t(cell.x), std::uint32_t(cell.y) + 7u);
    const dvec3 cream = dvec3(0.66, 0.58, 0.46), grey = dvec3(0.34, 0.31, 0.28),
                red = dvec3(0.36, 0.12, 0.08);
    dvec3 colour = (light ? cream : grey) * tone;
    if (q.x + q.y < 0.2)
        colour = light ? red : cream;
    colour *= 1 - 0.35 * std::pow(veins, 6) - 0.1 * cloudiness(p, 24, 80);
    const double joint = std::max(q.x, q.y);
    return joint > 0.487 ? dvec3(0.16, 0.14, 0.12) : colour;
}

// Courses of ashlar, every other one shifted by half a block. 2.4 m across: 3 blocks, 6 courses.
dvec3 ashlar(dvec2 p) {
    const double course = std::floor(p.y * 6);
    const double shifted = p.x * 3 + (int(course) % 2 == 0 ? 0 : 0.5), block = std::floor(shifted);
    const dvec2 q = glm::abs(dvec2(shifted - block, p.y * 6 - course) - 0.5);
    const double tone =
        0.86 + 0.2 * hashed(std::uint32_t(int(block) % 3) + 11u, std::uint32_t(course));
    const double warmth = hashed(std::uint32_t(int(block) % 3) + 29u, std::uint32_t(course));
    const dvec3 stone = glm::mix(dvec3(0.62, 0.53, 0.41), dvec3(0.66, 0.54, 0.38), warmth) * tone;
    const double rough = 0.82 + 0.24 * cloudiness(p, 12, 200) - 0.1 * noise(p, 128, 300);
    const bool joint = q.x > 0.5 - 0.008 || q.y > 0.5 - 0.016;
    return joint ? dvec3(0.4, 0.34, 0.27) : stone * rough;
}

bool writeColour(const std::string& path, dvec3 (*colour)(dvec2)) {
    std::vector<unsigned char> pixels;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const dvec3 c = colour(dvec2(x + 0.5, y + 0.5) / double(kSize));
            pixels.insert(pixels.end(), {encoded(c.x), encoded(c.y), encoded(c.z)});
        }
    return writePng(path, kSize, kSize, 3, pixels);
}

// Gold tassels under a band; alpha is 0 between them.
bool writeFringe(const std::string& path) {
    constexpr int width = 128, height = 128, tassels = 4;
    std::vector<unsigned char> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double t = (y + 0.5) / height,
                         across = std::abs(std::fmod((x + 0.5) * tassels / width, 1.0) - 0.5);
            const double length = 0.9 - 0.1 * hashed(std::uint32_t(x / 3), 5);
            const bool cloth = t < 0.22 || (across < 0.14 + 0.2 * t && t < length);
            const double shade = 0.75 + 0.5 * (0.5 - across) * hashed(std::uint32_t(x), 9);
            pixels.insert(pixels.end(),
                          {encoded(0.75 * shade), encoded(0.48 * shade), encoded(0.12 * shade),
                           static_cast<unsigned char>(cloth ? 255 : 0)});
        }
    return writePng(path, width, height, 4, pixels);
}

} // namespace

bool writeTextures(const std::string& folder) {
    return writeColour(folder + "/paving.png", paving) &&
           writeColour(folder + "/stone.png", ashlar) && writeFringe(folder + "/fringe.png");
}

} // namespace limn::atrium
