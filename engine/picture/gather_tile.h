// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/light_guide.h"

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

/// Width of the tiles of a picture [pixels]. The pixels of a tile share a guide.
inline constexpr std::uint32_t kGatherTile = 8, kGatherPixels = kGatherTile * kGatherTile;

/// Parts of the light that a picture gets. Two are differences between gathered light and the
/// field's, which is their control variate: Emitted of what the sky and emissive surfaces emit,
/// without a bounce, and Bounced of the rest. Each is shrunk towards 0 as far as its variance is
/// large. Shown is what the field shows.
enum GatherPart : std::uint32_t { Emitted, Bounced, Shown };
inline constexpr std::uint32_t kGatherParts = 3, kDifferences = 2;

/// The grey of light is the mean of its colours. Variances are those of greys.
double greyOf(glm::vec3 light);

/// Sums of one part of the light over samples of a pixel.
struct GatherSums {
    glm::dvec3 sum{0};
    double squared = 0;   ///< sum of the squares of greys
    double firstHalf = 0; ///< sum of the greys of the first half of the samples

    void add(glm::vec3 value, bool inFirstHalf);
    double grey() const { return (sum.x + sum.y + sum.z) / 3; }
    /// Variance of one sample.
    double variance(std::uint32_t count) const;
    /// Variance of the mean, from the difference of both halves. It is smaller than variance() /
    /// count where samples are stratified.
    double varianceByHalves(std::uint32_t count) const;
};
struct GatherSamples {
    std::array<GatherSums, kGatherParts> parts;
    GatherSums all;       ///< sums of all parts together
    glm::dvec3 weight{0}; ///< sum of the weights by which the picture shows irradiance
    std::uint32_t count = 0;
};
/// The samples of a tile's pixels; pixel (i, j) has number j * kGatherTile + i. Those beyond the
/// picture have none. Samples are taken in two stages: the second one follows what the first one
/// tells of variances and of where light comes from.
struct GatherTile {
    std::uint32_t x = 0, y = 0, width = 0, height = 0; ///< [pixels]
    LightGuide guide;
    std::array<GatherSamples, kGatherPixels> firstStage, secondStage;
    /// Weight of the second stage's mean in each part's mean over all samples.
    std::array<std::array<double, kGatherPixels>, kGatherParts> secondStageWeight{};
    /// Variance of the greys of each difference's mean over all samples.
    std::array<std::array<double, kGatherPixels>, kDifferences> variance{};

    /// Mean over all samples of a part of pixel p, which has some.
    glm::dvec3 meanOf(std::uint32_t p, GatherPart part) const;
};

/// The variance of a first-stage sample of pixel (i, j), of all parts together: the mean over its
/// neighbours, and the whole tile as one more. The samples of one pixel do not suffice: where all
/// of them have missed a window, they have no variance.
double varianceAround(const GatherTile& tile, std::uint32_t i, std::uint32_t j);

/// Weighs the second stage of samples against the first one: sets secondStageWeight and variance.
void weighStages(GatherTile& tile);

} // namespace limn
