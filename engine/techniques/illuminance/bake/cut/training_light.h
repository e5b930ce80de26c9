// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/rays/trace_stage.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Radiosity of every sender under a few lightings that a user might set: suns, lamps in the air,
/// skies, and the scene's emissive surfaces. They show, before any light is set, which clusters may
/// vary within and by how much. Surfaces count as white, because their colours are not part of a
/// bake.
struct TrainingLight {
    /// Lightings per row. With few of them, clusters that happen to be dark in all of them hide
    /// sunlit spots.
    static constexpr std::uint32_t kCount = 96;

    /// radiosity[node * kCount + t]: leaves as the tree numbers them, then inner nodes. The mean
    /// square of each lighting over what the caches see is 1, that of emitters 256; a lighting may
    /// also be 0 everywhere.
    std::vector<float> radiosity;

    /// Per node, the sum of the squared weights that the leaves have in its radiosity; 1 for
    /// leaves.
    std::vector<float> squaredWeights;

    /// Root mean square of lighting `t` over what the caches see.
    static float strength(std::uint32_t t);

    const float* row(std::uint32_t node) const {
        return radiosity.data() + std::size_t(node) * kCount;
    }
};

/// Irradiance of the training suns and lamps at the surfels' middles, the only part that needs
/// rays. At their light points, which change wherever a ray meets them elsewhere, an object that
/// moves would trace nearly all of it again; the error of the cut in Sponza was .040 instead of
/// .045.
struct TracedTraining {
    /// The nRMSE of irradiance that the cut added in Sponza at default settings, over two views and
    /// six suns that are not among these, was .072 with 20 suns and .044 with 52.
    static constexpr std::uint32_t kSuns = 52, kLamps = 32, kCount = kSuns + kLamps;

    /// Irradiance of lamp `k` at surfel `s`.
    float lamp(std::size_t s, std::uint32_t k) const { return irradiance[s * kCount + kSuns + k]; }

    std::vector<float> irradiance;   ///< [surfel * kCount + light]; empty when cancelled
    std::vector<glm::vec3> lamps;    ///< world positions
    std::vector<glm::vec3> position; ///< of the surfels
    std::uint64_t rays = 0;          ///< rays traced for this result
};

/// An earlier training light of the same document, and what moved since.
struct EarlierTraining {
    TracedTraining light;
    MovedSince moved;
};

/// Traces the training suns and lamps. With `earlier`, which may be null, only shadow rays that
/// pass near what moved are traced; the result is the same.
TracedTraining traceTraining(const TraceScene& trace, const Surfels& surfels,
                             const EarlierTraining* earlier, const Progress& progress);

/// Computes the training light of all nodes. `importance`: leafImportance() of the tree.
TrainingLight trainingLight(const Scene& scene, const Surfels& surfels, const ClusterTree& tree,
                            const std::vector<float>& importance, const TracedTraining& traced);

} // namespace limn
