// SPDX-License-Identifier: MIT
#include "engine/gallery/random_stream.h"
#include "engine/stress/oracle.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

namespace {

/// All light k times as strong.
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

/// Times a power of two no number is rounded otherwise, so all of them are k times what they were,
/// exactly; but what is too weak for normal numbers, below 1.2e-38, is none, and sums of such
/// terms may miss some of it.
Judgement judgeBrightness(const Subject& subject) {
    const LitScene& s = subject.base;
    RandomStream random(subject.seed + 6);
    const float k = std::exp2(float(random.whole(-8, 8)));
    const Scene scene = brighter(s.scene, k);
    const Lighting light =
        lightOf(s.bake, scene, *s.trace, scene.bake.maxBounces, subject.progress);
    if (light.sh.size() != s.light.sh.size())
        return broken();
    constexpr float kFlushed = 1e-30f;
    std::uint64_t different = 0;
    for (std::size_t i = 0; i < light.sh.size(); ++i)
        for (int c = 0; c < 3; ++c)
            different += std::abs(light.sh[i][c] - k * s.light.sh[i][c]) > kFlushed;
    return judged(double(different), 0);
}

std::uint32_t mostLinks(const Caches& caches) {
    std::uint32_t most = 0;
    for (std::size_t c = 0; c < caches.size(); ++c)
        most = std::max(most, caches.linkBegin[c + 1] - caches.linkBegin[c]);
    return most;
}

/// Light that surfaces reflect once is linear, as no irradiance is clamped yet: A and B lit
/// together are A plus B, in every cache. Each of the three sums of n links rounds by sqrt(n) / 4 +
/// 1/2 units of 2^-24 of the cache's light, whose first coefficient no term of it exceeds by more
/// than 4; the sums of lights and of the tree add as many roundings as there are, some 30. Six
/// standard deviations are allowed.
Judgement judgeAdditivity(const Subject& subject) {
    const LitScene& s = subject.base;
    Scene a = s.scene, b = s.scene;
    for (std::size_t l = 0; l < a.lights.size(); ++l)
        (l % 2 == 0 ? b : a).lights[l].enabled = false;
    b.sky = {};
    for (Material& m : a.materials)
        m.emission = glm::vec3(0);
    const auto lit = [&](const Scene& scene) {
        return lightOf(s.bake, scene, *s.trace, 1, subject.progress).sh;
    };
    const std::vector<glm::vec3> ofA = lit(a), ofB = lit(b), both = lit(s.scene);
    if (ofA.size() != both.size() || ofB.size() != both.size())
        return broken();
    const double roundings = 0.25 * std::sqrt(double(mostLinks(s.bake->caches))) + 30;
    const std::size_t each = both.size() / std::max<std::size_t>(s.bake->caches.size(), 1);
    double worst = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        const glm::vec3 first = both[i - i % each];
        const double unit =
            4 * std::ldexp(double(std::max({first.x, first.y, first.z})), -24) + 1e-30;
        for (int c = 0; c < 3; ++c)
            worst = std::max(
                worst, std::abs(double(ofA[i][c]) + double(ofB[i][c]) - double(both[i][c])) / unit);
    }
    return judged(worst, 6 * std::sqrt(3.0) * roundings);
}

/// A scene on the way to that one: other strengths, places, materials and sky.
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
    if (random.chance(0.4))
        scene.sky.radiance = glm::vec3(float(random.between(0, 10)));
    return scene;
}

/// Edits that lead to a scene leave its light. Up to eight bounces, bit by bit: they begin anew
/// with each change. More go on from the light that was and end where what is to come is 1e-4 of
/// all light, on either way.
Judgement judgeIncrements(const Subject& subject) {
    const LitScene& s = subject.base;
    RandomStream random(subject.seed + 7);
    Relighter relighter(s.bake);
    for (int k = 0; k < 3; ++k)
        relighter.relight(edited(s.scene, random), *s.trace, std::min(s.scene.bake.maxBounces, 20U),
                          subject.progress);
    const RelightStats stats =
        relighter.relight(s.scene, *s.trace, s.scene.bake.maxBounces, subject.progress);
    const Lighting light = lightOf(relighter, stats);
    constexpr std::uint32_t kFewBounces = 8;
    if (s.scene.bake.maxBounces <= kFewBounces) {
        std::uint64_t different = light.sh.size() != s.light.sh.size();
        for (std::size_t i = 0; i < std::min(light.sh.size(), s.light.sh.size()); ++i)
            different += light.sh[i] != s.light.sh[i];
        return judged(double(different), 0);
    }
    if (!stats.converged || !s.light.stats.converged)
        return notJudged();
    double difference = 0, all = 1e-30;
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
    to.push_back({"increments", "Edits that lead to a scene leave its light.", judgeIncrements});
}

} // namespace limn
