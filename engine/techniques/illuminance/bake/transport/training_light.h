// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/techniques/illuminance/bake/transport/trace_stage.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Radiosity of every sender under a few lightings that a user might set: suns, lamps in the air,
/// skies, and the scene's emissive surfaces. They tell, before any light is set, which clusters may
/// differ inside and by how much. Surfaces count as white: their colours are no part of a bake.
struct TrainingLight {
    /// Lightings in a row. With 32 of them clusters that happened to be dark in all hid sunlit
    /// spots: Sponza at 32 links per cache, error of the cut 0.63; with 64, 0.50.
    static constexpr std::uint32_t kCount = 64;

    /// radiosity[node * kCount + t]: leaves as the tree numbers them, then inner nodes. Each
    /// lighting's mean square over what the caches see is 1, that of emitters 256, or it is 0
    /// everywhere.
    std::vector<float> radiosity;

    /// Root mean square of lighting `t` over what the caches see.
    static float strength(std::uint32_t t);

    const float* row(std::uint32_t node) const {
        return radiosity.data() + std::size_t(node) * kCount;
    }
};

/// Irradiance of the training suns and lamps at the surfels: all that rays are needed for.
struct TracedTraining {
    static constexpr std::uint32_t kSuns = 20, kLamps = 32, kCount = kSuns + kLamps;

    /// Irradiance of lamp `k` at surfel `s`.
    float lamp(std::size_t s, std::uint32_t k) const { return irradiance[s * kCount + kSuns + k]; }

    std::vector<float> irradiance;   ///< [surfel * kCount + light]; empty when cancelled
    std::vector<glm::vec3> lamps;    ///< where they hang
    std::vector<glm::vec3> position; ///< of the surfels
    std::uint64_t rays = 0;          ///< traced for it
};

/// An earlier training light of the same document, and what moved since.
struct EarlierTraining {
    TracedTraining light;
    MovedSince moved;
};

/// With `earlier`, which may be null, only shadow rays that come near what moved are traced; the
/// result is the same.
TracedTraining traceTraining(const TraceScene& trace, const Surfels& surfels,
                             const EarlierTraining* earlier, const Progress& progress);

/// `seen`: how much of each leaf all caches together see, in irradiance.
TrainingLight trainingLight(const Scene& scene, const Surfels& surfels, const ClusterTree& tree,
                            const std::vector<float>& seen, const TracedTraining& traced);

} // namespace limn
