// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_surface.h"

#include "engine/math/fresnel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/surface/specular.h"
#include "engine/shading/surface_point.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kMirrorRoughness = 0.05f; ///< below this, metal is a perfect mirror
constexpr float kNarrowRoughness = 0.5f;  ///< up to this, its lobe is narrow

/// A direction in which a surface may send a photon on, and the share of its power that it keeps.
struct Way {
    glm::vec3 direction{0};
    glm::vec3 share{0};
};

/// Draws the reflection by the metallic part; without a share where it would go below the surface.
Way metalWay(const PhotonSurface& surface, glm::vec3 direction, glm::vec2 u) {
    const Metal& metal = surface.metal;
    Way way;
    if (!(metal.metallic > 0))
        return way;
    if (metal.roughness < kMirrorRoughness) {
        const float cosine = std::clamp(-glm::dot(direction, surface.normal), 0.f, 1.f);
        way = {glm::reflect(direction, surface.normal), schlickFresnel(metal.base, cosine)};
    } else {
        const SpecularSample sample =
            sampleSpecular({metal.base, metal.roughness}, surface.normal, -direction, u);
        way = {sample.toLight, sample.weight};
    }
    way.share = glm::dot(way.direction, surface.geometricNormal) > 0
                    ? glm::min(way.share, 1.f) * metal.metallic
                    : glm::vec3(0);
    return way;
}

/// Mean of a share over the colours, weighted by the photon's power.
float meanShare(glm::vec3 power, glm::vec3 share) {
    return channelSum(power * share) / channelSum(power);
}

} // namespace

std::optional<PhotonSurface> photonSurface(const Scene& scene, const PhotonArrival& hit) {
    const Instance& instance = scene.instances[hit.instance];
    if (!hit.front && !isTwoSided(scene.materialOf(instance)))
        return std::nullopt;
    const float side = hit.front ? 1.f : -1.f;
    PhotonSurface surface{.position = hit.position, .geometricNormal = hit.normal};
    surface.normal = side * shadingNormal(scene.meshOf(instance), instance, hit.triangle,
                                          {hit.u, hit.v}, side * hit.normal);
    surface.diffuse = surfaceMaterial(scene, instance, hit.triangle, hit.u, hit.v).albedo;
    surface.metal = surfaceMetal(scene, instance, hit.triangle, hit.u, hit.v);
    return surface;
}

std::optional<ScatteredPhoton> scatter(const PhotonSurface& surface, glm::vec3 direction,
                                       glm::vec3 power, const Sampler& sampler,
                                       std::uint32_t dimension) {
    if (!(channelSum(power) > 0))
        return std::nullopt;
    const glm::vec2 choice = sampler.pair(dimension), u = sampler.pair(dimension + 1);
    const Way metal = metalWay(surface, direction, u);
    const float diffuse = meanShare(power, surface.diffuse),
                specular = meanShare(power, metal.share);
    // Shares that sum to more than 1, as where a texture's mean meets one of its texels, are scaled
    // in favour of none.
    const float all = std::max(diffuse + specular, 1.f);
    const float pick = choice.x * all;
    if (pick < diffuse)
        return ScatteredPhoton{sampleCosineHemisphere(surface.geometricNormal, u),
                               power * surface.diffuse / diffuse, PhotonEvent::Diffuse, false};
    if (pick < diffuse + specular)
        return ScatteredPhoton{metal.direction, power * metal.share / specular,
                               PhotonEvent::Specular, surface.metal.roughness <= kNarrowRoughness};
    return std::nullopt;
}

} // namespace limn
