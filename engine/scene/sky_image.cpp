// SPDX-License-Identifier: MIT
#include "engine/scene/sky_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {

static constexpr double kPi = std::numbers::pi;

/// Horizontal position in [0, 1) of azimuth `turns` (atan2(z, x) over 2 pi) in the panorama.
static double across(double turns, float rotation) {
    const double u = turns + double(rotation) / (2 * kPi) + 0.75;
    return u - std::floor(u);
}

static std::uint32_t indexOf(double x, std::uint32_t count) {
    return std::min(std::uint32_t(std::max(x, 0.0) * double(count)), count - 1);
}

glm::vec3 skyRadiance(const ImageF& panorama, float rotation, glm::vec3 d) {
    const double u = across(std::atan2(double(d.z), double(d.x)) / (2 * kPi), rotation);
    const double v = std::acos(std::clamp(double(d.y), -1.0, 1.0)) / kPi;
    return panorama.rgb[std::size_t(indexOf(v, panorama.height)) * panorama.width +
                        indexOf(u, panorama.width)];
}

SkyBands skyBands(const ImageF& panorama, std::uint32_t bands) {
    SkyBands out{bands, panorama.width, {}};
    out.mean.assign(std::size_t(bands) * panorama.width, glm::dvec3(0));
    for (std::uint32_t row = 0; row < panorama.height; ++row) {
        // Heights that the row covers, in bands from below.
        const auto height = [&](std::uint32_t edge) {
            return (std::cos(kPi * edge / panorama.height) + 1) / 2 * bands;
        };
        const double lower = height(row + 1), upper = height(row);
        for (auto b = indexOf(lower / bands, bands); b < bands && double(b) < upper; ++b) {
            const double share = std::min(upper, double(b + 1)) - std::max(lower, double(b));
            for (std::uint32_t x = 0; share > 0 && x < panorama.width; ++x)
                out.mean[std::size_t(b) * panorama.width + x] +=
                    share * glm::dvec3(panorama.rgb[std::size_t(row) * panorama.width + x]);
        }
    }
    return out;
}

std::vector<glm::vec3> skyCellRadiance(const SkyBands& bands, std::uint32_t sectors,
                                       float rotation) {
    std::vector<glm::vec3> cells(std::size_t(bands.bands) * sectors);
    const double width = double(bands.columns) / sectors; // of a sector, in columns
    for (std::uint32_t s = 0; s < sectors; ++s) {
        const double first = across(double(s) / sectors - 0.5, rotation) * bands.columns;
        for (std::uint32_t b = 0; b < bands.bands; ++b) {
            glm::dvec3 sum(0);
            for (double position = first; position < first + width;) {
                const double next = std::min(std::floor(position) + 1, first + width);
                const auto column = std::size_t(position) % bands.columns;
                sum += (next - position) * bands.mean[std::size_t(b) * bands.columns + column];
                position = next;
            }
            cells[std::size_t(b) * sectors + s] = glm::vec3(sum / width);
        }
    }
    return cells;
}

} // namespace limn
