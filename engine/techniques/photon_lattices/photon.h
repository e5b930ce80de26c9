// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What a photon did at a vertex of its path.
enum class PhotonEvent : std::uint8_t {
    Emitted, ///< it left an emissive surface
    Diffuse,
    Specular, ///< reflected by metal, or by a boundary of glass
    Transmitted
};

/// Index of no vertex.
inline constexpr std::uint32_t kNoVertex = ~0U;

/// A vertex of a photon's path, without the place of its light.
struct PhotonVertex {
    glm::vec3 position{0};
    std::uint32_t instance = 0;         ///< index into Scene::instances
    std::uint32_t previous = kNoVertex; ///< vertex before this one; kNoVertex: the light
    PhotonEvent event = PhotonEvent::Diffuse;
    /// Whether light leaves within a narrow lobe, as after glass and metal of roughness up to 0.5.
    bool narrow = false;
};

/// A photon at a surface, before it bounces.
struct Photon {
    glm::vec3 power{0}; ///< that falls on the surface, see PhotonMap [W]
    glm::vec3 position{0};
    glm::vec3 normal{0};              ///< unit, geometric, of the side that it falls on
    glm::vec3 direction{0};           ///< unit, in which it travels
    std::uint32_t vertex = kNoVertex; ///< last vertex of its path before this surface
};

/// What became of the photons of a source, as numbers of paths and as their power [W], summed over
/// red, green and blue. Power that is emitted is absorbed, ends or is lost.
struct PhotonFates {
    std::uint64_t emitted = 0, absorbed = 0, ended = 0, lost = 0; ///< paths
    std::uint64_t rays = 0;
    double emittedPower = 0;
    double absorbedPower = 0; ///< by surfaces, among them backs that reflect nothing
    double endedPower = 0;    ///< of paths that reached their limit of bounces
    double lostPower = 0;     ///< that left the scene
};

/// Photons of a source: of a light of colour 1 and strength 1, a material that emits by a factor of
/// 1, or the sky. Times colour and strength, powers are in [W].
struct PhotonMap {
    std::vector<Photon> photons; ///< in the order of their paths
    std::vector<PhotonVertex> vertices;
    PhotonFates fates;
};

} // namespace limn
