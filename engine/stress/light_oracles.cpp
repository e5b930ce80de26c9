// SPDX-License-Identifier: MIT
#include "engine/math/sampling.h"
#include "engine/relight/surfel_light.h"
#include "engine/relight/surfel_material.h"
#include "engine/stress/oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Numbers that are none: what nodes send, caches hold and the field shows.
Judgement judgeFinite(const Subject& subject) {
    const Lighting& l = subject.base.light;
    return judged(double(countNotFinite(l.radiosity) + countNotFinite(l.sh) +
                         countNotFinite(l.field.lightmap) + countNotFinite(l.field.grid)),
                  0);
}

/// Surfels that send less than nothing, and corners of the surface that get less.
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

/// What surfels send by first light, without bounces [W m^-2].
struct FirstLight {
    std::vector<glm::vec3> radiosity;
    double mostAlbedo = 0, mostSky = 0; ///< pi times the sky's radiance
};

FirstLight firstLight(const LitScene& s) {
    FirstLight out;
    SurfelLight direct;
    std::vector<glm::vec3> albedo;
    surfelMaterials(s.bake->surfels, s.scene, albedo, out.radiosity);
    updateSurfelLight(s.bake->surfels, s.scene, *s.trace, direct);
    for (std::size_t i = 0; i < albedo.size(); ++i) {
        out.radiosity[i] += albedo[i] * direct.irradiance[i];
        out.mostAlbedo = std::max(out.mostAlbedo, largest(albedo[i]));
    }
    for (const glm::vec3 cell : skyRadiosity(s.bake->tree, s.scene.sky))
        out.mostSky = std::max(out.mostSky, largest(cell));
    return out;
}

/// All that surfels send, over what they may: first light, F, and the sky's, at most albedo times
/// pi L on all of the area, reflected again and again: (F + albedo pi L A) / (1 - albedo).
/// What a surfel sends reaches others through rays that caches draw, so it is counted with an
/// error: where one surfel sends everything, by 1 / sqrt of the rays that meet it, and where few
/// caches stand for the surfaces around it, by 1 / sqrt of those. n = (sum A B)^2 / sum (A B)^2
/// surfels send as much as all do; on an average each is met by rays * caches / surfels rays. Six
/// standard deviations are allowed, and 2 % for what textures of three bands miss.
Judgement judgeEnergy(const Subject& subject) {
    const LitScene& s = subject.base;
    if (s.scene.bake.linker != Linker::Gather) // only gathered light sums to what is sent
        return notJudged();
    const FirstLight first = firstLight(s);
    const Surfels& surfels = s.bake->surfels;
    double sent = 0, given = 0, area = 0, squares = 0;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const double a = double(surfels.area[i]);
        const auto sum = [](glm::vec3 v) { return double(v.x) + double(v.y) + double(v.z); };
        const double b = sum(first.radiosity[i]);
        sent += a * sum(glm::vec3(s.light.radiosity[i]));
        given += a * b;
        squares += a * b * a * b;
        area += a;
    }
    const double allowed =
        (given + 3 * first.mostAlbedo * first.mostSky * area) / (1 - first.mostAlbedo);
    if (!(allowed > 1e-30))
        return judged(sent, 1e-30);
    const double senders = squares > 0 ? given * given / squares : double(surfels.size());
    return judged(sent / allowed, 1.02 + 6 / std::sqrt(senders));
}

/// The same scene, everything grey and aglow: albedo 1/2, radiance 1, no other light.
LitScene furnaceOf(const Subject& subject) {
    LitScene s = subject.base;
    for (Material& m : s.scene.materials) {
        m.baseColor = glm::vec4(glm::vec3(0.5f), m.baseColor.w);
        m.metallic = 0;
        m.emission = glm::vec3(1);
    }
    s.scene.lights.clear();
    s.scene.sky = {};
    s.scene.bake.maxBounces = 1000;
    s.light = lightOf(s.bake, s.scene, *s.trace, 1000, subject.progress);
    return s;
}
constexpr double kFurnace = 2 * kPi; // pi L / (1 - albedo)

/// A furnace has the same light everywhere, pi L / (1 - albedo), and where it has openings less.
/// Links are halfs that are scaled to be exact where a cache looks: 1 % is the design's bound.
Judgement judgeFurnaceMost(const Subject& subject) {
    if (subject.base.scene.bake.linker != Linker::Gather)
        return notJudged();
    const LitScene s = furnaceOf(subject);
    double most = 0;
    for (std::size_t i = 0; i < s.bake->surfels.size(); ++i)
        most = std::max(most, largest(glm::vec3(s.light.radiosity[i])));
    return judged(most / kFurnace, 1.01);
}

/// Whether every ray from every surfel meets the front of something static.
bool isClosed(const LitScene& s) {
    constexpr int kRays = 32;
    std::uint32_t bits = 1;
    for (std::size_t i = 0; i < s.bake->surfels.size(); ++i) {
        const glm::vec3 n = s.bake->surfels.normal[i], p = s.bake->surfels.position[i];
        for (int k = 0; k < kRays; ++k) {
            glm::vec3 d;
            for (int c = 0; c < 3; ++c)
                d[c] = 2 * unitFloat(bits = mixBits(bits + 1)) - 1;
            if (!(glm::length(d) > 0.01f))
                continue;
            d = glm::normalize(d);
            if (glm::dot(d, n) < 0)
                d = -d;
            const Hit hit = s.trace->closestHit({s.trace->clearOf(p, n), d});
            if (!hit || (!hit.frontFace &&
                         !s.scene.materialOf(s.scene.instances[hit.instance]).doubleSided))
                return false;
        }
    }
    return true;
}

Judgement judgeFurnaceLeast(const Subject& subject) {
    const Scene& scene = subject.base.scene;
    const bool moves = std::ranges::any_of(scene.instances, &Instance::dynamic);
    if (moves || scene.bake.linker != Linker::Gather || !isClosed(subject.base))
        return notJudged();
    const LitScene s = furnaceOf(subject);
    double least = 1;
    for (std::size_t i = 0; i < s.bake->surfels.size(); ++i)
        least = std::min(least, double(s.light.radiosity[i].x) / kFurnace);
    return judged(1 - least, 0.01);
}

} // namespace

void addLightOracles(std::vector<Oracle>& to) {
    to.push_back({"finite", "Every number of the light is one.", judgeFinite});
    to.push_back({"not_negative", "No light is less than none.", judgeNotNegative});
    to.push_back(
        {"energy", "Surfaces send no more than first light over 1 - albedo.", judgeEnergy});
    to.push_back({"furnace_most", "In a furnace nothing is brighter than pi L / (1 - albedo).",
                  judgeFurnaceMost});
    to.push_back(
        {"furnace_least", "In a closed furnace nothing is darker than that.", judgeFurnaceLeast});
}

} // namespace limn
