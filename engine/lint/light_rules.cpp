// SPDX-License-Identifier: MIT
#include "engine/lint/light_rules.h"

#include "engine/core/parallel.h"
#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/scene/find_object.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/origin.h"
#include "engine/shading/emitters.h"
#include "engine/trace/direct_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

const LintRule kDarkSceneRule = {"dark-scene", Severity::Note, "Nothing lights the scene"};
const LintRule kZeroLightRule = {"zero-light", Severity::Note,
                                 "A light that is on has no strength or is black"};
const LintRule kUnseenLightRule = {"unseen-light", Severity::Warning,
                                   "No surface receives light from a light that is on"};
const LintRule kDimLightRule = {
    "dim-light", Severity::Warning,
    "A light is nowhere more than a hundredth of the direct light: its unit may be wrong"};
const LintRule kStrongLightRule = {"strong-light", Severity::Warning,
                                   "A light is brighter than the sun: its unit may be wrong"};

namespace {

/// Direct light at points spread over all surfaces [lux].
struct PointLight {
    std::vector<std::vector<float>> ofLight; ///< per light of the scene and point
    std::vector<float> whole;                ///< per point, with emissive surfaces and the sky
};

/// From emissive surfaces and the sky, by samples of both.
float emittedAt(const LintScene& in, const Emitters& emitters, const LintPoint& p,
                std::uint32_t seed) {
    constexpr std::uint32_t kSamples = 8;
    glm::vec3 sum(0);
    const DirectionSet directions(kSamples, false, seed);
    const glm::mat3 basis = basisAround(p.normal);
    for (std::uint32_t k = 0; k < kSamples; ++k) {
        const glm::vec3 d = basis * directions[k];
        if (!in.trace.closestHit({p.position, d}))
            sum += skyRadiance(in.scene.sky, d) * directions[k].z * directions.solidAngle(k);
        if (emitters.empty())
            continue;
        const std::uint32_t bits = mixBits(seed * kSamples + k);
        const glm::vec2 u(radicalInverse(k + 1, 2), unitFloat(mixBits(bits)));
        const EmitterSample s = sampleEmitter(emitters, in.scene, p.position, unitFloat(bits), u);
        const float cosine = glm::dot(glm::normalize(s.position - p.position), p.normal);
        if (s.pdf > 0 && cosine > 0 &&
            !in.trace.blocked(p.position, in.trace.clearOf(s.position, s.normal)))
            sum += s.radiance * (cosine / s.pdf / float(kSamples));
    }
    return luminance(sum);
}

PointLight lightAtPoints(const LintScene& in, const std::vector<LintPoint>& points,
                         const Progress& progress) {
    constexpr std::uint32_t kRectangleRays = 4;
    PointLight light;
    light.ofLight.assign(in.scene.lights.size(), std::vector<float>(points.size()));
    light.whole.resize(points.size());
    const Emitters emitters = findEmitters(in.trace);
    parallelRanges(points.size(), 16, progress, "lights", [&](std::size_t begin, std::size_t end) {
        std::uint64_t rays = 0;
        for (std::size_t k = begin; k < end; ++k) {
            const LintPoint& p = points[k];
            const auto seed = std::uint32_t(k);
            light.whole[k] = emittedAt(in, emitters, p, seed);
            const LitPoint lit{
                p.position, p.normal, {radicalInverse(seed + 1, 2), radicalInverse(seed + 1, 3)}};
            for (std::size_t l = 0; l < in.scene.lights.size(); ++l) {
                if (!shines(in.scene.lights[l]))
                    continue;
                const float lux = luminance(
                    shadowedLight(in.trace, in.scene.lights[l], lit, kRectangleRays, rays));
                light.ofLight[l][k] = lux;
                light.whole[k] += lux;
            }
        }
    });
    return light;
}

/// Whether a ray from the light meets a side of a surface that it lights. Points may miss what is
/// small or far away.
bool seesAnySurface(const LintScene& in, const Light& light) {
    constexpr std::uint32_t kRays = 4096;
    const bool sun = light.kind == LightKind::Directional;
    const bool around = light.kind == LightKind::Point && !profileOf(light);
    const DirectionSet directions(kRays, around, 1);
    const glm::mat3 basis = basisAround(around ? glm::vec3(0, 0, 1) : light.direction);
    const glm::vec3 centre = in.scene.bounds.centre();
    const float radius = glm::length(in.scene.bounds.size()) / 2;
    for (std::uint32_t k = 0; k < kRays; ++k) {
        const glm::vec2 u(radicalInverse(k + 1, 2), radicalInverse(k + 1, 3));
        Ray ray{light.position, basis * directions[k]};
        if (sun) {
            const float r = radius * std::sqrt(u.x), angle = 2 * std::numbers::pi_v<float> * u.y;
            ray.direction = light.direction;
            ray.origin = centre - light.direction * (2 * radius) +
                         basis * glm::vec3(r * std::cos(angle), r * std::sin(angle), 0);
        } else if (light.kind == LightKind::Rectangle) {
            ray.origin = lightRectangle(light).at(u) + light.direction * in.trace.epsilonAt(centre);
        }
        const Hit hit = in.trace.closestHit(ray);
        if (!hit)
            continue;
        const bool lit = hit.frontFace || isTwoSided(in.scene, in.scene.instances[hit.instance]);
        const bool far = light.kind == LightKind::Rectangle || sun
                             ? false
                             : sampleLight(light, hit.position).irradiance == glm::vec3(0);
        const glm::vec3 n = hit.geometricNormal * (hit.frontFace ? 1.f : -1.f);
        if (lit && !far && isOpen(in.trace, in.trace.clearOf(hit.position, n), n))
            return true;
    }
    return false;
}

class LightRules {
public:
    LightRules(const LintScene& in, std::vector<LintPoint> points, PointLight light)
        : m_in(in), m_points(std::move(points)), m_light(std::move(light)),
          m_ids(idsOf<Light>(in.document)) {}

    std::vector<Finding> find() {
        for (std::size_t l = 0; l < m_in.scene.lights.size(); ++l)
            if (m_in.scene.lights[l].enabled)
                findOf(l);
        findEmitters();
        return std::move(m_findings);
    }

private:
    void add(std::size_t l, const LintRule& rule, std::string problem, std::string advice) {
        const Light& light = m_in.scene.lights[l];
        Finding finding = findingAbout(m_in, rule, l < m_ids.size() ? m_ids[l] : 0,
                                       std::move(problem), std::move(advice));
        if (light.kind != LightKind::Directional)
            finding.place = toFile(m_in.scene.origin, light.position);
        m_findings.push_back(std::move(finding));
    }

    void findOf(std::size_t l) {
        const Light& light = m_in.scene.lights[l];
        if (!shines(light)) {
            add(l, kZeroLightRule, "It is on, but its strength is 0 or its colour black.",
                "Give it a strength, or switch it off.");
            return;
        }
        if (m_in.scene.instances.empty())
            return;
        float share = 0;
        std::vector<float> lux;
        for (std::size_t k = 0; k < m_points.size(); ++k)
            if (m_light.ofLight[l][k] > 0) {
                lux.push_back(m_light.ofLight[l][k]);
                share = std::max(share, m_light.ofLight[l][k] / m_light.whole[k]);
            }
        if (lux.empty() && !seesAnySurface(m_in, light))
            add(l, kUnseenLightRule, "No surface receives any light from it.",
                "Move it out of what encloses it, turn it towards the scene, or raise its range.");
        else if (!lux.empty() && share < kSeenShare)
            findDim(l, share);
        findStrong(l, lux);
    }

    void findDim(std::size_t l, float share) {
        const Light& light = m_in.scene.lights[l];
        const bool sun = light.kind == LightKind::Directional;
        add(l, kDimLightRule,
            fmt::format("It is nowhere more than {:.2g} % of the direct light.", 100 * share),
            sun ? fmt::format("Give it the strength of a sun, 20000 to 100000 lux, or remove it; "
                              "it has {:.3g} lux.",
                              light.strength * largestChannel(light.color))
                : "Check the unit of its strength, or remove it.");
    }

    void findStrong(std::size_t l, std::vector<float>& lux) {
        const Light& light = m_in.scene.lights[l];
        const float strength = light.strength * largestChannel(light.color);
        std::string problem;
        if (light.kind == LightKind::Directional && strength > kSunLux)
            problem =
                fmt::format("It gives {:.3g} lux, more than the sun above the air.", strength);
        else if (light.kind == LightKind::Rectangle && strength > kSunNits)
            problem = fmt::format("It has {:.3g} nits, more than the sun's disc.", strength);
        else if (light.kind != LightKind::Directional && light.kind != LightKind::Rectangle &&
                 strength >= kSearchlightCandela)
            problem = fmt::format("It has {:.3g} cd, as the largest searchlights have.", strength);
        else if (light.kind != LightKind::Directional && !lux.empty()) {
            const auto middle = lux.begin() + std::ptrdiff_t(lux.size() / 2);
            std::nth_element(lux.begin(), middle, lux.end());
            if (*middle > kSunLux)
                problem = fmt::format("Half of what it lights receives more than {:.3g} lux from "
                                      "it, more than from the sun.",
                                      *middle);
        }
        if (!problem.empty())
            add(l, kStrongLightRule, problem,
                "Check its unit: a bulb has some 60 cd or 800 lm, and watts are no candela.");
    }

    void findEmitters() {
        UsesByMaterial strong;
        for (const MeshUse& use : meshUses(m_in.scene))
            if (largestChannel(m_in.scene.materialOf(m_in.scene.instances[use.instance]).emission) >
                kSunNits)
                strong.add(m_in.scene, use);
        for (const auto& [material, use] : strong.uses()) {
            const Instance& instance = m_in.scene.instances[use.instance];
            Finding finding = findingAbout(
                m_in, kStrongLightRule, instance.node,
                fmt::format("Material \"{}\"{} emits {:.3g} nits, more than the sun's disc.",
                            m_in.scene.materials[material].name, othersText(use.count),
                            largestChannel(m_in.scene.materials[material].emission)),
                "Check its unit: a fluorescent tube has some 10000 nits.");
            finding.place = middleInFile(m_in.scene, instance);
            m_findings.push_back(std::move(finding));
        }
    }

    const LintScene& m_in;
    std::vector<LintPoint> m_points;
    PointLight m_light;
    std::vector<ObjectId> m_ids;
    std::vector<Finding> m_findings;
};

bool isDark(const Scene& scene) {
    return std::ranges::none_of(scene.lights, [](const Light& l) { return shines(l); }) &&
           std::ranges::none_of(scene.instances,
                                [&](const Instance& i) { return emits(scene.materialOf(i)); }) &&
           std::ranges::all_of(skyCellRadiance(scene.sky),
                               [](glm::vec3 radiance) { return radiance == glm::vec3(0); });
}

} // namespace

std::vector<Finding> lightFindings(const LintScene& in, const Progress& progress) {
    if (isDark(in.scene) && std::ranges::none_of(in.scene.lights, &Light::enabled))
        return {findingAbout(in, kDarkSceneRule, 0, "Nothing lights the scene.",
                             "Add a light or a sky; bakes need none.")};
    // Two million shadow rays take some seconds.
    constexpr std::size_t kPoints = 4096, kShadowRays = 2'000'000;
    const std::size_t lights = std::max<std::size_t>(in.scene.lights.size(), 1);
    std::vector<LintPoint> points =
        spreadPoints(in, std::clamp<std::size_t>(kShadowRays / lights, 64, kPoints));
    std::erase_if(points, [&](const LintPoint& p) { // within solids
        return !isOpen(in.trace, p.position, p.normal);
    });
    PointLight light = lightAtPoints(in, points, progress);
    if (progress.cancelled())
        return {};
    return LightRules(in, std::move(points), std::move(light)).find();
}

} // namespace limn
