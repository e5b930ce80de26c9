// SPDX-License-Identifier: MIT
#include "engine/gallery/random_stream.h"
#include "engine/scene/reach.h"
#include "engine/techniques/illuminance/stress/oracle.h"
#include "engine/techniques/illuminance/stress/scene_change.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace limn {

namespace {

/// Mean radiosity over the area, per colour, of light that is reflected at most twice, and its
/// variance as if surfels and texels were drawn at random.
struct MeanLight {
    glm::dvec3 mean{0}, variance{0};
};

/// Two reflections only: in a closed white room each passes on nearly all light, so all of them
/// together would be a hundred times as noisy.
MeanLight meanLight(const LitScene& s, const Progress& progress) {
    const Surfels& surfels = s.bake->surfels;
    const auto once = lightOf(s.bake, s.scene, *s.trace, 1, progress).radiosity;
    const auto twice = lightOf(s.bake, s.scene, *s.trace, 2, progress).radiosity;
    MeanLight out;
    double area = 0;
    glm::dvec3 bounced(0);
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const double a = double(surfels.area[i]);
        out.mean += a * glm::dvec3(glm::vec3(twice[i]));
        bounced += a * glm::dvec3(glm::vec3(twice[i]) - glm::vec3(once[i]));
        area += a;
    }
    out.mean /= area;
    bounced /= area;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const double share = double(surfels.area[i]) / area;
        const glm::dvec3 d = share * (glm::dvec3(glm::vec3(twice[i])) - out.mean);
        out.variance += d * d;
    }
    // Bounced light comes from few texels.
    out.variance += bounced * bounced / double(std::max(s.bake->caches.lightmapCount, 1U));
    return out;
}

/// Difference of the mean light of two bakes of one scene, in standard deviations. A thousandth of
/// the light is allowed for rounding.
double deviations(const LitScene& a, const LitScene& b, const Progress& progress) {
    const MeanLight x = meanLight(a, progress), y = meanLight(b, progress);
    double maximum = 0;
    for (int c = 0; c < 3; ++c) {
        const double rounding = 1e-3 * (x.mean[c] + y.mean[c]) + 1e-30;
        const double sigma = std::sqrt(x.variance[c] + y.variance[c] + rounding * rounding);
        raise(maximum, std::abs(x.mean[c] - y.mean[c]) / sigma);
    }
    return maximum;
}

/// Surfels and rays are drawn differently in the changed scene, so only means can be compared. Six
/// standard deviations are exceeded with a chance of 1 in 10^9.
Judgement judgeAlike(const Subject& subject, const Scene& changed) {
    const Result<LitScene> other = bakeAndLight(changed, subject.progress);
    return other ? judged(deviations(subject.base, *other, subject.progress), 6) : broken();
}

/// Distance of a scene from the origin, in units of its size.
double sizesAway(const Scene& scene) {
    const Bounds b = scene.bounds;
    const double size = double(glm::length(b.size()));
    return size > 0 ? double(glm::length(b.centre())) / size
                    : std::numeric_limits<double>::infinity();
}

/// Scaling by a power of two changes no rounding, so only constants with a unit can cause a
/// difference. The light is the same within the design's 1e-3, in every surfel.
Judgement judgeScale(const Subject& subject) {
    const Scene& scene = subject.base.scene;
    RandomStream random(subject.seed + 1);
    const double size = double(glm::length(scene.bounds.size()));
    const int limit = size < 1 ? 13 : -13; // towards the other end of the allowed scene sizes
    const float s = std::exp2(float(random.whole(std::min(1, limit), std::max(-1, limit))));
    const Scene scaled = scaledScene(scene, s);
    for (const Light& l : scaled.lights)
        if (l.strength > kMaxLight ||
            (l.kind == LightKind::Rectangle && (std::min(l.size.x, l.size.y) < kMinLightSize ||
                                                std::max(l.size.x, l.size.y) > kMaxLightSize)))
            return notJudged();
    if (scaled.bake.texelsPerMetre >= 1e6f)
        return notJudged();
    const Result<LitScene> other = bakeAndLight(scaled, subject.progress);
    if (!other || other->bake->surfels.size() != subject.base.bake->surfels.size())
        return broken();
    double difference = 0, all = 1e-30;
    for (std::size_t i = 0; i < other->bake->surfels.size(); ++i) {
        const double a = double(subject.base.bake->surfels.area[i]);
        const glm::dvec3 x(glm::vec3(subject.base.light.radiosity[i])),
            y(glm::vec3(other->light.radiosity[i]));
        difference += a * glm::length(x - y);
        all += a * glm::length(x);
    }
    return judged(difference / all, 1e-3);
}

/// Maximum distance, so that 24 bits of a coordinate still distinguish the parts of a scene.
constexpr double kMaxSizesAway = 100;

Judgement judgeTranslation(const Subject& subject) {
    const Scene& scene = subject.base.scene;
    if (sizesAway(scene) > kMaxSizesAway)
        return notJudged();
    RandomStream random(subject.seed + 2);
    const glm::dvec3 offset(random.between(-8, 8), random.between(-8, 8), random.between(-8, 8));
    const double size = double(glm::length(scene.bounds.size()));
    return judgeAlike(subject, movedScene(scene, glm::vec3(offset * size)));
}

/// Moves up to 2^24 sizes away, where floats relative to the file's origin could not distinguish
/// the scene's parts. The document says where its world space lies.
Judgement judgeFar(const Subject& subject) {
    const Scene& scene = subject.base.scene;
    if (!subject.document || sizesAway(scene) > kMaxSizesAway)
        return notJudged();
    RandomStream random(subject.seed + 6);
    const glm::dvec3 way(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    const double size = double(glm::length(scene.bounds.size()));
    const glm::dvec3 offset = way * size * std::exp2(random.between(4, 24));
    const Document moved = movedDocument(*subject.document, scene.assets->meshes, offset);
    const Scene far = flatten(moved, scene.assets);
    if (moved.origin == glm::dvec3(0) || !reachDefect(far).empty())
        return notJudged(); // nothing is static, or it is not far for what is
    return judgeAlike(subject, far);
}

/// Permutes the axes, x to y to z, which rounds no coordinate.
Judgement judgeAxes(const Subject& subject) {
    if (!isEven(subject.base.scene.sky))
        return notJudged();
    const glm::mat3 turn(glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0));
    return judgeAlike(subject, turnedScene(subject.base.scene, turn));
}

/// Rotates the scene, about the vertical axis where the sky defines which way is up.
Judgement judgeTurn(const Subject& subject) {
    const Scene& scene = subject.base.scene;
    if (sizesAway(scene) > kMaxSizesAway)
        return notJudged();
    RandomStream random(subject.seed + 3);
    glm::vec3 axis(0, 1, 0);
    if (isEven(scene.sky))
        axis = glm::normalize(glm::vec3(float(random.number()) + 0.1f, float(random.number()),
                                        float(random.number())));
    const glm::quat turn = glm::angleAxis(float(random.between(0, 6.28)), axis);
    return judgeAlike(subject, turnedScene(scene, glm::mat3_cast(turn)));
}

Judgement judgeTriangles(const Subject& subject) {
    return judgeAlike(subject, withTrianglesShuffled(subject.base.scene, subject.seed + 4));
}

Judgement judgeObjects(const Subject& subject) {
    if (subject.base.scene.instances.size() < 2)
        return notJudged();
    return judgeAlike(subject, withObjectsShuffled(subject.base.scene, subject.seed + 5));
}

} // namespace

void addChangeOracles(std::vector<Oracle>& to) {
    to.push_back({"scale", "A scene 2^n times as large is lit alike.", judgeScale});
    to.push_back({"translation", "A scene elsewhere is lit alike.", judgeTranslation});
    to.push_back({"far", "A scene far from its file's origin is lit alike.", judgeFar});
    to.push_back({"axes", "A scene with its axes swapped is lit alike.", judgeAxes});
    to.push_back({"turn", "A scene turned by any angle is lit alike.", judgeTurn});
    to.push_back({"triangles", "The order of triangles changes no light.", judgeTriangles});
    to.push_back({"objects", "The order of objects changes no light.", judgeObjects});
}

} // namespace limn
