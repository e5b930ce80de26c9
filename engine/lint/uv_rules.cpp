// SPDX-License-Identifier: MIT
#include "engine/lint/uv_rules.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/charts.h"
#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace limn {

const LintRule kMissingUvRule = {"missing-uv", Severity::Warning,
                                 "A texture reads coordinates that the mesh does not have"};
const LintRule kDegenerateUvRule = {"degenerate-uv", Severity::Warning,
                                    "Texture coordinates of a whole mesh lie on a point or a line"};
const LintRule kLightmapUvRule = {
    "lightmap-uv", Severity::Note,
    "TEXCOORD_1 looks like lightmap coordinates, but overlaps itself or has no area"};

namespace {

bool lacksUv(const Mesh& mesh, Material material) {
    return std::ranges::any_of(texturesOf(material), [&](const TextureRef* texture) {
        return texture->image >= 0 && mesh.uv(texture->texCoord).empty();
    });
}

bool isOfOneColor(const Image& image) {
    for (std::size_t i = 4; i < image.rgba.size(); ++i)
        if (image.rgba[i] != image.rgba[i - 4])
            return false;
    return true;
}

/// Whether all of the mesh shows less than a sixteenth of a texel.
bool showsNoArea(const Mesh& mesh, const std::vector<glm::vec2>& uv, const TextureRef& texture,
                 const Image& image) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        const glm::dvec2 e1 = uv[b] - uv[a], e2 = uv[c] - uv[a];
        area += std::abs(e1.x * e2.y - e1.y * e2.x) / 2;
    }
    const double scale = std::abs(double(texture.scale.x) * double(texture.scale.y));
    return area * scale * image.width * image.height < 1 / 16.;
}

/// Whether coordinates without area are a mistake. A point within a texture picks one colour of a
/// palette, and a short line a gradient of it. Exporters write the point (0, 0), or (0, 1), where
/// there are no coordinates; a line across half of the image is a plane that was projected from its
/// edge.
bool isMistake(const std::vector<glm::vec2>& uv) {
    glm::vec2 lower = uv[0], upper = uv[0];
    for (const glm::vec2 p : uv) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    const glm::vec2 size = upper - lower;
    const bool isCorner = size == glm::vec2(0) && lower == glm::round(lower);
    return isCorner || std::max(size.x, size.y) >= 0.5f;
}

bool hasDegenerateUv(const Scene& scene, const Mesh& mesh, Material material) {
    for (const TextureRef* texture : texturesOf(material)) {
        if (texture->image < 0 || mesh.uv(texture->texCoord).empty())
            continue;
        const std::vector<glm::vec2>& uv = mesh.uv(texture->texCoord);
        const Image& image = scene.assets->images[std::size_t(texture->image)];
        const bool bends = texture == &material.normalTexture; // by the directions of u and v
        if (!isOfOneColor(image) && showsNoArea(mesh, uv, *texture, image) &&
            (bends || isMistake(uv)))
            return true;
    }
    return false;
}

/// What is wrong with TEXCOORD_1 as coordinates of a lightmap; empty: nothing, or it is not meant
/// so.
std::string lightmapDefect(const Mesh& mesh, const Material& material, const Progress& progress) {
    if (mesh.uv1.empty() || uvSetsOf(material).contains(1) || mesh.uv1 == mesh.uv0)
        return {};
    const std::string defect = lightmapUvDefect(mesh, progress);
    return defect.find("outside") == std::string::npos ? defect : "";
}

Finding uvFinding(const LintScene& in, const LintRule& rule, const MeshUse& use,
                  const std::string& problem, const std::string& advice) {
    const Instance& instance = in.scene.instances[use.instance];
    Finding finding = findingAbout(in, rule, instance.node, problem, advice);
    finding.place = middleInFile(in.scene, instance);
    return finding;
}

std::string materialText(const LintScene& in, const MeshUse& use) {
    return fmt::format("material \"{}\"{}",
                       in.scene.materialOf(in.scene.instances[use.instance]).name,
                       othersText(use.count));
}

} // namespace

std::vector<Finding> uvFindings(const LintScene& in, const Progress& progress) {
    const std::vector<MeshUse> uses = meshUses(in.scene);
    std::vector<std::string> defects(uses.size());
    parallelRanges(
        uses.size(), 1, progress, "coordinates", [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                const Instance& i = in.scene.instances[uses[k].instance];
                defects[k] = lightmapDefect(in.scene.meshOf(i), in.scene.materialOf(i), progress);
            }
        });
    UsesByMaterial missing, degenerate;
    std::vector<Finding> lightmap;
    for (std::size_t k = 0; k < uses.size(); ++k) {
        const Instance& instance = in.scene.instances[uses[k].instance];
        const Mesh& mesh = in.scene.meshOf(instance);
        const Material& material = in.scene.materialOf(instance);
        if (lacksUv(mesh, material))
            missing.add(in.scene, uses[k]);
        if (hasDegenerateUv(in.scene, mesh, material))
            degenerate.add(in.scene, uses[k]);
        if (!defects[k].empty())
            lightmap.push_back(uvFinding(
                in, kLightmapUvRule, uses[k],
                fmt::format("Mesh \"{}\": {}.", mesh.name, defects[k]),
                "Unwrap it again, without overlaps, or leave TEXCOORD_1 out: bakes then cut charts "
                "of their own, as they do now."));
    }
    std::vector<Finding> findings;
    for (const auto& [material, use] : missing.uses())
        findings.push_back(
            uvFinding(in, kMissingUvRule, use,
                      fmt::format("A texture of {} reads coordinates that the mesh does not have.",
                                  materialText(in, use)),
                      "Unwrap the mesh, or take the texture away."));
    for (const auto& [material, use] : degenerate.uses())
        findings.push_back(uvFinding(
            in, kDegenerateUvRule, use,
            fmt::format("The texture coordinates of {} lie on one point or one line.",
                        materialText(in, use)),
            "Unwrap the mesh: the texture shows as a single colour or as stripes, and a normal map "
            "has no directions."));
    std::ranges::move(lightmap, std::back_inserter(findings));
    return findings;
}

} // namespace limn
