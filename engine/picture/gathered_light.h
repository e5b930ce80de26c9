// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/gather_tile.h"
#include "engine/scene/image.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Means over the samples of a pixel. Light is in the unit of the picture, irradiance or radiance.
struct GatheredPixel {
    glm::vec3 weight{0}; ///< what the picture shows for unit irradiance; 0 in the background
    glm::vec3 shown{0};  ///< the field's light
    std::array<glm::vec3, kExchanges> exchange{};
    std::array<float, kExchanges> noise{}; ///< variance of the exchange's grey
};

/// Some pixels of a picture.
struct PixelRect {
    glm::uvec2 begin{0}, end{0}; ///< end is exclusive

    std::size_t numberOf(glm::uvec2 pixel) const {
        return std::size_t(pixel.y - begin.y) * (end.x - begin.x) + pixel.x - begin.x;
    }
    bool contains(glm::uvec2 pixel) const {
        return pixel.x >= begin.x && pixel.y >= begin.y && pixel.x < end.x && pixel.y < end.y;
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

/// Radii of the window whose mean a pixel shares in, and of its neighbourhood within that [pixels].
inline constexpr std::uint32_t kGatherRadius = 3, kNearRadius = 1;

/// The square of pixels up to `radius` away from a pixel of `rect`, clipped to `rect`.
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

/// Sums over some pixels, and with these the light of any pixel that had their mean irradiance.
struct GatheredMean {
    glm::vec3 sum{0}, weights{0}; ///< of the exchange, and of GatheredPixel::weight
    double noise = 0;             ///< variance of the sum's grey

    void add(const GatheredPixel& pixel, GatherPart part);
    /// The light of a pixel of this weight.
    glm::vec3 in(glm::vec3 weight) const { return factorFor(weight) * sum; }
    /// in(weight) is the sum times this.
    glm::vec3 factorFor(glm::vec3 weight) const;
};

/// How much of an exchange a pixel gets: a share of the mean over its window, a share of the
/// difference between the mean over its neighbourhood and that mean, and a share of the difference
/// between the pixel itself and its neighbourhood.
struct KeptExchange {
    GatheredMean window, near;
    float ofWindow = 0, ofNear = 0, ofPixel = 0;

    glm::vec3 lightIn(const GatheredPixel& pixel, GatherPart part) const;
    /// lightIn() is the sum over the window's pixels of their exchange times this. `weight`: that
    /// of the pixel that gets the light. `isNear`: the summed pixel is in its neighbourhood.
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
