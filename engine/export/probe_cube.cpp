// SPDX-License-Identifier: MIT
#include "engine/export/probe_cube.h"

#include "engine/core/parallel.h"
#include "engine/field/sample_field.h"
#include "engine/math/sampling.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/specular.h"
#include "engine/shading/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// A face of the cube: the direction to its middle, and those in which columns and rows grow.
struct Face {
    glm::vec3 middle, right, down;
};
constexpr std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                         {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                         {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

/// Centre of a texel on its face, in [-1, 1].
float coordinate(std::uint32_t size, std::size_t index) {
    return 2 * (float(index) + 0.5f) / float(size) - 1;
}

/// What a metal reflects beyond a dielectric; 0 for one of these.
glm::vec3 metalColor(const Scene& scene, const Hit& hit) {
    const Instance& instance = scene.instances[hit.instance];
    const Gloss gloss = surfaceGloss(scene, instance, hit.triangle, hit.u, hit.v);
    return glm::max(gloss.F0 - dielectricF0(scene.materialOf(instance).ior), glm::vec3(0));
}

/// Whether surfaces around the point show their backs, as they do inside of solid objects.
bool seesBacks(const ExportScene& in, glm::vec3 p) {
    constexpr std::uint32_t kRays = 64;
    const DirectionSet directions(kRays, true, 0);
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const Hit hit = in.trace.closestHit({.origin = p, .direction = directions[i]});
        if (hit && !surfacePoint(in.trace, hit))
            return true;
    }
    return false;
}

} // namespace

glm::vec3 cubeDirection(std::uint32_t size, std::size_t texel) {
    const Face& face = kFaces[texel / (std::size_t(size) * size)];
    return glm::normalize(face.middle + coordinate(size, texel % size) * face.right +
                          coordinate(size, texel / size % size) * face.down);
}

std::size_t cubeTexel(std::uint32_t size, glm::vec3 direction) {
    std::size_t best = 0;
    for (std::size_t f = 1; f < kFaces.size(); ++f)
        if (glm::dot(direction, kFaces[f].middle) > glm::dot(direction, kFaces[best].middle))
            best = f;
    const Face& face = kFaces[best];
    const float depth = glm::dot(direction, face.middle);
    const auto index = [&](glm::vec3 axis) {
        const float position = (glm::dot(direction, axis) / depth + 1) / 2 * float(size);
        return std::size_t(std::clamp(position, 0.f, float(size) - 0.5f));
    };
    return (best * size + index(face.down)) * size + index(face.right);
}

glm::vec3 probePosition(const ExportScene& scene) {
    const Bounds& bounds = scene.field.gridBounds;
    const glm::uvec3 n = scene.field.gridSize;
    const glm::vec3 middle = (bounds.lower + bounds.upper) / 2.f;
    std::vector<glm::vec3> centres;
    for (std::uint32_t z = 0; z < n.z; ++z)
        for (std::uint32_t y = 0; y < n.y; ++y)
            for (std::uint32_t x = 0; x < n.x; ++x)
                centres.push_back(bounds.lower +
                                  (glm::vec3(x, y, z) + 0.5f) / glm::vec3(n) * bounds.size());
    std::ranges::stable_sort(centres, {}, [&](glm::vec3 p) { return glm::distance(p, middle); });
    const auto open =
        std::ranges::find_if(centres, [&](glm::vec3 p) { return !seesBacks(scene, p); });
    return open != centres.end() ? *open : middle;
}

glm::vec3 radianceSeen(const ExportScene& scene, glm::vec3 p, glm::vec3 direction) {
    const Hit hit = scene.trace.closestHit({.origin = p, .direction = direction});
    if (!hit)
        return skyRadiance(scene.scene.sky, direction);
    const std::optional<SurfacePoint> s = surfacePoint(scene.trace, hit);
    if (!s)
        return glm::vec3(0);
    std::uint64_t rays = 0;
    const glm::vec3 e =
        sampleIrradiance({scene.field, scene.layout, scene.scene, hit.instance, hit.triangle, hit.u,
                          hit.v, s->position, s->normal, !hit.frontFace}) +
        directIrradiance(scene.trace, *s, rays);
    return s->emission + (s->albedo + metalColor(scene.scene, hit)) * e / std::numbers::pi_v<float>;
}

CubeMap cubeSeenFrom(const ExportScene& scene, glm::vec3 p, std::uint32_t size,
                     const Progress& progress) {
    CubeMap cube{.size = size, .rgb = {}};
    cube.rgb.resize(cube.texels());
    parallelRanges(cube.rgb.size(), 64, progress, "reflections",
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t t = begin; t < end; ++t)
                           cube.rgb[t] = radianceSeen(scene, p, cubeDirection(size, t));
                   });
    return cube;
}

CubeMap prefiltered(const CubeMap& cube, float alpha, std::uint32_t size) {
    struct Source {
        glm::vec3 direction;
        float solidAngle; ///< in some unit
    };
    std::vector<Source> sources(cube.texels());
    for (std::size_t t = 0; t < sources.size(); ++t) {
        const float x = coordinate(cube.size, t % cube.size);
        const float y = coordinate(cube.size, t / cube.size % cube.size);
        const float d2 = 1 + x * x + y * y;
        sources[t] = {cubeDirection(cube.size, t), 1 / (d2 * std::sqrt(d2))};
    }
    const float a2 = alpha * alpha;
    CubeMap blurred{.size = size, .rgb = {}};
    blurred.rgb.resize(blurred.texels());
    parallelRanges(blurred.rgb.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const glm::vec3 n = cubeDirection(size, t);
            glm::dvec3 sum(0);
            double weights = 0;
            for (std::size_t s = 0; s < sources.size(); ++s) {
                const float cosine = glm::dot(n, sources[s].direction);
                if (cosine <= 0)
                    continue;
                const float nh2 = (1 + cosine) / 2; // the half vector's cosine, squared
                const float d = nh2 * (a2 - 1) + 1;
                const double weight = double(a2 / (d * d) * cosine * sources[s].solidAngle);
                sum += weight * glm::dvec3(cube.rgb[s]);
                weights += weight;
            }
            blurred.rgb[t] = glm::vec3(sum / weights);
        }
    });
    return blurred;
}

CubeMap mirrored(const CubeMap& cube, glm::vec3 signs) {
    CubeMap other{.size = cube.size, .rgb = {}};
    other.rgb.resize(cube.rgb.size());
    for (std::size_t t = 0; t < other.rgb.size(); ++t)
        other.rgb[t] = cube.rgb[cubeTexel(cube.size, signs * cubeDirection(cube.size, t))];
    return other;
}

} // namespace limn
