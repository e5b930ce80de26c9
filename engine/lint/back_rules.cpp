// SPDX-License-Identifier: MIT
#include "engine/lint/back_rules.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/scene/origin.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

const LintRule kBackFacesRule = {
    "back-faces", Severity::Warning,
    "The backs of a one-sided object are seen more than its fronts: they are black"};

namespace {

/// A place from which rays look around.
struct Eye {
    glm::vec3 position{0};
    glm::vec3 normal{0};          ///< looks into this hemisphere; 0: all around
    std::uint32_t instance = ~0U; ///< on which it lies; ~0: none
    std::uint32_t rays = 0;
};

/// A surface that a ray met, from one side.
struct Look {
    std::uint32_t instance = 0;
    bool front = true;
    glm::vec3 position{0}, normal{0}; ///< the normal on the side that was met
};

std::vector<Look> looksFrom(const LintScene& in, const Eye& eye, std::uint32_t seed) {
    const bool around = eye.normal == glm::vec3(0);
    const DirectionSet directions(eye.rays, around, seed);
    const glm::mat3 basis = basisAround(around ? glm::vec3(0, 0, 1) : eye.normal);
    std::vector<Look> looks;
    for (std::uint32_t k = 0; k < eye.rays; ++k) {
        const glm::vec3 d = basis * directions[k];
        const Hit hit = in.trace.closestHit({eye.position, d});
        if (!hit || hit.instance == eye.instance)
            continue;
        const glm::vec3 n = hit.geometricNormal * (hit.frontFace ? 1.f : -1.f);
        looks.push_back({hit.instance, hit.frontFace, in.trace.clearOf(hit.position, n), n});
    }
    return looks;
}

std::vector<std::vector<Look>> looksFrom(const LintScene& in, const std::vector<Eye>& eyes,
                                         const Progress& progress) {
    std::vector<std::vector<Look>> looks(eyes.size());
    parallelRanges(eyes.size(), 16, progress, "backs", [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            looks[k] = looksFrom(in, eyes[k], std::uint32_t(k));
    });
    return looks;
}

constexpr std::uint32_t kRaysOfPoint = 16;

/// Cameras and lamps.
std::vector<Eye> placedEyes(const LintScene& in) {
    constexpr std::uint32_t kRays = 65536; // of all together; a second of them with what follows
    std::vector<Eye> eyes;
    for (const Camera& camera : in.scene.cameras)
        eyes.push_back({camera.eye, glm::vec3(0), ~0U, 0});
    for (const Light& light : in.scene.lights)
        if (shines(light) && light.kind != LightKind::Directional) {
            const glm::vec3 ahead = light.kind == LightKind::Point ? glm::vec3(0) : light.direction;
            const glm::vec3 clear = ahead * in.trace.epsilonAt(light.position);
            eyes.push_back({light.position + clear, ahead, ~0U, 0});
        }
    for (Eye& eye : eyes)
        eye.rays = std::clamp(kRays / std::uint32_t(eyes.size()), kRaysOfPoint, 4096U);
    return eyes;
}

/// Points of surfaces, for scenes without cameras and lamps: those that see hardly any backs, for
/// others lie within solids; all where there are none.
std::vector<Eye> surfaceEyes(const LintScene& in, const Progress& progress) {
    constexpr std::size_t kPoints = 8192;
    std::vector<Eye> eyes, open;
    for (const LintPoint& p : spreadPoints(in, kPoints))
        eyes.push_back({p.position, p.normal, p.instance, kRaysOfPoint});
    const auto looks = looksFrom(in, eyes, progress);
    for (std::size_t k = 0; k < eyes.size(); ++k)
        if (std::ranges::count(looks[k], false, &Look::front) <= kRaysOfPoint / 8)
            open.push_back(eyes[k]);
    const bool any = std::ranges::any_of(looks, [](const auto& some) { return !some.empty(); });
    return open.empty() && any ? eyes : open;
}

bool isOneSided(const LintScene& in, std::uint32_t instance) {
    const Material& material = in.scene.materialOf(in.scene.instances[instance]);
    return !isTwoSided(material) && !(material.transmission > 0);
}

/// Where light gets to from the places of some looks: fronts, of which a few are taken.
std::vector<Eye> nextEyes(const LintScene& in, const std::vector<std::vector<Look>>& looks) {
    constexpr std::size_t kNext = 4096;
    std::vector<Eye> all, some;
    for (const auto& ofEye : looks)
        for (const Look& look : ofEye)
            if (look.front || !isOneSided(in, look.instance))
                all.push_back({look.position, look.normal, look.instance, kRaysOfPoint});
    const std::size_t count = std::min(all.size(), kNext);
    for (std::size_t k = 0; k < count; ++k)
        some.push_back(all[k * all.size() / count]);
    return some;
}

/// What eyes see of an instance.
struct Seen {
    std::uint32_t fronts = 0, backs = 0;
    glm::vec3 back{0}; ///< one of the places seen from behind
};

} // namespace

std::vector<Finding> backFindings(const LintScene& in, const Progress& progress) {
    constexpr int kBounces = 4; // light reaches what is seen after as many
    std::vector<Eye> eyes = placedEyes(in);
    if (eyes.empty())
        eyes = surfaceEyes(in, progress);
    std::vector<Seen> seen(in.scene.instances.size());
    for (int bounce = 0; bounce < kBounces && !progress.cancelled(); ++bounce) {
        const auto looks = looksFrom(in, eyes, progress);
        for (const auto& ofEye : looks)
            for (const Look& look : ofEye) {
                Seen& s = seen[look.instance];
                ++(look.front ? s.fronts : s.backs);
                if (!look.front)
                    s.back = look.position;
            }
        eyes = nextEyes(in, looks);
    }
    std::vector<Finding> findings;
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
        const Instance& instance = in.scene.instances[i];
        constexpr std::uint32_t kEnough = 32; // fewer may lie in a crack
        if (!isOneSided(in, i) || seen[i].backs < kEnough || seen[i].backs <= 2 * seen[i].fronts)
            continue;
        const double share = double(seen[i].backs) / (seen[i].backs + seen[i].fronts);
        Finding finding = findingAbout(
            in, kBackFacesRule, instance.node,
            fmt::format("{}: {:.0f} % of what is seen are backs, which are black and block light.",
                        partText(in.scene, instance) == "It" ? "One-sided"
                                                             : partText(in.scene, instance),
                        100 * share),
            "Turn its triangles round, or make its material double-sided.");
        finding.place = toFile(in.scene.origin, seen[i].back);
        findings.push_back(std::move(finding));
    }
    return findings;
}

} // namespace limn
