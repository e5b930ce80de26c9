// SPDX-License-Identifier: MIT
#include "engine/lint/size_rules.h"

#include "engine/lint/uv_rules.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

const LintRule kTinyMeshRule = {"tiny-mesh", Severity::Warning,
                                "An object is less than a millionth of the scene's size"};
const LintRule kSceneSizeRule = {"scene-size", Severity::Warning,
                                 "The scene is smaller than 1 cm or larger than 100 km"};
const LintRule kDegenerateTrianglesRule = {
    "degenerate-triangles", Severity::Warning,
    "An object is flattened to nothing, or has triangles thinner than rounding"};
const LintRule kNonFiniteRule = {"non-finite-values", Severity::Warning,
                                 "The file has numbers that are not finite, which were replaced"};
const LintRule kRepairedFileRule = {"repaired-file", Severity::Note,
                                    "Something else of the file was repaired or left out"};

namespace {

double diagonalOf(const Bounds& bounds) {
    return isEmpty(bounds) ? 0 : glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
}

/// Number of triangles whose height above their longest edge is below the rounding of their
/// corners, so that their planes are those of rounding.
std::size_t countNeedles(const Mesh& mesh) {
    std::size_t needles = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        double longest = 0, coordinate = 0;
        const auto corners = mesh.triangle(t);
        glm::dvec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = mesh.positions[corners[std::size_t(k)]];
            const glm::dvec3 size = glm::abs(p[k]);
            coordinate = std::max({coordinate, size.x, size.y, size.z});
        }
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, glm::length(p[(k + 1) % 3] - p[k]));
        const double twice = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        needles += twice < longest * coordinate * 0x1p-23;
    }
    return needles;
}

void addSizes(const LintScene& in, std::vector<Finding>& findings) {
    const double whole = diagonalOf(in.scene.bounds);
    if (in.scene.instances.empty())
        return;
    if (whole < kMinScene || whole > kMaxScene)
        findings.push_back(findingAbout(
            in, kSceneSizeRule, 0,
            fmt::format("The scene is {:.3g} m from corner to corner.", whole),
            "Scale it to metres, as glTF asks: strengths of lights and the program's defaults "
            "are meant for that."));
    UsesByMaterial tiny;
    for (const Instance& instance : in.scene.instances) {
        const double size = diagonalOf(worldBounds(in.scene, instance));
        if (size > 0 && size < kTinyMesh * whole)
            tiny.add(in.scene, {std::uint32_t(&instance - in.scene.instances.data()), size, 1});
    }
    for (const auto& [material, use] : tiny.uses()) {
        const Instance& instance = in.scene.instances[use.instance];
        Finding finding = findingAbout(
            in, kTinyMeshRule, instance.node,
            fmt::format("It is {:.2g} m large, less than a millionth of the scene{}.", use.area,
                        othersText(use.count)),
            "Delete it, or correct its scale: it takes texels, and its shape is lost in rounding.");
        finding.place = middleInFile(in.scene, instance);
        findings.push_back(std::move(finding));
    }
}

void addTriangles(const LintScene& in, std::vector<Finding>& findings) {
    for (const MeshUse& use : meshUses(in.scene)) {
        const Instance& instance = in.scene.instances[use.instance];
        const Mesh& mesh = in.scene.meshOf(instance);
        const std::size_t needles = countNeedles(mesh);
        const bool flat = !(use.area > 0) && mesh.triangleCount() > 0;
        if (needles == 0 && !flat)
            continue;
        Finding finding = findingAbout(
            in, kDegenerateTrianglesRule, instance.node,
            flat ? "A scale of 0 flattens it to a line or a point."
                 : fmt::format("{} of {} triangles are thinner than the rounding of their corners.",
                               needles, mesh.triangleCount()),
            flat ? "Give it a scale, or delete it."
                 : "Dissolve or delete them: the normals that light falls on are arbitrary there.");
        if (!flat)
            finding.severity = Severity::Note;
        finding.place = middleInFile(in.scene, instance);
        findings.push_back(std::move(finding));
    }
}

/// A repair and the rule that its sentence belongs to.
struct RepairKind {
    std::string_view words;
    const LintRule& rule;
    Severity severity;
    const char* advice;
};

void addRepairs(const LintScene& in, std::vector<Finding>& findings) {
    const RepairKind kinds[] = {
        {"not finite", kNonFiniteRule, Severity::Warning,
         "Export the file again; find what divides by zero if it happens again."},
        {"lack their coordinates", kMissingUvRule, Severity::Warning,
         "Unwrap these meshes, or take the textures away."},
        {"zero area", kDegenerateTrianglesRule, Severity::Note,
         "Dissolve them in the modelling program; nothing is lost without them."},
        {"", kRepairedFileRule, Severity::Note,
         "Correct the file if a picture lacks something; docs/gltf.md lists what is read."}};
    for (const std::string& repair : in.repairs) {
        const RepairKind& kind = *std::ranges::find_if(
            kinds, [&](const RepairKind& k) { return repair.find(k.words) != std::string::npos; });
        Finding finding = findingAbout(in, kind.rule, 0, "Import: " + repair + ".", kind.advice);
        finding.severity = kind.severity;
        findings.push_back(std::move(finding));
    }
}

} // namespace

std::vector<Finding> sizeFindings(const LintScene& in) {
    std::vector<Finding> findings;
    addSizes(in, findings);
    addTriangles(in, findings);
    addRepairs(in, findings);
    return findings;
}

} // namespace limn
