// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Sums of a pixel's samples in two halves: those of even and of odd number. The halves are
/// scrambled independently, so their difference measures the error of low-discrepancy points,
/// which the samples' variance cannot.
struct HalfSums {
    glm::dvec3 half[2] = {glm::dvec3(0), glm::dvec3(0)};

    /// Mean of `count` > 0 samples.
    glm::dvec3 mean(std::uint64_t count) const { return (half[0] + half[1]) / double(count); }

    /// Variance of the mean, summed over the channels, from the halves' means a and b:
    /// (a - b)^2 n_a n_b / n^2. 0 below 2 samples.
    double variance(std::uint64_t count) const {
        if (count < 2)
            return 0;
        const double n = double(count), nb = double(count / 2), na = n - nb;
        const glm::dvec3 d = half[0] / na - half[1] / nb;
        return glm::dot(d, d) * na * nb / (n * n);
    }
};

/// Collects the noise of a picture over its pixels.
struct PictureNoise {
    double variance = 0, total = 0;

    void add(const HalfSums& sums, std::uint64_t count) {
        const glm::dvec3 mean = sums.mean(count);
        total += mean.x + mean.y + mean.z;
        variance += sums.variance(count);
    }
    /// ReferenceResult::noise of a picture of `pixels` whose least sampled pixel has `samples`.
    double relative(std::size_t pixels, std::uint64_t samples) const {
        if (samples < 2)
            return std::numeric_limits<double>::infinity();
        const double values = 3 * double(pixels);
        return variance > 0 ? std::sqrt(variance / values) / (total / values) : 0;
    }
};

} // namespace limn
