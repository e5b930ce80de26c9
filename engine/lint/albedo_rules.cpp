// SPDX-License-Identifier: MIT
#include "engine/lint/albedo_rules.h"

#include "engine/math/luminance.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/specular.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace limn {

const LintRule kBlackAlbedoRule = {
    "black-albedo", Severity::Warning,
    "A surface that neither emits nor is metal or glass reflects less than 0.5 % of the light"};
const LintRule kBrightAlbedoRule = {"bright-albedo", Severity::Warning,
                                    "A surface reflects more than 95 % of a colour of the light"};

namespace {

struct MeanSurface {
    glm::vec3 albedo{0}, reflection{0}; ///< diffuse; at normal incidence
    bool any = false;                   ///< some of it is not a hole
};

/// Mean over points spread evenly over an instance's area.
MeanSurface meanSurface(const Scene& scene, const MeshUse& use) {
    constexpr std::uint32_t kPoints = 64;
    const Instance& instance = scene.instances[use.instance];
    const Mesh& mesh = scene.meshOf(instance);
    MeanSurface mean;
    double sum = 0, solid = 0;
    std::uint32_t next = 0;
    for (std::uint32_t t = 0; t < mesh.triangleCount() && next < kPoints; ++t) {
        sum += double(triangleWorldArea(scene, instance, t));
        for (; next < kPoints && (next + 0.5) / kPoints * use.area <= sum; ++next) {
            constexpr float kThird = 1 / 3.f;
            const SurfaceMaterial s =
                surfaceMaterialOver(scene, instance, t, kThird, kThird, float(use.area) / kPoints);
            const Gloss gloss = surfaceGloss(scene, instance, t, kThird, kThird);
            mean.albedo += s.albedo * s.alpha;
            mean.reflection += gloss.F0 * s.alpha;
            solid += double(s.alpha);
        }
    }
    mean.any = solid > 0;
    if (mean.any) {
        mean.albedo /= float(solid);
        mean.reflection /= float(solid);
    }
    return mean;
}

/// Whether it reflects as a metal does, by another share than that of a dielectric straight on.
bool isMetal(const Material& material, const MeanSurface& mean) {
    constexpr float kRounding = 0.002f;
    const float reflection = largestChannel(mean.reflection);
    return reflection > kBlackAlbedo &&
           std::abs(reflection - dielectricF0(material.ior)) > kRounding;
}

Finding albedoFinding(const LintScene& in, const LintRule& rule, const MeshUse& use,
                      const char* what, const char* advice) {
    const Instance& instance = in.scene.instances[use.instance];
    const std::string& material = in.scene.materialOf(instance).name;
    Finding finding = findingAbout(
        in, rule, instance.node,
        fmt::format("Material \"{}\"{} reflects {}.", material, othersText(use.count), what),
        advice);
    finding.place = middleInFile(in.scene, instance);
    return finding;
}

} // namespace

std::vector<Finding> albedoFindings(const LintScene& in) {
    UsesByMaterial black, bright;
    for (const MeshUse& use : meshUses(in.scene)) {
        const Material& material = in.scene.materialOf(in.scene.instances[use.instance]);
        if (material.emission != glm::vec3(0) || material.transmission > 0 || !(use.area > 0))
            continue;
        const MeanSurface mean = meanSurface(in.scene, use);
        if (mean.any && largestChannel(mean.albedo) < kBlackAlbedo && !isMetal(material, mean))
            black.add(in.scene, use);
        if (largestChannel(mean.albedo) > kBrightAlbedo)
            bright.add(in.scene, use);
    }
    std::vector<Finding> findings;
    for (const auto& [material, use] : black.uses())
        findings.push_back(albedoFinding(
            in, kBlackAlbedoRule, use,
            "less than 0.5 % of the light, so that no light bounces off it",
            "Give it an albedo of 0.03 or more, as coal and black paint have, or a texture that "
            "can be read."));
    for (const auto& [material, use] : bright.uses())
        findings.push_back(albedoFinding(
            in, kBrightAlbedoRule, use,
            "more than 95 % of a colour of the light, so that bounces hardly end and rooms come "
            "out too bright",
            "Lower its base colour to 0.9 or less, as white paint and snow have."));
    return findings;
}

} // namespace limn
