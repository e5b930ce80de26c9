// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/photon_lattices/photon.h"
#include "engine/techniques/photon_lattices/photon_settings.h"
#include "engine/techniques/photon_lattices/photon_surface.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace limn {

/// Where photons are traced. `trace` may be of an older scene of equal geometry.
struct PhotonScene {
    const TraceScene& trace;
    const Scene& scene;
    PathSettings settings;
};

/// A photon on its way.
struct Flight {
    glm::vec3 origin{0};    ///< clear of the surface that it leaves
    glm::vec3 direction{0}; ///< unit
    glm::vec3 power{0};
    std::uint32_t vertex = kNoVertex;        ///< last vertex, of those of the same list
    std::uint32_t diffuse = 0, specular = 0; ///< bounces behind it
};

/// The beginning of a path: a photon that left its source.
struct PathStart {
    Flight flight;
    /// The surface that it meets first, where that is known, and its instance.
    std::optional<PhotonSurface> surface;
    std::uint32_t instance = 0;
    /// Sampler::index of the path's random numbers, of which the first kStartPairs pairs are for
    /// its beginning.
    std::uint32_t sample = 0;
};

/// Draws the beginning of a path; std::nullopt: it has none. May add a vertex to `map`.
using PathOf = std::function<std::optional<PathStart>(std::uint32_t path, PhotonMap& map)>;
inline constexpr std::uint32_t kStartPairs = 4;

/// Traces paths 0 ... count - 1. A surface that is known stores no photon. The map does not depend
/// on the number of threads. Incomplete when cancelled.
PhotonMap tracePaths(const PhotonScene& scene, std::uint32_t count, const PathOf& start,
                     const Progress& progress);

} // namespace limn
