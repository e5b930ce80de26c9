// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/cut/training_light.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kSuns = TracedTraining::kSuns, kLamps = TracedTraining::kLamps, kSkies = 4,
                        kEmitters = 8;
static_assert(kSuns + kLamps + kSkies + kEmitters == TrainingLight::kCount);

/// Suns and lamps may be anywhere, but emitters have fixed places, so their light counts for more.
/// At 64 links the error of the cut in Cornell under its own light is 0.0051 with 1, 0.0004 with
/// 16; with a lamp in the air 0.0349 and 0.0346.
constexpr float kEmitterWeight = 16;

/// The sky's light also counts for more, because most scenes have one. Error of the cut at 64 links
/// in a living room under an even sky, with 1 and 4: 0.0158 and 0.0145, the paper's cut 0.0146; in
/// sunlit Sponza 0.207 and 0.212, 0.310.
constexpr float kSkyWeight = 4;

std::vector<Light> suns() {
    std::vector<Light> result;
    const DirectionSet upward(kSuns, false, 1);
    for (std::uint32_t k = 0; k < kSuns; ++k) {
        const glm::vec3 d = upward[k];
        Light sun;
        sun.kind = LightKind::Directional;
        sun.direction = -glm::vec3(d.x, d.z, d.y);
        sun.strength = 1;
        result.push_back(sun);
    }
    return result;
}

/// Each lamp hangs between a surfel and what it faces, and thus in free space, at a fifth to a half
/// of the way: with all of them half way, few were near walls. Surfels divide the area evenly, so
/// lamps are spread evenly over the rooms.
std::vector<Light> lamps(const TraceScene& trace, const Surfels& surfels) {
    std::vector<Light> result;
    const float extent = glm::length(staticBounds(trace.scene()).size());
    for (std::uint32_t k = 0; k < kLamps; ++k) {
        const std::size_t s = (2 * k + 1) * surfels.size() / (2 * kLamps);
        const glm::vec3 p = surfels.position[s], n = surfels.normal[s];
        const Hit hit = trace.closestHit({trace.clearOf(p, n), n}, TraceMask::Static);
        Light lamp;
        lamp.kind = LightKind::Point;
        lamp.position = p + n * ((hit ? hit.t : extent / 4) * (0.2f + 0.3f * radicalInverse(k, 2)));
        lamp.strength = 1;
        result.push_back(lamp);
    }
    return result;
}

bool meets(const Ray& ray, const std::vector<BoundingSphere>& spheres) {
    return std::any_of(spheres.begin(), spheres.end(), [&](const BoundingSphere& s) {
        const glm::vec3 way = s.centre - ray.origin;
        const float along = std::clamp(glm::dot(way, ray.direction), 0.f, ray.tFar);
        const glm::vec3 apart = way - ray.direction * along;
        return glm::dot(apart, apart) <= s.radius * s.radius;
    });
}

/// Computes the training irradiance of single surfels.
struct IrradianceTracer {
    const TraceScene& trace;
    const Surfels& surfels;
    std::vector<Light> lights;
    const EarlierTraining* earlier;
    std::vector<bool> sameLight; ///< as in `earlier`

    /// Adds the shadow ray, where one is needed, to `rays`.
    float irradiance(std::size_t s, std::size_t light, std::uint64_t& rays) const {
        const glm::vec3 p = surfels.position[s], n = surfels.normal[s];
        const LightSample sample = sampleLight(lights[light], p);
        const float cosTheta = glm::dot(n, sample.toLight);
        if (!(cosTheta > 0) || !(sample.irradiance.x > 0))
            return 0;
        const Ray ray{trace.clearOf(p, n), sample.toLight, 0, sample.distance - trace.epsilonAt(p)};
        if (earlier && sameLight[light] && !earlier->moved.elsewhere[s] &&
            earlier->light.position[s] == p && !meets(ray, earlier->moved.places))
            return earlier->light.irradiance[s * TracedTraining::kCount + light];
        ++rays;
        return trace.occluded(ray, TraceMask::Static) ? 0 : sample.irradiance.x * cosTheta;
    }
};

/// Index of each emissive instance, counted from 0; ~0 for the others.
std::vector<std::uint32_t> emitterNumbers(const Scene& scene) {
    std::vector<std::uint32_t> result;
    std::uint32_t next = 0;
    for (const Instance& i : scene.instances) {
        const glm::vec3 e = scene.materialOf(i).emission;
        result.push_back(e.x > 0 || e.y > 0 || e.z > 0 ? next++ : ~0U);
    }
    return result;
}

void lightSurfels(const Scene& scene, const Surfels& surfels, const TracedTraining& traced,
                  TrainingLight& out) {
    const std::vector<std::uint32_t> emitters = emitterNumbers(scene);
    for (std::size_t s = 0; s < surfels.size(); ++s) {
        float* row = out.radiosity.data() + s * TrainingLight::kCount;
        std::copy_n(traced.irradiance.data() + s * TracedTraining::kCount, TracedTraining::kCount,
                    row);
        if (const std::uint32_t e = emitters[surfels.instance[s]]; e != ~0U)
            row[kSuns + kLamps + kSkies + e % kEmitters] = 1;
    }
}

/// Sets the sky lightings: an even sky, and skies that are brighter towards three sides.
void lightSky(const ClusterTree& tree, TrainingLight& out) {
    for (std::uint32_t c = 0; c < tree.skyCells; ++c) {
        const glm::vec3 d = tree.skyDirection[c];
        float* row = out.radiosity.data() + std::size_t(tree.surfels + c) * TrainingLight::kCount +
                     kSuns + kLamps;
        row[0] = 1;
        row[1] = std::max(d.y, 0.f);
        row[2] = std::max(d.x, 0.f);
        row[3] = std::max(d.z, 0.f);
    }
}

/// Scales each lighting to a given mean square, not to a mean of 1: a lighting that lights little
/// would be bright there, and its errors would outweigh all others. With a mean of 1, and the best
/// prior for that, the error of the cut at 32 and 256 links was 0.096 and 0.0116 in Cornell with a
/// lamp, 0.36 and 0.0134 in sunlit Sponza; with this scaling it is 0.072 and 0.0092, 0.28 and
/// 0.0113.
void normalise(const std::vector<float>& importance, TrainingLight& out) {
    double squares[TrainingLight::kCount] = {}, total = 0;
    for (std::size_t leaf = 0; leaf < importance.size(); ++leaf) {
        const float* row = out.row(std::uint32_t(leaf));
        total += double(importance[leaf]);
        for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t)
            squares[t] += double(importance[leaf]) * double(row[t]) * double(row[t]);
    }
    float scale[TrainingLight::kCount];
    for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t) {
        scale[t] =
            squares[t] > 0 ? float(std::sqrt(total / squares[t])) * TrainingLight::strength(t) : 0;
    }
    for (std::size_t leaf = 0; leaf < importance.size(); ++leaf) {
        float* row = out.radiosity.data() + leaf * TrainingLight::kCount;
        for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t)
            row[t] *= scale[t];
    }
}

void pull(const ClusterTree& tree, TrainingLight& out) {
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const float *l = out.row(tree.left[k]), *r = out.row(tree.right[k]);
        float* to = out.radiosity.data() + (tree.leaves() + k) * TrainingLight::kCount;
        const float w = tree.leftWeight[k];
        for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t)
            to[t] = r[t] + (l[t] - r[t]) * w;
        out.squaredWeights[tree.leaves() + k] =
            w * w * out.squaredWeights[tree.left[k]] +
            (1 - w) * (1 - w) * out.squaredWeights[tree.right[k]];
    }
}

} // namespace

float TrainingLight::strength(std::uint32_t t) {
    return t < kSuns + kLamps ? 1 : t < kSuns + kLamps + kSkies ? kSkyWeight : kEmitterWeight;
}

TracedTraining traceTraining(const TraceScene& trace, const Surfels& surfels,
                             const EarlierTraining* earlier, const Progress& progress) {
    TracedTraining result;
    IrradianceTracer tracer{trace, surfels, suns(), earlier, std::vector<bool>(kSuns, true)};
    const std::size_t values = surfels.size() * TracedTraining::kCount;
    if (earlier &&
        (earlier->light.irradiance.size() != values || earlier->light.lamps.size() != kLamps ||
         earlier->light.position.size() != surfels.size() ||
         earlier->moved.elsewhere.size() != surfels.size()))
        tracer.earlier = nullptr;
    for (const Light& lamp : lamps(trace, surfels)) {
        tracer.sameLight.push_back(tracer.earlier &&
                                   earlier->light.lamps[result.lamps.size()] == lamp.position);
        tracer.lights.push_back(lamp);
        result.lamps.push_back(lamp.position);
    }
    resizeLarge(result.irradiance, values);
    std::atomic<std::uint64_t> rays = kLamps;
    const bool done = parallelRanges(surfels.size(), 256, progress, "training",
                                     [&](std::size_t begin, std::size_t end) {
                                         std::uint64_t mine = 0;
                                         for (std::size_t s = begin; s < end; ++s)
                                             for (std::size_t k = 0; k < tracer.lights.size(); ++k)
                                                 result.irradiance[s * TracedTraining::kCount + k] =
                                                     tracer.irradiance(s, k, mine);
                                         rays += mine;
                                     });
    result.position = surfels.position;
    result.rays = rays;
    if (!done)
        return {};
    return result;
}

TrainingLight trainingLight(const Scene& scene, const Surfels& surfels, const ClusterTree& tree,
                            const std::vector<float>& importance, const TracedTraining& traced) {
    TrainingLight result;
    resizeLarge(result.radiosity, std::size_t(tree.size()) * TrainingLight::kCount);
    result.squaredWeights.assign(tree.size(), 1);
    lightSurfels(scene, surfels, traced, result);
    lightSky(tree, result);
    normalise(importance, result);
    pull(tree, result);
    return result;
}

} // namespace limn
