// SPDX-License-Identifier: MIT
// Writes signs.gltf, signs.bin and two animated textures: a room like Cornell's that only moving
// pictures light, four turning asterisks on the walls and a ring under the ceiling, round which a
// spark runs. After Figure 7 of "Jendersie, Kuri, Grosch. Real-Time Global Illumination Using
// Precomputed Illuminance Composition with Chrominance Compression. 2016".
#include "projects/gltf_writer.h"
#include "projects/png_writer.h"
#include "projects/wall.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace {

using namespace limn;
using glm::dvec2;
using glm::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr int kColumns = 8, kRows = 4, kFrames = kColumns * kRows;
constexpr int kFrameSize = 64; // a power of two: mips mix no frames until they are one texel
constexpr double kRoom = 5.6;  // [m], a cube on y = 0 about the y axis

enum Material : std::uint32_t { White, Red, Green, Ring, Asterisk }; // and three more of the last

double smooth(double edge, double width, double x) {
    return glm::smoothstep(edge - width, edge + width, x);
}

// Six arms, a sixth of a turn in all frames, so that the loop closes. `p` in [-1, 1]^2.
double asterisk(dvec2 p, double time) {
    const double r = glm::length(p), arm = kPi / 3;
    const double angle = std::atan2(p.y, p.x) - time * arm;
    const double off = angle - arm * std::round(angle / arm); // from the nearest arm's middle
    const double across = std::abs(std::sin(off)) * r;
    return (1 - smooth(0.12, 0.03, across)) * (1 - smooth(0.85, 0.03, r));
}

// Dim all round, and a bright spark with a tail of a quarter of the ring.
double ring(dvec2 p, double time) {
    const double r = glm::length(p);
    const double behind = time - std::atan2(p.y, p.x) / (2 * kPi);
    const double tail = std::exp(-8 * (behind - std::floor(behind)));
    return (0.06 + 0.94 * tail) * (1 - smooth(0.16, 0.03, std::abs(r - 0.7)));
}

bool writeFlipbook(const std::string& path, const std::function<double(dvec2, double)>& picture) {
    std::vector<unsigned char> pixels;
    for (int y = 0; y < kRows * kFrameSize; ++y)
        for (int x = 0; x < kColumns * kFrameSize; ++x) {
            const int frame = y / kFrameSize * kColumns + x / kFrameSize;
            const dvec2 p =
                (dvec2(x % kFrameSize, y % kFrameSize) + 0.5) * 2.0 / double(kFrameSize);
            const double v = picture(p - 1.0, double(frame) / kFrames);
            const double encoded =
                v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
            pixels.insert(pixels.end(), 3, static_cast<unsigned char>(std::lround(255 * encoded)));
        }
    return writePng(path, kColumns * kFrameSize, kRows * kFrameSize, 3, pixels);
}

// A square about `centre` with `right` and `up` half its edges, its front towards right x up, its
// picture upright.
Mesh panel(const std::string& name, std::uint32_t material, dvec3 centre, dvec3 right, dvec3 up) {
    Mesh mesh = wall(name, material, centre, right, up);
    mesh.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    return mesh;
}

Mesh block(const char* name, dvec3 centre, dvec3 half, double turn) {
    Mesh mesh{.name = name, .material = White};
    const dvec3 x(std::cos(turn) * half.x, 0, -std::sin(turn) * half.x), y(0, half.y, 0),
        z(std::sin(turn) * half.z, 0, std::cos(turn) * half.z);
    const auto face = [&](dvec3 out, dvec3 right, dvec3 up) {
        const dvec3 c = centre + out;
        addQuad(mesh, c - right - up, c + right - up, c + right + up, c - right + up);
    };
    face(z, x, y), face(-z, -x, y), face(x, -z, y), face(-x, z, y), face(y, x, -z);
    return mesh;
}

GltfFile signs() {
    constexpr double h = kRoom / 2, off = 0.05, sign = 0.9;
    const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    GltfFile file{.name = "signs", .copyright = "MIT"};
    file.materials = {{.name = "White", .baseColor = {0.73, 0.72, 0.7}},
                      {.name = "Red", .baseColor = {0.63, 0.065, 0.05}},
                      {.name = "Green", .baseColor = {0.14, 0.45, 0.091}}};
    const auto addSign = [&](const char* name, dvec3 color, double nits, const char* image) {
        file.materials.push_back({.name = name,
                                  .baseColor = dvec3(0.05),
                                  .emissive = color,
                                  .emissiveStrength = nits,
                                  .emissiveTexture = image});
    };
    addSign("Ring", {1, 0.85, 0.6}, 40, "ring.png");
    addSign("Asterisk1", {1, 0.3, 0.1}, 12, "asterisk.png");
    addSign("Asterisk2", {0.15, 0.5, 1}, 12, "asterisk.png");
    addSign("Asterisk3", {0.9, 0.9, 0.2}, 12, "asterisk.png");
    addSign("Asterisk4", {0.8, 0.2, 1}, 12, "asterisk.png");
    file.meshes = {wall("Floor", White, {0, 0, 0}, h * x, -h * z),
                   wall("Ceiling", White, {0, kRoom, 0}, h * x, h * z),
                   wall("Back wall", White, {0, h, -h}, h * x, h * y),
                   wall("Left wall", Red, {-h, h, 0}, -h * z, h * y),
                   wall("Right wall", Green, {h, h, 0}, h * z, h * y),
                   block("Short block", {0.95, 0.825, 0.9}, {0.8, 0.825, 0.8}, -0.3),
                   block("Tall block", {-0.95, 1.65, -0.7}, {0.8, 1.65, 0.8}, 0.3),
                   panel("Ring", Ring, {0, kRoom - 0.3, 0}, 1.3 * x, 1.3 * z),
                   panel("Asterisk 1", Asterisk, {-1.4, 4.2, -h + off}, sign * x, sign * y),
                   panel("Asterisk 2", Asterisk + 1, {1.4, 3.3, -h + off}, sign * x, sign * y),
                   panel("Asterisk 3", Asterisk + 2, {-h + off, 3.4, 0.6}, -sign * z, sign * y),
                   panel("Asterisk 4", Asterisk + 3, {h - off, 2.8, -0.4}, sign * z, sign * y)};
    for (std::size_t i = 0; i < file.meshes.size(); ++i)
        file.nodes.push_back({.name = file.meshes[i].name, .mesh = int(i)});
    file.cameras = {{.name = "Camera", .fovY = 2 * std::atan(0.025 / 2 / 0.035)}};
    file.nodes.push_back({.name = "Camera", .camera = 0, .translation = {0, h, h + 8}});
    return file;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: generate_signs FOLDER\n", stderr);
        return 2;
    }
    const std::string folder = argv[1];
    if (!writeGltf(signs(), folder) || !writeFlipbook(folder + "/asterisk.png", asterisk) ||
        !writeFlipbook(folder + "/ring.png", ring)) {
        std::fprintf(stderr, "generate_signs: cannot write to %s\n", argv[1]);
        return 1;
    }
}
