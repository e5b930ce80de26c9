// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/probes/probe_grid.h"
#include "engine/techniques/probes/probe_settings.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>

namespace limn {

/// What decides where rays meet an instance, and which of its sides they meet.
struct ProbeSurface {
    std::uint32_t mesh = 0;
    glm::mat4 toWorld{1};
    bool twoSided = false;
    float cutoff = 0; ///< alphaCutoff()
    float alpha = 1;  ///< of the base colour, for cutouts
    TextureRef holes; ///< texture of cutouts' alpha

    bool operator==(const ProbeSurface&) const = default;
};

/// Everything in a scene that probes' light depends on, to tell what changed.
struct ProbeInputs {
    ProbeGrid grid;
    std::uint32_t side = 0; ///< of the maps
    std::shared_ptr<const Assets> assets;
    std::vector<ProbeSurface> surfaces;    ///< per instance
    std::vector<std::uint32_t> materialOf; ///< per instance
    std::vector<Material> materials;
    std::vector<Light> lights;         ///< unitLight()
    std::vector<std::uint8_t> shining; ///< per light
    Sky sky;
    bool glossy = false; ///< a surface is a glossy receiver (scene/surface/receiver_bands.h)
};

/// The probes stand over what does not move, if anything stands still. `before`: those of an
/// earlier scene, to reuse what materials decide.
ProbeInputs inputsOf(const Scene& scene, const ProbeSettings& settings, const ProbeInputs& before);

/// Whether probes stand at the same places and look in the same directions.
bool sameLattice(const ProbeInputs& a, const ProbeInputs& b);

/// Whether rays from probes meet the same points.
bool sameSurfaces(const ProbeInputs& a, const ProbeInputs& b);

} // namespace limn
