// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/final_lightmap/lit_texels.h"
#include "engine/picture/gather_point.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// How the light of texels is gathered.
struct TexelGathering {
    /// Samples of each texel in the first stage, > 1; each has GatherScene::raysPerSample rays.
    std::uint32_t samples = AtlasTexel::kMaxPoints;
    std::uint32_t bands = 1; ///< 1: irradiance alone; 2 or 3: harmonics of incident radiance too
    std::uint32_t seed = 1;
};

/// Gathered light less that of the field, per texel of Atlas::texels; 0 for those that are not
/// open.
struct GatheredTexels {
    std::vector<glm::vec3> irradiance; ///< [W m^-2]
    /// Coefficient i of incident radiance above texel t at harmonics[i * texels + t]
    /// [W m^-2 sr^-1], as in IndirectField; empty for a single band.
    std::vector<glm::vec3> harmonics;
    std::uint64_t samples = 0; ///< number of samples taken
};

/// Gathers at the points of all open texels as FinalGather does for pixels: tiles of texels share a
/// guide, and neighbours that LitTexels::links connects share noise. Returns std::nullopt when
/// cancelled.
std::optional<GatheredTexels> gatherTexels(const GatherScene& scene, const CutScene& cut,
                                           const LitTexels& lit, const TexelGathering& how,
                                           const Progress& progress);

} // namespace limn
