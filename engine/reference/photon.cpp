// SPDX-License-Identifier: MIT
#include "engine/reference/photon.h"

#include "engine/math/fresnel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/metal.h"
#include "engine/shading/passed_ray.h"

#include <algorithm>
#include <array>
#include <optional>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kDimensionsPerHit = 3;

/// A way on for a photon.
struct Scattering {
    glm::vec3 direction{0}; ///< unit; 0: absorbed
    glm::vec3 weight{0};    ///< factor of the power
    bool isDiffuse = false;
};

/// A photon's arrival at a surface. The normals are unit and face the side that it came from.
struct Meeting {
    glm::vec3 geometricNormal;
    glm::vec3 normal; ///< that of shading, or the geometric one if the photon comes from below that
    glm::vec3 toLight;
    bool inside;                       ///< within a body of glass
    std::optional<SurfacePoint> point; ///< none at a black back

    bool isShaded() const { return point && !inside; }
};

Meeting meetingOf(const TraceScene& trace, const Hit& hit, glm::vec3 direction) {
    const Scene& scene = trace.scene();
    const float side = hit.frontFace ? 1.f : -1.f;
    Meeting m{.geometricNormal = side * hit.geometricNormal,
              .normal = {},
              .toLight = -direction,
              .inside = isWithinBody(scene, hit),
              .point = surfacePoint(trace, hit)};
    m.normal = m.point ? m.point->normal : shadingNormalAt(scene, hit);
    if (!(glm::dot(m.normal, m.toLight) > 0))
        m.normal = m.geometricNormal;
    return m;
}

/// What the metallic part of a surface reflects.
Scattering metalScattering(const Metal& metal, const Meeting& m, glm::vec2 u) {
    const Gloss gloss{metal.base, metal.roughness};
    if (metal.roughness >= kSmoothRoughness) {
        const SpecularSample s = sampleSpecular(gloss, m.normal, m.toLight, u);
        return {s.toLight, metal.metallic * s.weight};
    }
    const float cosine = glm::dot(m.normal, m.toLight);
    return {glm::normalize(2 * cosine * m.normal - m.toLight),
            metal.metallic * schlickFresnel(gloss.F0, cosine)};
}

/// Absorbs what goes to the wrong side of the triangle: `side` is 1 for mirrored light, else -1.
Scattering onSide(Scattering way, const Meeting& m, float side) {
    return side * glm::dot(way.direction, m.geometricNormal) > 0 ? way : Scattering{};
}

/// The ways on at a surface: diffuse, mirrored by metal, mirrored and refracted by glass.
std::array<Scattering, 4> scatterings(const Scene& scene, const Hit& hit, const Meeting& m,
                                      const PhotonHit& photon, const Sampler& sampler,
                                      std::uint32_t dimension) {
    const Instance& instance = scene.instances[hit.instance];
    const glm::vec2 facet = sampler.pair(dimension + 2);
    std::array<Scattering, 4> ways;
    if (m.isShaded()) {
        ways[0] = {sampleCosineHemisphere(m.geometricNormal, sampler.pair(dimension + 1)),
                   m.point->albedo * photon.shadingRatio(), true};
        const Metal metal = surfaceMetal(scene, instance, hit.triangle, hit.u, hit.v);
        if (metal.metallic > 0)
            ways[1] = onSide(metalScattering(metal, m, facet), m, 1);
    }
    if (const Transmission t = surfaceTransmission(scene, instance, hit.triangle, hit.u, hit.v)) {
        const BoundarySplit split = splitAtBoundary(t, m.normal, m.toLight, m.inside, facet);
        const float mirrored = t.share * split.reflectance * split.mirroredShare;
        ways[2] = onSide({split.mirrored, glm::vec3(mirrored)}, m, 1);
        ways[3] = onSide(
            {split.refracted, t.tint * ((1 - split.reflectance) * split.refractedShare)}, m, -1);
    }
    return ways;
}

/// Selects one of the ways on in proportion to the power that it keeps, and divides its weight by
/// the probability.
Scattering pickScattering(const std::array<Scattering, 4>& ways, glm::vec3 power, float pick) {
    std::array<float, 4> share;
    float sum = 0;
    for (std::size_t i = 0; i < ways.size(); ++i)
        sum += share[i] = channelSum(power * ways[i].weight) / channelSum(power);
    float rest = pick * std::max(sum, 1.f); // beyond the sum: absorbed
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (rest < share[i]) {
            Scattering way = ways[i];
            way.weight *= std::max(sum, 1.f) / share[i];
            return way;
        }
        rest -= share[i];
    }
    return {};
}

} // namespace

float PhotonHit::shadingRatio() const {
    const float geometric = glm::dot(surface.geometricNormal, toLight);
    return geometric > 0 ? std::max(glm::dot(surface.normal, toLight), 0.f) / geometric : 0;
}

void tracePhoton(const TraceScene& trace, const LightSources& sources, std::uint32_t maxBounces,
                 const Sampler& sampler, std::vector<PhotonHit>& hits, std::uint64_t& rays) {
    const Emission emission = sampleEmission(trace, sources, sampler);
    PhotonHit photon{.power = emission.power, .bounces = emission.isLamp ? 0U : 1U};
    Ray ray = emission.ray;
    std::uint32_t specular = 0, dimension = kEmissionDimensions;
    while (channelSum(photon.power) > 0 && photon.bounces <= maxBounces &&
           specular <= kMaxSpecular) {
        ++rays;
        const Hit hit = trace.closestHit(ray, TraceMask::Seen);
        if (!hit)
            return;
        if (dimension == kEmissionDimensions) {
            photon.power = powerAt(trace.scene(), emission, hit.position);
            if (!(channelSum(photon.power) > 0))
                return;
        }
        const Meeting meeting = meetingOf(trace, hit, ray.direction);
        if (meeting.isShaded()) {
            photon.surface = *meeting.point;
            photon.toLight = meeting.toLight;
            hits.push_back(photon);
        }
        const Scattering way =
            pickScattering(scatterings(trace.scene(), hit, meeting, photon, sampler, dimension),
                           photon.power, sampler.pair(dimension).x);
        const float side = glm::dot(way.direction, meeting.geometricNormal) > 0 ? 1.f : -1.f;
        const float offset = side * trace.epsilonAt(hit.position);
        ray = {hit.position + offset * meeting.geometricNormal, way.direction};
        photon.power *= way.weight;
        photon.isCaustic = !way.isDiffuse;
        photon.bounces += way.isDiffuse ? 1 : 0;
        specular = way.isDiffuse ? 0 : specular + 1;
        dimension += kDimensionsPerHit;
    }
}

} // namespace limn
