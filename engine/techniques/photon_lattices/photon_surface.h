// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/metal.h"
#include "engine/shading/sampler.h"
#include "engine/techniques/photon_lattices/photon.h"

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

namespace limn {

/// A surface point that a photon meets, and how it scatters there. Normals are unit and face the
/// side that the photon comes from.
struct PhotonSurface {
    glm::vec3 position{0};
    glm::vec3 geometricNormal{0};
    glm::vec3 normal{0};  ///< interpolated from the vertices
    glm::vec3 diffuse{0}; ///< share reflected diffusely
    Metal metal;
    Transmission transmission;
    bool inside = false; ///< whether the photon comes from within the body behind the surface
};

/// A place on a surface that a photon meets from one side.
struct PhotonArrival {
    std::uint32_t instance = 0, triangle = 0;
    float u = 0, v = 0; ///< barycentrics
    glm::vec3 position{0};
    glm::vec3 normal{0}; ///< unit, geometric, of the side that the photon comes from
    bool front = true;   ///< whether that is the front
};

/// The surface at a hit; std::nullopt for the back of a one-sided surface that passes no light on,
/// which is black. The 4 % that a dielectric reflects specularly are left out.
std::optional<PhotonSurface> photonSurface(const Scene& scene, const PhotonArrival& hit);

/// A photon that goes on from a surface.
struct ScatteredPhoton {
    glm::vec3 direction{0}; ///< unit
    glm::vec3 power{0};     ///< [W]
    PhotonEvent event = PhotonEvent::Diffuse;
    bool narrow = false;
};

/// Numbers of pairs of a Sampler that scatter() uses.
inline constexpr std::uint32_t kScatterPairs = 2;

/// Scatters a photon of that power, which arrives along unit `direction`, or absorbs it
/// (std::nullopt). One random number chooses diffuse reflection, metal, a mirror of glass, the way
/// through it, or absorption, by the mean of their shares over the colours weighted by the photon's
/// power, so that what survives keeps its sum over the colours. Uses the sampler's pairs from
/// `dimension` on.
/// McGuire, Luebke. Hardware-Accelerated Global Illumination by Image Space Photon Mapping. 2009,
/// which takes the plain mean.
std::optional<ScatteredPhoton> scatter(const PhotonSurface& surface, glm::vec3 direction,
                                       glm::vec3 power, const Sampler& sampler,
                                       std::uint32_t dimension);

} // namespace limn
