// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_sources.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/rsm/reflective_shadow_map.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/surface/texture.h"
#include "engine/shading/sampler.h"
#include "engine/shading/sky_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

/// Unit normal of a triangle's front in the world.
glm::vec3 frontNormal(const Scene& scene, const Instance& instance, std::uint32_t triangle) {
    return glm::normalize(instance.normalToWorld *
                          triangleNormal(scene.meshOf(instance), triangle));
}

/// `side`: texels along a side of a view.
PathStart startOf(const Scene& scene, const RsmTexel& texel, std::uint32_t side) {
    const Instance& instance = scene.instances[texel.instance];
    PathStart start{.flight = {.origin = texel.position - texel.direction,
                               .direction = texel.direction,
                               .power = glm::vec3(texel.incident)},
                    .surface = {},
                    .instance = texel.instance,
                    .sample = (texel.view * side + texel.place.y) * side + texel.place.x};
    start.surface = photonSurface(
        scene, {.instance = texel.instance,
                .triangle = texel.triangle,
                .u = texel.u,
                .v = texel.v,
                .position = texel.position,
                .normal = texel.normal,
                .front = glm::dot(texel.normal, frontNormal(scene, instance, texel.triangle)) > 0});
    if (start.surface)
        start.surface->diffuse = texel.albedo; // the mean over the piece has less noise
    return start;
}

/// A side of a triangle that emits.
struct EmittingSide {
    std::uint32_t instance, triangle;
    float side;   ///< 1: the front, -1: the back
    double below; ///< area of the sides before this one [m^2]
};

/// The sides of a material's triangles; `area` becomes that of all.
std::vector<EmittingSide> emittingSides(const Scene& scene, std::uint32_t material, double& area) {
    std::vector<EmittingSide> sides;
    area = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.material != material)
            continue;
        for (std::uint32_t t = 0; t < scene.meshOf(instance).triangleCount(); ++t) {
            const auto size = double(triangleWorldArea(scene, instance, t));
            if (!(size > 0) || !std::isfinite(size))
                continue;
            for (const float side : {1.f, -1.f})
                if (side > 0 || isTwoSided(scene.materials[material])) {
                    sides.push_back({i, t, side, area});
                    area += size;
                }
        }
    }
    return sides;
}

/// The emissive texture at a point, without its factor; 0 in a hole.
glm::vec3 emissiveTexel(const Scene& scene, const Instance& instance, std::uint32_t triangle,
                        glm::vec2 b) {
    if (!(surfaceAlpha(scene, instance, triangle, b.x, b.y) > 0))
        return glm::vec3(0);
    const TextureRef& texture = scene.materialOf(instance).emissiveTexture;
    const Mesh& mesh = scene.meshOf(instance);
    const std::vector<glm::vec2>& uvs = mesh.uv(texture.texCoord);
    glm::vec2 uv(0);
    if (!uvs.empty()) {
        const std::array<std::uint32_t, 3> k = mesh.triangle(triangle);
        uv = (1 - b.x - b.y) * uvs[k[0]] + b.x * uvs[k[1]] + b.y * uvs[k[2]];
    }
    return glm::vec3(sampleTexture(*scene.assets, texture, uv, true));
}

} // namespace

std::uint32_t photonMapSide(const Light& light, const Bounds& bounds, std::uint32_t photons) {
    constexpr std::uint32_t kSide = 2; // of views to count; those of a rectangle have half of it
    std::uint32_t texels = 0;
    for (const RsmView& view :
         rsmViews(light, bounds, kSide, [](glm::vec3 p, glm::vec3) { return p; }))
        texels += view.size * view.size;
    const double side = kSide * std::sqrt(double(photons) / std::max(texels, 1U));
    return std::max(std::uint32_t(std::ceil(side - 1e-9)), 1U);
}

std::vector<PathStart> lightStarts(const PhotonScene& scene, const Light& light,
                                   const Progress& progress, std::uint64_t* rays) {
    const std::uint32_t side = photonMapSide(light, scene.scene.bounds, scene.settings.photons);
    const ReflectiveShadowMap map =
        castRsm(scene.trace, scene.scene, light, side, progress, RsmTexels::All);
    const std::uint32_t ofView = light.kind == LightKind::Rectangle ? std::max(side / 2, 1U) : side;
    std::vector<PathStart> starts(map.texels.size());
    parallelRanges(starts.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            starts[i] = startOf(scene.scene, map.texels[i], ofView);
    });
    if (rays)
        *rays += map.rays;
    return starts;
}

PhotonMap traceLight(const PhotonScene& scene, const Light& light, const Progress& progress) {
    std::uint64_t rays = 0;
    const std::vector<PathStart> starts = lightStarts(scene, light, progress, &rays);
    if (progress.cancelled())
        return {};
    PhotonMap photons = tracePaths(
        scene, std::uint32_t(starts.size()),
        [&](std::uint32_t path, PhotonMap&) { return starts[path]; }, progress);
    photons.fates.rays += rays;
    return photons;
}

PhotonMap traceEmitters(const PhotonScene& scene, std::uint32_t material,
                        const Progress& progress) {
    const std::uint32_t count = scene.settings.photons;
    double area = 0;
    const std::vector<EmittingSide> sides = emittingSides(scene.scene, material, area);
    if (sides.empty())
        return {};
    const auto start = [&](std::uint32_t path, PhotonMap& map) -> std::optional<PathStart> {
        const Sampler sampler{0, path};
        const double place = (double(path) + double(sampler.pair(0).x)) / double(count) * area;
        const EmittingSide& on =
            *std::prev(std::ranges::upper_bound(sides, place, {}, &EmittingSide::below));
        const Instance& instance = scene.scene.instances[on.instance];
        const glm::vec2 b = sampleTriangle(sampler.pair(1));
        const glm::vec3 radiance = emissiveTexel(scene.scene, instance, on.triangle, b);
        if (!(radiance.x + radiance.y + radiance.z > 0))
            return std::nullopt;
        const glm::vec3 n = on.side * frontNormal(scene.scene, instance, on.triangle);
        const glm::vec3 position(
            instance.toWorld *
            glm::vec4(trianglePoint(scene.scene.meshOf(instance), on.triangle, b), 1));
        map.vertices.push_back(
            {.position = position, .instance = on.instance, .event = PhotonEvent::Emitted});
        return PathStart{.flight = {.origin = scene.trace.clearOf(position, n),
                                    .direction = sampleCosineHemisphere(n, sampler.pair(2)),
                                    .power = radiance * (glm::pi<float>() * float(area / count)),
                                    .vertex = std::uint32_t(map.vertices.size() - 1)},
                         .surface = {},
                         .sample = path};
    };
    return tracePaths(scene, count, start, progress);
}

PhotonMap traceSky(const PhotonScene& scene, const Progress& progress) {
    const Bounds& bounds = scene.scene.bounds;
    const float radius = glm::length(bounds.size()) / 2;
    if (!(radius > 0))
        return {};
    const std::uint32_t count = scene.settings.photons;
    const Sky& sky = scene.scene.sky;
    const SkyLight light = findSkyLight(sky);
    const auto start = [&](std::uint32_t path, PhotonMap&) -> std::optional<PathStart> {
        const Sampler sampler{0, path};
        const glm::vec2 u = sampler.pair(0), v = sampler.pair(1);
        const float height = 1 - 2 * u.x;
        SkySample from{
            directionAbout({0, 1, 0}, std::sqrt(std::max(1 - height * height, 0.f)), height, u.y),
            {},
            1 / (4 * glm::pi<float>())};
        if (light.empty())
            from.radiance = skyRadiance(sky, from.direction);
        else
            from = sampleSky(light, sky, u);
        if (!(from.radiance.x + from.radiance.y + from.radiance.z > 0))
            return std::nullopt;
        const glm::vec3 across = directionAbout(from.direction, radius * std::sqrt(v.x), 0, v.y);
        const float share = glm::pi<float>() * radius * radius / (from.pdf * float(count));
        return PathStart{
            .flight = {.origin = bounds.centre() + from.direction * (1.01f * radius) + across,
                       .direction = -from.direction,
                       .power = from.radiance * share},
            .surface = {},
            .sample = path};
    };
    return tracePaths(scene, count, start, progress);
}

PhotonMap tracePhotons(const PhotonScene& scene, const PhotonSource& source,
                       const Progress& progress) {
    switch (source.origin) {
    case PhotonOrigin::Light:
        return traceLight(scene, source.shape, progress);
    case PhotonOrigin::Emitters:
        return traceEmitters(scene, source.material, progress);
    case PhotonOrigin::Sky:
        return traceSky(scene, progress);
    }
    return {};
}

} // namespace limn
