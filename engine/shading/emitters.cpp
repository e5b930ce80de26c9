// SPDX-License-Identifier: MIT
#include "engine/shading/emitters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// Maps the unit square to uniform barycentrics by folding it at its diagonal.
glm::vec2 foldToTriangle(glm::vec2 u) {
    return u.x + u.y > 1 ? glm::vec2(1 - u.x, 1 - u.y) : u;
}

/// Mean emission of a textured emitter on a lattice of points. If it misses a bright spot, only the
/// sampling probability is less suitable: rays that hit the spot by chance still carry its light.
double meanEmission(const Scene& scene, const Instance& instance, std::uint32_t triangle) {
    const Material& material = scene.materialOf(instance);
    const bool varies = material.emissiveTexture.image >= 0 || isCutout(material);
    const int n = varies ? 8 : 1;
    double sum = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const glm::vec2 b =
                foldToTriangle({(float(x) + 0.5f) / float(n), (float(y) + 0.25f) / float(n)});
            const SurfaceMaterial s = surfaceMaterial(scene, instance, triangle, b.x, b.y);
            if (s.alpha > 0)
                sum += double(channelSum(s.emission));
        }
    return sum / (n * n);
}

EmissiveTriangle worldTriangle(const Scene& scene, std::uint32_t i, std::uint32_t t) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshOf(instance);
    const std::array<std::uint32_t, 3> k = mesh.triangle(t);
    const glm::mat3 linear(instance.toWorld);
    EmissiveTriangle e;
    e.instance = i;
    e.triangle = t;
    e.corner = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[k[0]], 1));
    e.edge1 = linear * (mesh.positions[k[1]] - mesh.positions[k[0]]);
    e.edge2 = linear * (mesh.positions[k[2]] - mesh.positions[k[0]]);
    const glm::vec3 n = glm::cross(e.edge1, e.edge2);
    const float length = glm::length(n);
    e.area = length / 2;
    if (length > 0)
        e.normal = n / (glm::determinant(linear) < 0 ? -length : length);
    e.bothSides = scene.materialOf(instance).doubleSided;
    return e;
}

} // namespace

Emitters findEmitters(const TraceScene& trace) {
    const Scene& scene = trace.scene();
    Emitters emitters;
    emitters.firstOf.assign(scene.instances.size(), ~0u);
    double sum = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!(channelSum(scene.materialOf(instance).emission) > 0))
            continue;
        const std::size_t count = scene.meshOf(instance).triangleCount();
        emitters.firstOf[i] = std::uint32_t(emitters.emitterOf.size());
        emitters.emitterOf.resize(emitters.emitterOf.size() + count, ~0u);
        for (std::uint32_t t = 0; t < count; ++t) {
            const EmissiveTriangle e = worldTriangle(scene, i, t);
            const double power =
                double(e.area) * meanEmission(scene, instance, t) * (e.bothSides ? 2 : 1);
            if (!(power > 0) || !std::isfinite(power))
                continue;
            emitters.emitterOf[emitters.firstOf[i] + t] = std::uint32_t(emitters.triangles.size());
            emitters.triangles.push_back(e);
            emitters.cdf.push_back(sum += power);
        }
    }
    for (double& c : emitters.cdf)
        c /= sum;
    return emitters;
}

static double probability(const Emitters& emitters, std::size_t i) {
    return emitters.cdf[i] - (i > 0 ? emitters.cdf[i - 1] : 0);
}

/// Density of a point of emitter i in solid angle at `from` [sr^-1]; 0 if seen edge-on.
static float solidAnglePdf(const Emitters& emitters, std::size_t i, glm::vec3 point,
                           glm::vec3 from) {
    const EmissiveTriangle& e = emitters.triangles[i];
    const glm::vec3 way = point - from;
    const float d2 = glm::dot(way, way);
    const float cosTheta = std::abs(glm::dot(e.normal, way)) / std::sqrt(d2);
    return cosTheta > 0 ? float(probability(emitters, i)) / e.area * d2 / cosTheta : 0;
}

EmitterSample sampleEmitter(const Emitters& emitters, const Scene& scene, glm::vec3 from,
                            float pick, glm::vec2 u) {
    const auto found = std::upper_bound(emitters.cdf.begin(), emitters.cdf.end(), double(pick));
    const std::size_t i =
        std::min(std::size_t(found - emitters.cdf.begin()), emitters.cdf.size() - 1);
    const EmissiveTriangle& e = emitters.triangles[i];
    const glm::vec2 b = foldToTriangle(u);
    EmitterSample s;
    s.instance = e.instance;
    s.position = e.corner + b.x * e.edge1 + b.y * e.edge2;
    const bool front = glm::dot(e.normal, from - s.position) > 0;
    s.normal = front ? e.normal : -e.normal;
    if (!front && !e.bothSides)
        return s;
    const SurfaceMaterial m =
        surfaceMaterial(scene, scene.instances[e.instance], e.triangle, b.x, b.y);
    s.pdf = solidAnglePdf(emitters, i, s.position, from);
    if (m.alpha > 0 && s.pdf > 0)
        s.radiance = m.emission;
    return s;
}

float emitterPdf(const Emitters& emitters, const Hit& hit, glm::vec3 from) {
    const std::uint32_t first = emitters.firstOf[hit.instance];
    if (first == ~0u)
        return 0;
    const std::uint32_t i = emitters.emitterOf[first + hit.triangle];
    return i == ~0u ? 0 : solidAnglePdf(emitters, i, hit.position, from);
}

} // namespace limn
