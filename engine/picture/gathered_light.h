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
    glm::vec3 shown{0};  ///< light of the field
    /// Gathered light less the field's light. The field is a control variate: the picture shows
    /// its light and adds the difference that samples find.
    std::array<glm::vec3, kDifferences> difference{};
    std::array<float, kDifferences> variance{}; ///< variance of the difference's grey
};

/// A rectangle of pixels of a picture.
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

/// Radii of the window whose mean ShrunkDifference takes, and of the neighbourhood within that
/// [pixels].
inline constexpr std::uint32_t kGatherRadius = 3, kNearRadius = 1;

/// The square of pixels up to `radius` away from a pixel of `rect`, clipped to `rect`.
PixelRect windowAround(glm::uvec2 pixel, std::uint32_t radius, const PixelRect& rect);

/// The next pixels with which a pixel shares noise: to its right, below, to its left and above.
struct SharingLinks {
    static constexpr std::uint32_t kNone = ~0U;
    static constexpr std::array<glm::ivec2, 4> kSteps{
        {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0), glm::ivec2(0, -1)}};
    std::array<std::uint32_t, 4> next{kNone, kNone, kNone, kNone}; ///< PixelRect::numberOf()
    /// How many directions further in this order the same way leads from there, in [0, 3].
    std::array<std::uint8_t, 4> turn{};
};

/// Gathered light of a part of a picture, or of texels that are laid out like one.
struct GatheredLight {
    PixelRect rect;
    std::vector<GatheredPixel> pixels; ///< one for each of rect
    /// One for each pixel; empty: all pixels of a window share their noise.
    std::vector<SharingLinks> links;

    explicit GatheredLight(const PixelRect& area) : rect(area), pixels(area.size()) {}
    const GatheredPixel& at(glm::uvec2 pixel) const { return pixels[rect.numberOf(pixel)]; }
    /// Takes the means of a tile, all of which is in rect.
    void set(const GatherTile& tile);
};

inline constexpr std::uint32_t kWindowSide = 2 * kGatherRadius + 1;

/// The pixels that share noise with one, which is in the middle of the window. Without links they
/// are those around it; otherwise, those that links lead to within the window.
struct SharingWindow {
    static constexpr PixelRect kPlaces{{0, 0}, {kWindowSide, kWindowSide}};
    static constexpr glm::uvec2 kMiddle{kGatherRadius, kGatherRadius};
    /// Number of the pixel at each place, row by row, or SharingLinks::kNone.
    std::array<std::uint32_t, std::size_t(kWindowSide) * kWindowSide> pixel{};

    /// Calls body(place, pixel number) for those within a radius around a place.
    template <class Body>
    void forEach(glm::uvec2 place, std::uint32_t radius, const Body& body) const {
        windowAround(place, radius, kPlaces).forEach([&](glm::uvec2 q) {
            if (const std::uint32_t number = pixel[kPlaces.numberOf(q)];
                number != SharingLinks::kNone)
                body(q, number);
        });
    }
};
SharingWindow sharingWindow(const GatheredLight& light, glm::uvec2 pixel);

/// Sums over some pixels. With these it predicts the light of a pixel of the same mean irradiance.
struct GatheredMean {
    glm::vec3 sum{0}, weights{0}; ///< sums of the difference and of GatheredPixel::weight
    double variance = 0;          ///< variance of the sum's grey

    void add(const GatheredPixel& pixel, GatherPart part);
    /// The light of a pixel of this weight.
    glm::vec3 in(glm::vec3 weight) const { return factorFor(weight) * sum; }
    /// Factor by which in(weight) multiplies the sum.
    glm::vec3 factorFor(glm::vec3 weight) const;
};

/// The difference between gathered light and the field's that a pixel shows: a sum of three terms,
/// each times a shrinkage factor in [0, 1]. They are the mean over the pixel's window, what the
/// mean over its neighbourhood differs from that by, and what the pixel differs from its
/// neighbourhood by. Both consist of the pixels of its SharingWindow.
struct ShrunkDifference {
    GatheredMean window, near;
    float windowFactor = 0, nearFactor = 0, pixelFactor = 0;

    glm::vec3 lightIn(const GatheredPixel& pixel, GatherPart part) const;
    /// Weight of the difference of one pixel of the window in lightIn(), which is their weighted
    /// sum. `weight`: GatheredPixel::weight of the pixel that gets the light. `isNear`: the summed
    /// pixel is in its neighbourhood.
    glm::vec3 factorOf(bool isNear, bool isItself, glm::vec3 weight) const;
};

/// Chooses the shrinkage factors of a pixel so that the expected squared error is least. Each is
/// signal / (signal + variance). The signal is how far means and pixels of the window differ from
/// each other, or the window's mean from 0, beyond their variance.
/// Efron, Morris. Stein's Estimation Rule and Its Competitors. 1973
ShrunkDifference shrinkDifference(const GatheredLight& light, GatherPart part, glm::uvec2 pixel);

/// Adds the light of some pixels to the picture. All windows around them must be gathered.
void addGathered(ImageF& image, const GatheredLight& light, const PixelRect& pixels);

} // namespace limn
