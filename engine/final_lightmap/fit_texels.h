// SPDX-License-Identifier: MIT
#pragma once

#include "engine/final_lightmap/texel_seams.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What the light of texels is fitted to.
struct TexelFitInput {
    std::size_t texels = 0;
    std::vector<TexelLookup> points; ///< lookups of points on surfaces
    std::vector<float> weights;      ///< per point, how much its error counts, >= 0
    /// Texels next to each other on one surface.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours;
    std::vector<SeamLookup> seams;
};

/// Finds values of texels so that a bilinear lookup at each point shows its light: with the least
/// sum of squared errors, weighted, and of squared jumps across seams. Neighbours keep the
/// difference that `first` has, with a small weight, so that texels which no point reads are
/// defined too.
///
/// Kavan, Bargteil, Sloan. Least Squares Vertex Baking. 2011, for texels in place of vertices.
class TexelFit {
public:
    explicit TexelFit(const TexelFitInput& input);
    ~TexelFit();

    /// Light per texel from `light` per point, starting from `first` per texel. Thread-safe.
    std::vector<float> solve(const std::vector<float>& light,
                             const std::vector<float>& first) const;
    /// The same for each of three colours.
    std::vector<glm::vec3> solve(const std::vector<glm::vec3>& light,
                                 const std::vector<glm::vec3>& first) const;

private:
    struct System;
    std::unique_ptr<System> m_system;
};

} // namespace limn
