// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/gather_tile.h"
#include "engine/scene/image.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// What the samples of a pixel have found. Light in what the picture shows.
struct GatheredPixel {
    glm::vec3 weight{0}; ///< mean factor by which the picture shows irradiance
    glm::vec3 shown{0};  ///< the field's light
    std::array<glm::vec3, kExchanges> exchange{};
    std::array<float, kExchanges> noise{}; ///< variance of the exchange's grey
};

/// Pixels of a picture.
struct PixelRect {
    glm::uvec2 begin{0}, end{0}; ///< end is exclusive

    std::size_t numberOf(glm::uvec2 pixel) const {
        return std::size_t(pixel.y - begin.y) * (end.x - begin.x) + pixel.x - begin.x;
    }
    std::size_t size() const { return std::size_t(end.x - begin.x) * (end.y - begin.y); }
    /// Calls body(pixel) for each, row by row.
    template <class Body>
    void forEach(const Body& body) const {
        for (std::uint32_t y = begin.y; y < end.y; ++y)
            for (std::uint32_t x = begin.x; x < end.x; ++x)
                body(glm::uvec2(x, y));
    }
};

/// Pixels on each side of one that it learns from, and of those near it.
inline constexpr std::uint32_t kGatherRadius = 3, kNearRadius = 1;

/// The pixels within `radius` of one that are in `rect`, as it is.
PixelRect windowAround(glm::uvec2 pixel, std::uint32_t radius, const PixelRect& rect);

/// What has been gathered for a part of a picture.
struct GatheredLight {
    PixelRect rect;
    std::vector<GatheredPixel> pixels; ///< one for each of rect

    explicit GatheredLight(const PixelRect& of) : rect(of), pixels(of.size()) {}
    const GatheredPixel& at(glm::uvec2 pixel) const { return pixels[rect.numberOf(pixel)]; }
    /// Takes the means of a tile, all of which is in rect.
    void set(const GatherTile& tile);
};

/// Light as the picture shows it, where the irradiance is the mean of some pixels'.
struct GatheredMean {
    glm::vec3 sum{0}, weights{0}; ///< of these pixels
    double noise = 0;             ///< variance of the sum's grey

    void add(const GatheredPixel& pixel, GatherPart part);
    /// In a pixel of this weight.
    glm::vec3 in(glm::vec3 weight) const { return factorFor(weight) * sum; }
    /// The factor of the sum in that.
    glm::vec3 factorFor(glm::vec3 weight) const;
};

/// How much of an exchange a pixel gets: shares of the mean of its window, of what the mean of the
/// pixels near it differs from that, and of what the pixel itself differs from that one.
struct KeptExchange {
    GatheredMean window, near;
    float ofWindow = 0, ofNear = 0, ofPixel = 0;

    glm::vec3 lightIn(const GatheredPixel& pixel, GatherPart part) const;
    /// The factor in that of the exchange of one of the window's pixels.
    glm::vec3 factorOf(bool isNear, bool isItself, glm::vec3 weight) const;
};

/// Weighs the exchange of a pixel so that the expected squared error is least, given how far means
/// and pixels of the window differ from each other, and the window's mean from nothing, beyond
/// their noise.
/// Efron, Morris. Stein's Estimation Rule and Its Competitors. 1973
KeptExchange keptExchange(const GatheredLight& light, GatherPart part, glm::uvec2 pixel);

/// Adds the light of some pixels to the picture. All windows around them must be gathered.
void addGathered(ImageF& image, const GatheredLight& light, const PixelRect& pixels);

} // namespace limn
