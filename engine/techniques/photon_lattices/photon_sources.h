// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"
#include "engine/techniques/photon_lattices/photon_light.h"
#include "engine/techniques/photon_lattices/photon_paths.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Texels along a side of each view of a light's reflective shadow map, whose views share
/// `photons`.
std::uint32_t photonMapSide(const Light& light, const Bounds& bounds, std::uint32_t photons);

/// The beginnings of a light's paths at the surfaces that it sees, in the order of castRsm(). Adds
/// the number of rays to `rays`, if that is given. Incomplete when cancelled.
std::vector<PathStart> lightStarts(const PhotonScene& scene, const Light& light,
                                   const Progress& progress, std::uint64_t* rays = nullptr);

/// Photons of a light as unitLight() makes it. Each texel of its reflective shadow map is a photon;
/// the surface that it sees is the first vertex of its path and stores nothing, since direct light
/// is added elsewhere. Incomplete when cancelled, as the others are.
PhotonMap traceLight(const PhotonScene& scene, const Light& light, const Progress& progress);

/// Photons of all surfaces of a material, as if its emission were 1 times its texture: points even
/// in area, directions by the cosine. They are stored where they arrive first, too.
PhotonMap traceEmitters(const PhotonScene& scene, std::uint32_t material, const Progress& progress);

/// Photons of the scene's sky, each from a disc that is perpendicular to its direction and covers
/// the scene. They are stored where they arrive first, too.
PhotonMap traceSky(const PhotonScene& scene, const Progress& progress);

/// Photons of a source by one of these.
PhotonMap tracePhotons(const PhotonScene& scene, const PhotonSource& source,
                       const Progress& progress);

} // namespace limn
