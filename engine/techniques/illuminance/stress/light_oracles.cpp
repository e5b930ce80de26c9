// SPDX-License-Identifier: MIT
#include "engine/field/sample_field.h"
#include "engine/math/sampling.h"
#include "engine/techniques/illuminance/relight/surfel_light.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"
#include "engine/techniques/illuminance/stress/oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr double kPi = std::numbers::pi;

bool isFinite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

template <class Values>
std::uint64_t countNotFinite(const Values& values) {
    std::uint64_t count = 0;
    for (const auto& v : values)
        count += !isFinite(glm::vec3(v));
    return count;
}

double largest(glm::vec3 v) {
    return std::max({double(v.x), double(v.y), double(v.z)});
}

/// Counts NaN and infinities in the light of nodes, caches and the field.
Judgement judgeFinite(const Subject& subject) {
    const RelitState& l = subject.base.light;
    return judged(double(countNotFinite(l.radiosity) + countNotFinite(l.sh) +
                         countNotFinite(l.field.lightmap) + countNotFinite(l.field.grid)),
                  0);
}

/// Counts surfels of negative radiosity and corners of the surface with negative light.
Judgement judgeNotNegative(const Subject& subject) {
    const LitScene& s = subject.base;
    const auto isWrong = [](glm::vec3 v) { return !(v.x >= 0 && v.y >= 0 && v.z >= 0); };
    std::uint64_t wrong = 0;
    for (const glm::vec4& b : s.light.radiosity)
        wrong += isWrong(glm::vec3(b));
    for (std::uint32_t i = 0; i < s.scene.instances.size(); ++i) {
        const Instance& instance = s.scene.instances[i];
        const Mesh& mesh = s.scene.meshOf(instance);
        const std::size_t step = mesh.triangleCount() / 16 + 1;
        for (std::uint32_t t = 0; t < mesh.triangleCount(); t += std::uint32_t(step)) {
            const auto k = mesh.triangle(t);
            const glm::vec3 p(instance.toWorld * glm::vec4(mesh.positions[k[0]], 1));
            for (const float side : {1.f, -1.f}) {
                const glm::vec3 n = instance.normalToWorld * mesh.normals[k[0]] * side;
                if (!(glm::length(n) > 0) || !isFinite(n))
                    continue;
                wrong += isWrong(sampleIrradiance({s.light.field, s.bake->lightmap, s.scene, i, t,
                                                   0, 0, p, glm::normalize(n), side < 0}));
            }
        }
    }
    return judged(double(wrong), 0);
}

/// Radiosity of surfels from first light, without bounces [W m^-2].
struct FirstLight {
    std::vector<glm::vec3> radiosity;
    double maxAlbedo = 0, maxSky = 0; ///< pi times the sky's radiance
};

FirstLight firstLight(const LitScene& s) {
    FirstLight out;
    DirectIrradiance direct;
    std::vector<glm::vec3> albedo;
    surfelMaterials(s.bake->surfels, s.scene, albedo, out.radiosity);
    updateDirectIrradiance(s.bake->surfels, s.scene, *s.trace, direct);
    for (std::size_t i = 0; i < albedo.size(); ++i) {
        out.radiosity[i] += albedo[i] * direct.irradiance[i];
        out.maxAlbedo = std::max(out.maxAlbedo, largest(albedo[i]));
    }
    for (const glm::vec3 cell : skyRadiosity(s.bake->tree, s.scene.sky))
        out.maxSky = std::max(out.maxSky, largest(cell));
    return out;
}

/// Sums over all surfels and colours [W].
struct Flux {
    double sent = 0, given = 0; ///< with bounces, and by first light
    double area = 0;            ///< [m^2]
    double noise = 0;           ///< standard deviation of the light that arrives / the light sent
};

/// A surfel's light reaches others by rays that caches draw, about caches * rays / surfels of them.
/// Their number N has a relative standard deviation of 1 / sqrt(N), and where n surfels send alike
/// that of the sum is smaller by 1 / sqrt(n). The light that arrives is then read at the surfels'
/// places, with an error of 1 / sqrt of their number, or of the caches' where these are fewer,
/// times its unevenness.
double noiseOf(const LitScene& s, double senders) {
    const auto once = lightOf(s.bake, s.scene, *s.trace, 1, {}).radiosity;
    const auto twice = lightOf(s.bake, s.scene, *s.trace, 2, {}).radiosity;
    const auto surfels = double(s.bake->surfels.size()),
               caches = double(s.bake->caches.lightmapCount);
    double arrived = 0, squares = 0, area = 0;
    for (std::size_t i = 0; i < s.bake->surfels.size(); ++i) {
        const double a = double(s.bake->surfels.area[i]);
        const double e = largest(glm::vec3(twice[i]) - glm::vec3(once[i]));
        arrived += a * e;
        squares += a * e * e;
        area += a;
    }
    const double uneven = arrived > 0 ? std::max(squares * area / (arrived * arrived) - 1, 0.) : 0;
    return std::sqrt(surfels / (caches * double(s.scene.bake.rays) * senders) +
                     uneven / std::min(surfels, caches));
}

Flux fluxOf(const LitScene& s, const FirstLight& first) {
    const Surfels& surfels = s.bake->surfels;
    const auto sum = [](glm::vec3 v) { return double(v.x) + double(v.y) + double(v.z); };
    Flux flux;
    double squares = 0;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const double a = double(surfels.area[i]), b = a * sum(first.radiosity[i]);
        flux.sent += a * sum(glm::vec3(s.light.radiosity[i]));
        flux.given += b;
        squares += b * b;
        flux.area += a;
    }
    flux.noise = noiseOf(s, squares > 0 ? flux.given * flux.given / squares
                                        : double(std::max<std::size_t>(surfels.size(), 1)));
    return flux;
}

/// Ratio of all light that surfels send to its upper bound: first light, F, and the sky's, at most
/// albedo times pi L on all of the area, reflected any number of times: (F + albedo pi L A) / (1 -
/// albedo).
/// Six standard deviations of noise are allowed, and 2 % for normals that caches do not look along.
Judgement judgeEnergy(const Subject& subject) {
    const LitScene& s = subject.base;
    if (s.scene.bake.linker != Linker::Gather) // only gathered light sums to the light sent
        return notJudged();
    const FirstLight first = firstLight(s);
    const Flux flux = fluxOf(s, first);
    const double allowed =
        (flux.given + 3 * first.maxAlbedo * first.maxSky * flux.area) / (1 - first.maxAlbedo);
    if (!(allowed > 1e-30))
        return judged(flux.sent, 1e-30);
    return judged(flux.sent / allowed, 1.02 + 6 * flux.noise);
}

/// Surfaces send less than they receive, and gathered light is at most the light sent, so bounces
/// must never be stopped because light grows.
Judgement judgeGrowth(const Subject& subject) {
    if (subject.base.scene.bake.linker != Linker::Gather)
        return notJudged();
    return judged(subject.base.light.stats.grows ? subject.base.light.stats.passedOn : 0, 1);
}

/// The same scene without light and with albedo 1/2 everywhere. A scene with lamps is baked again,
/// because caches aim extra rays at lamps, whose sum equals the light seen only on average.
std::optional<LitScene> greyScene(const Subject& subject) {
    LitScene s = subject.base;
    bool lamps = false;
    for (Material& m : s.scene.materials) {
        lamps |= m.emission != glm::vec3(0);
        m.baseColor = glm::vec4(glm::vec3(0.5f), m.baseColor.w);
        m.metallic = m.transmission = 0;
        m.emission = glm::vec3(0);
    }
    s.scene.sky = {};
    s.scene.relight.maxBounces = 1000;
    if (!lamps)
        return s;
    Result<LitScene> again = bakeAndLight(s.scene, subject.progress);
    return again ? std::optional(std::move(*again)) : std::nullopt;
}

/// Judges a furnace: the grey scene where every surface has radiance 1 and there is no other light.
template <class Judge>
Judgement judgeFurnace(const Subject& subject, const Judge& judge) {
    std::optional<LitScene> s = greyScene(subject);
    if (!s)
        return broken();
    for (Material& m : s->scene.materials)
        m.emission = glm::vec3(1);
    s->scene.lights.clear();
    s->light = lightOf(s->bake, s->scene, *s->trace, 1000, subject.progress);
    return judge(*s);
}
constexpr double kFurnace = 2 * kPi; // pi L / (1 - albedo)

/// Whether all surfels read caches of their own normal: no smooth normals, no texels that wrap
/// around an edge.
bool looksAlong(const LitScene& s) {
    const Surfels& surfels = s.bake->surfels;
    for (std::size_t i = 0; i < surfels.size(); ++i)
        for (int k = 0; k < 4; ++k)
            if (const std::uint32_t cache = surfels.cache[i][k];
                cache != ~0U && surfels.cacheWeight[i][k] > 0 &&
                glm::dot(s.bake->caches.normal[cache], surfels.normal[i]) < 0.9999f)
                return false;
    return true;
}

/// A furnace has the same light everywhere, pi L / (1 - albedo), and less where it has openings.
/// Links are halfs that are scaled to be exact where a cache looks: 1 % is the design's bound.
/// Light to another normal has the error of its bands. In three, of a direction at an angle of
/// cosine c, K(c) = 1/4 + c/2 + 5/32 (3 c^2 - 1) is seen instead of max(c, 0); the scale is
/// c / K(c) <= 1.0878, and the integral of max(K, 0) 1.0307 pi, so of light from everywhere 1.121
/// times as much may arrive. In two, K(c) = 1/4 + c/2, and 4/3 * 9/8 = 1.5 times. Each bounce adds
/// that: 1/2 / (1 - 1.121 / 2) = 1.138, and 2.
Judgement judgeFurnaceMost(const Subject& subject) {
    if (subject.base.scene.bake.linker != Linker::Gather)
        return notJudged();
    return judgeFurnace(subject, [](const LitScene& s) {
        double maximum = 0;
        for (std::size_t i = 0; i < s.bake->surfels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                raise(maximum, double(s.light.radiosity[i][c]));
        const double elsewhere = s.bake->settings.bands < 3 ? 2 : 1.138;
        return judged(maximum / kFurnace, 1.01 * (looksAlong(s) ? 1 : elsewhere));
    });
}

/// Whether every ray from every surfel and surface cache meets the front of something static, and
/// no surfel reads light for a normal other than its cache's, part of whose hemisphere would lie
/// below the surface and be dark.
bool isClosed(const LitScene& s) {
    if (std::ranges::any_of(s.scene.instances, &Instance::dynamic) || !looksAlong(s))
        return false;
    std::uint32_t bits = 1;
    const auto isClosedAt = [&](glm::vec3 p, glm::vec3 n) {
        constexpr int kRays = 128;
        for (int k = 0; k < kRays; ++k) {
            glm::vec3 d;
            for (int c = 0; c < 3; ++c)
                d[c] = 2 * unitFloat(bits = mixBits(bits + 1)) - 1;
            if (!(glm::length(d) > 0.01f))
                continue;
            d = glm::normalize(d);
            const Hit hit =
                s.trace->closestHit({s.trace->clearOf(p, n), glm::dot(d, n) < 0 ? -d : d});
            if (!hit || (!hit.frontFace &&
                         !s.scene.materialOf(s.scene.instances[hit.instance]).doubleSided))
                return false;
        }
        return true;
    };
    const Surfels& surfels = s.bake->surfels;
    const Caches& caches = s.bake->caches;
    for (std::size_t i = 0; i < surfels.size(); ++i)
        if (!isClosedAt(surfels.position[i], surfels.normal[i]))
            return false;
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        if (!isClosedAt(caches.position[c], caches.normal[c]))
            return false;
    return true;
}

/// Lower bound everywhere in a closed furnace, with the tolerance that judgeFurnaceMost() allows
/// above.
Judgement judgeFurnaceLeast(const Subject& subject) {
    if (subject.base.scene.bake.linker != Linker::Gather || !isClosed(subject.base))
        return notJudged();
    return judgeFurnace(subject, [](const LitScene& s) {
        double missing = 0;
        for (std::size_t i = 0; i < s.bake->surfels.size(); ++i)
            raise(missing, 1 - double(s.light.radiosity[i].x) / kFurnace);
        return judged(missing, 0.01);
    });
}

/// No light leaves a closed room: with albedo 1/2 everywhere it sends twice its first light,
/// whatever lights it. The noise is that of judgeEnergy().
Judgement judgeBalance(const Subject& subject) {
    if (subject.base.scene.bake.linker != Linker::Gather || !isClosed(subject.base))
        return notJudged();
    std::optional<LitScene> s = greyScene(subject);
    if (!s)
        return broken();
    s->light = lightOf(s->bake, s->scene, *s->trace, 1000, subject.progress);
    const Flux flux = fluxOf(*s, firstLight(*s));
    if (!(flux.given > 1e-30))
        return notJudged();
    return judged(std::abs(flux.sent / (2 * flux.given) - 1), 0.02 + 6 * flux.noise);
}

} // namespace

void addLightOracles(std::vector<Oracle>& to) {
    to.push_back({"finite", "No number of the light is NaN or infinite.", judgeFinite});
    to.push_back({"not_negative", "No light is less than none.", judgeNotNegative});
    to.push_back(
        {"energy", "Surfaces send no more than first light over 1 - albedo.", judgeEnergy});
    to.push_back({"growth", "Bounces bring ever less light.", judgeGrowth});
    to.push_back({"balance", "A closed grey room sends twice its first light.", judgeBalance});
    to.push_back({"furnace_most", "In a furnace nothing is brighter than pi L / (1 - albedo).",
                  judgeFurnaceMost});
    to.push_back(
        {"furnace_least", "In a closed furnace nothing is darker than that.", judgeFurnaceLeast});
}

} // namespace limn
