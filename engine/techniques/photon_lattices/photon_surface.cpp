// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_surface.h"

#include "engine/math/fresnel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/surface/specular.h"
#include "engine/shading/surface_point.h"

#include <algorithm>
#include <array>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kNarrowRoughness = 0.5f; ///< up to this, the lobe of a metal is narrow

/// A direction in which a surface may send a photon on, and the share of its power that it keeps.
struct Way {
    glm::vec3 direction{0};
    glm::vec3 share{0};
    PhotonEvent event = PhotonEvent::Diffuse;
    bool narrow = false;
};

/// The reflection by the metallic part.
Way metalWay(const Metal& metal, glm::vec3 n, glm::vec3 direction, glm::vec2 u) {
    Way way{.event = PhotonEvent::Specular, .narrow = metal.roughness <= kNarrowRoughness};
    if (metal.roughness < kSmoothRoughness) {
        const float cosine = std::clamp(-glm::dot(direction, n), 0.f, 1.f);
        way.direction = glm::reflect(direction, n);
        way.share = metal.metallic * schlickFresnel(metal.base, cosine);
    } else {
        const SpecularSample sample =
            sampleSpecular({metal.base, metal.roughness}, n, -direction, u);
        way.direction = sample.toLight;
        way.share = metal.metallic * glm::min(sample.weight, 1.f);
    }
    return way;
}

/// Takes the share of a way that leads to the wrong side of the triangle.
void keepOnSide(Way& way, glm::vec3 geometricNormal, float side) {
    if (!(side * glm::dot(way.direction, geometricNormal) > 0))
        way.share = glm::vec3(0);
}

/// The ways on: diffuse, by metal, mirrored by glass and through it. Those without a share are not
/// taken.
std::array<Way, 4> waysOn(const PhotonSurface& surface, glm::vec3 direction, glm::vec2 u) {
    std::array<Way, 4> ways;
    const glm::vec3 n =
        glm::dot(surface.normal, direction) < 0 ? surface.normal : surface.geometricNormal;
    if (surface.diffuse != glm::vec3(0))
        ways[0] = {sampleCosineHemisphere(surface.geometricNormal, u), surface.diffuse};
    if (surface.metal.metallic > 0)
        ways[1] = metalWay(surface.metal, n, direction, u);
    if (surface.transmission) {
        const BoundarySplit split =
            splitAtBoundary(surface.transmission, n, -direction, surface.inside, u);
        const float mirrored = split.reflectance * split.mirroredShare;
        const float refracted = (1 - split.reflectance) * split.refractedShare;
        ways[2] = {split.mirrored, glm::vec3(surface.transmission.share * mirrored),
                   PhotonEvent::Specular, true};
        ways[3] = {split.refracted, surface.transmission.tint * refracted, PhotonEvent::Transmitted,
                   true};
    }
    for (std::size_t i = 1; i < ways.size(); ++i)
        keepOnSide(ways[i], surface.geometricNormal, i == 3 ? -1.f : 1.f);
    return ways;
}

} // namespace

std::optional<PhotonSurface> photonSurface(const Scene& scene, const PhotonArrival& hit) {
    const Instance& instance = scene.instances[hit.instance];
    const Material& material = scene.materialOf(instance);
    const bool reflects = hit.front || isTwoSided(material);
    if (!reflects && !(material.transmission > 0))
        return std::nullopt;
    const float side = hit.front ? 1.f : -1.f;
    PhotonSurface surface{.position = hit.position, .geometricNormal = hit.normal};
    surface.normal = side * shadingNormal(scene.meshOf(instance), instance, hit.triangle,
                                          {hit.u, hit.v}, side * hit.normal);
    if (reflects) {
        surface.diffuse = surfaceMaterial(scene, instance, hit.triangle, hit.u, hit.v).albedo;
        surface.metal = surfaceMetal(scene, instance, hit.triangle, hit.u, hit.v);
    }
    surface.transmission = surfaceTransmission(scene, instance, hit.triangle, hit.u, hit.v);
    surface.inside = !hit.front && !surface.transmission.isThin;
    return surface;
}

std::optional<ScatteredPhoton> scatter(const PhotonSurface& surface, glm::vec3 direction,
                                       glm::vec3 power, const Sampler& sampler,
                                       std::uint32_t dimension) {
    const float sum = channelSum(power);
    if (!(sum > 0))
        return std::nullopt;
    const std::array<Way, 4> ways = waysOn(surface, direction, sampler.pair(dimension + 1));
    std::array<float, 4> share{};
    float all = 0;
    for (std::size_t i = 0; i < ways.size(); ++i)
        all += share[i] = channelSum(power * ways[i].share) / sum;
    // Shares may sum to more than 1 where the mean over a texel meets one of its points.
    float rest = sampler.pair(dimension).x * std::max(all, 1.f);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (rest < share[i])
            return ScatteredPhoton{ways[i].direction, power * ways[i].share / share[i],
                                   ways[i].event, ways[i].narrow};
        rest -= share[i];
    }
    return std::nullopt;
}

} // namespace limn
