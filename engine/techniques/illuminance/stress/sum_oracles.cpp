// SPDX-License-Identifier: MIT
#include "engine/gallery/random_stream.h"
#include "engine/techniques/illuminance/stress/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace limn {

namespace {

/// The scene with all light k times as strong.
Scene brighter(Scene scene, float k) {
    for (Light& l : scene.lights)
        l.strength *= k;
    for (Material& m : scene.materials)
        m.emission *= k;
    scene.sky.radiance *= k;
    scene.sky.horizon *= k;
    scene.sky.ground *= k;
    return scene;
}

/// A power of two changes no rounding, so all light is exactly k times what it was. Subnormal
/// numbers, below 1.2e-38, are lost, and sums with such terms may miss them.
Judgement judgeBrightness(const Subject& subject) {
    const LitScene& s = subject.base;
    RandomStream random(subject.seed + 6);
    const float k = std::exp2(float(random.whole(-8, 8)));
    const Scene scene = brighter(s.scene, k);
    const RelitState light =
        lightOf(s.bake, scene, *s.trace, scene.relight.maxBounces, subject.progress);
    if (light.sh.size() != s.light.sh.size())
        return broken();
    constexpr float kFlushed = 1e-30f;
    std::uint64_t different = 0;
    for (std::size_t i = 0; i < light.sh.size(); ++i)
        for (int c = 0; c < 3; ++c)
            different += !(std::abs(light.sh[i][c] - k * s.light.sh[i][c]) <= kFlushed);
    return judged(double(different), 0);
}

std::uint32_t maxLinks(const Caches& caches) {
    std::uint32_t maximum = 0;
    for (std::size_t c = 0; c < caches.size(); ++c)
        maximum = std::max(maximum, caches.linkBegin[c + 1] - caches.linkBegin[c]);
    return maximum;
}

/// Maximum difference of sums of n links that are added in another order. With the lights' sums and
/// the way up the tree, some 40 more numbers, each sum rounds by sqrt(n + 40) / 4 + 1/2 units of
/// 2^-24 of the cache's light; no term exceeds its first coefficient by more than 4 times. Three
/// sums are compared, and six standard deviations are allowed.
double maxRoundings(const Caches& caches) {
    return 6 * std::sqrt(3.0) * (0.25 * std::sqrt(double(maxLinks(caches)) + 40) + 0.5);
}

/// The largest difference between a + b and `both`, in those units.
double roundings(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b,
                 const std::vector<glm::vec3>& both, std::size_t caches) {
    if (a.size() != both.size() || b.size() != both.size())
        return std::numeric_limits<double>::infinity();
    const std::size_t each = both.size() / std::max<std::size_t>(caches, 1);
    double worst = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        const glm::vec3 first = both[i - i % each];
        const double unit =
            4 * std::ldexp(double(std::max({first.x, first.y, first.z})), -24) + 1e-30;
        for (int c = 0; c < 3; ++c)
            raise(worst, std::abs(double(a[i][c]) + double(b[i][c]) - double(both[i][c])) / unit);
    }
    return worst;
}

/// SH of light that surfaces reflect once. It is linear in the lights, as no irradiance is clamped
/// yet.
std::vector<glm::vec3> reflectedOnce(const Subject& subject, const Scene& scene) {
    return lightOf(subject.base.bake, scene, *subject.base.trace, 1, subject.progress).sh;
}

/// Light from A and B together equals A plus B in every cache.
Judgement judgeAdditivity(const Subject& subject) {
    const Scene& scene = subject.base.scene;
    Scene a = scene, b = scene;
    for (std::size_t l = 0; l < a.lights.size(); ++l)
        (l % 2 == 0 ? b : a).lights[l].enabled = false;
    b.sky = {};
    for (Material& m : a.materials)
        m.emission = glm::vec3(0);
    const Caches& caches = subject.base.bake->caches;
    return judged(roundings(reflectedOnce(subject, a), reflectedOnce(subject, b),
                            reflectedOnce(subject, scene), caches.size()),
                  maxRoundings(caches));
}

/// Lights and materials in another order give the same light.
Judgement judgeOrder(const Subject& subject) {
    Scene scene = subject.base.scene;
    std::ranges::reverse(scene.lights);
    std::ranges::reverse(scene.materials);
    for (Instance& i : scene.instances)
        i.material = std::uint32_t(scene.materials.size()) - 1 - i.material;
    const std::vector<glm::vec3> other = reflectedOnce(subject, scene);
    const Caches& caches = subject.base.bake->caches;
    return judged(roundings(other, std::vector<glm::vec3>(other.size()),
                            reflectedOnce(subject, subject.base.scene), caches.size()),
                  maxRoundings(caches));
}

/// An edit of the scene as a step before it: other strengths, places, materials and sky.
Scene edited(Scene scene, RandomStream& random) {
    for (Light& l : scene.lights) {
        if (random.chance(0.3))
            l.strength *= float(std::exp(random.between(-10, 10)));
        if (random.chance(0.3))
            l.enabled = !l.enabled;
        if (random.chance(0.3))
            l.direction = -l.direction;
    }
    if (!scene.lights.empty() && random.chance(0.3))
        scene.lights.pop_back();
    for (Material& m : scene.materials) {
        if (random.chance(0.4))
            m.baseColor = glm::vec4(glm::vec3(float(random.number())), m.baseColor.w);
        if (random.chance(0.2))
            m.emission = glm::vec3(float(random.between(0, 100)));
    }
    scene.sky.radiance = glm::vec3(float(random.between(0, 10))); // at least this changes
    return scene;
}

/// The light of a scene does not depend on the edits that led to it. Up to eight bounces it is the
/// same bit by bit, because they restart with each change. More bounces continue from the earlier
/// light and end where the remaining change is 1e-4 of all light, whether edited or not.
Judgement judgeIncrements(const Subject& subject) {
    const LitScene& s = subject.base;
    RandomStream random(subject.seed + 7);
    Relighter relighter(s.bake);
    for (int k = 0; k < 3; ++k)
        relighter.relight(edited(s.scene, random), *s.trace,
                          std::min(s.scene.relight.maxBounces, 20U), subject.progress);
    const RelightStats stats =
        relighter.relight(s.scene, *s.trace, s.scene.relight.maxBounces, subject.progress);
    const RelitState light = lightOf(relighter, stats);
    if (s.scene.relight.maxBounces <= kFewBounces) {
        std::uint64_t different = light.sh.size() != s.light.sh.size();
        for (std::size_t i = 0; i < std::min(light.sh.size(), s.light.sh.size()); ++i)
            different += light.sh[i] != s.light.sh[i];
        return judged(double(different), 0);
    }
    const auto ended = [](const RelightStats& r) { return r.converged && !r.grows; };
    if (!ended(stats) || !ended(s.light.stats)) // growing light has no limit to compare
        return notJudged();
    double difference = 0, all = 1e-20; // light that was switched off fades by a factor per bounce
    for (std::size_t i = 0; i < s.bake->surfels.size(); ++i) {
        const glm::vec3 x(light.radiosity[i]), y(s.light.radiosity[i]), d = glm::abs(x - y);
        difference += double(d.x + d.y + d.z) * double(s.bake->surfels.area[i]);
        all += double(y.x + y.y + y.z) * double(s.bake->surfels.area[i]);
    }
    return judged(difference / all, 2e-4);
}

} // namespace

void addSumOracles(std::vector<Oracle>& to) {
    to.push_back(
        {"brightness", "Light 2^n times as strong is 2^n times as much.", judgeBrightness});
    to.push_back({"additivity", "Two lights together are the sum of each.", judgeAdditivity});
    to.push_back({"order", "The order of lights and materials changes no light.", judgeOrder});
    to.push_back({"increments", "Edits that lead to a scene leave its light.", judgeIncrements});
}

} // namespace limn
