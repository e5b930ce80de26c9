// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/scene.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/metal.h"
#include "engine/scene/surface/specular.h"

#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

static constexpr float kMaxAlbedo = 0.99f;

namespace {

/// The corners of a triangle and the weights of a point in it.
struct TrianglePoint {
    const Mesh& mesh;
    std::array<std::uint32_t, 3> corner;
    float weight[3];

    template <class T>
    T interpolate(const std::vector<T>& values, T missing) const {
        if (values.empty())
            return missing;
        return values[corner[0]] * weight[0] + values[corner[1]] * weight[1] +
               values[corner[2]] * weight[2];
    }
    /// Mean of a texture over `share` of the triangle's area; 0: at the point.
    glm::vec4 texture(const Assets& assets, const TextureRef& t, TexelKind kind,
                      float share) const {
        if (t.image < 0)
            return glm::vec4(1);
        const std::vector<glm::vec2>& uvs = mesh.uv(t.texCoord);
        const glm::vec2 uv = interpolate(uvs, glm::vec2(0));
        if (share == 0 || uvs.empty())
            return sampleTexture(assets, t, uv, kind != TexelKind::Data);
        const glm::vec2 a = uvs[corner[1]] - uvs[corner[0]], b = uvs[corner[2]] - uvs[corner[0]];
        return sampleTextureFootprint(assets, t, uv, share * std::abs(a.x * b.y - a.y * b.x) / 2,
                                      kind);
    }
};

} // namespace

static TrianglePoint pointOf(const Mesh& mesh, std::uint32_t triangle, float u, float v) {
    return {mesh, mesh.triangle(triangle), {1 - u - v, u, v}};
}

bool isCutout(const Material& material) {
    return material.alphaMode != AlphaMode::Opaque;
}

bool isGlassSheet(const Material& material) {
    return material.thickness == 0 && material.emission == glm::vec3(0) &&
           (1 - material.metallic) * material.transmission >= 0.5f;
}

float alphaCutoff(const Material& material) {
    // An alpha equal to the cutoff must not fall below it by rounding of the interpolation.
    constexpr float kRounding = 1 - 1e-5f;
    switch (material.alphaMode) {
    case AlphaMode::Opaque:
        return 0;
    case AlphaMode::Mask:
        return kRounding * material.alphaCutoff;
    case AlphaMode::Blend:
        return kRounding * kBlendCutoff;
    }
    return 0;
}

static float cutAlpha(const Material& material, float alpha) {
    return !isCutout(material) || alpha >= alphaCutoff(material) ? 1.f : 0.f;
}

float surfaceAlpha(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v) {
    const Material& m = scene.materialOf(instance);
    if (!isCutout(m))
        return 1;
    const TrianglePoint point = pointOf(scene.meshOf(instance), triangle, u, v);
    return cutAlpha(m, m.baseColor.w * point.interpolate(point.mesh.colors, glm::vec4(1)).w *
                           point.texture(*scene.assets, m.baseColorTexture, TexelKind::Color, 0).w);
}

static SurfaceMaterial materialOver(const Scene& scene, const Instance& instance,
                                    std::uint32_t triangle, float u, float v, float share) {
    const Material& m = scene.materialOf(instance);
    const Assets& assets = *scene.assets;
    const TrianglePoint point = pointOf(scene.meshOf(instance), triangle, u, v);
    const TexelKind color = isCutout(m) ? TexelKind::CutoutColor : TexelKind::Color;
    const glm::vec4 base = m.baseColor * point.interpolate(point.mesh.colors, glm::vec4(1)) *
                           point.texture(assets, m.baseColorTexture, color, share);
    float metallic = m.metallic;
    if (metallic > 0)
        metallic *= point.texture(assets, m.metallicRoughnessTexture, TexelKind::Data, share).z;
    SurfaceMaterial s;
    s.albedo = glm::clamp(glm::vec3(base) * (1 - metallic) * (1 - m.transmission), 0.f, kMaxAlbedo);
    s.emission = m.emission;
    if (m.emission != glm::vec3(0))
        s.emission *= glm::vec3(point.texture(assets, m.emissiveTexture, TexelKind::Color, share));
    s.alpha = cutAlpha(m, base.w);
    return s;
}

SurfaceMaterial surfaceMaterial(const Scene& scene, const Instance& instance,
                                std::uint32_t triangle, float u, float v) {
    return materialOver(scene, instance, triangle, u, v, 0);
}

Gloss surfaceGloss(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v) {
    const Material& m = scene.materialOf(instance);
    const Assets& assets = *scene.assets;
    const TrianglePoint point = pointOf(scene.meshOf(instance), triangle, u, v);
    const glm::vec4 texel =
        point.texture(assets, m.metallicRoughnessTexture, TexelKind::Data, 0); // 1 without one
    Gloss gloss{glm::vec3(dielectricF0(m.ior)), m.roughness * texel.y};
    const float metallic = m.metallic * texel.z;
    if (metallic > 0) {
        const glm::vec4 base = m.baseColor * point.interpolate(point.mesh.colors, glm::vec4(1)) *
                               point.texture(assets, m.baseColorTexture, TexelKind::Color, 0);
        gloss.F0 = glm::mix(gloss.F0, glm::vec3(base), metallic);
    }
    return gloss;
}

Transmission surfaceTransmission(const Scene& scene, const Instance& instance,
                                 std::uint32_t triangle, float u, float v) {
    const Material& m = scene.materialOf(instance);
    if (m.transmission == 0)
        return {};
    const Assets& assets = *scene.assets;
    const TrianglePoint point = pointOf(scene.meshOf(instance), triangle, u, v);
    const glm::vec4 texel = point.texture(assets, m.metallicRoughnessTexture, TexelKind::Data, 0);
    const glm::vec4 base = m.baseColor * point.interpolate(point.mesh.colors, glm::vec4(1)) *
                           point.texture(assets, m.baseColorTexture, TexelKind::Color, 0);
    const float share = (1 - m.metallic * texel.z) * m.transmission;
    return {.tint = glm::clamp(glm::vec3(base) * share, 0.f, 1.f),
            .share = share,
            .ior = m.ior,
            .isThin = m.thickness == 0,
            .roughness = m.roughness * texel.y};
}

SurfaceMaterial surfaceMaterialOver(const Scene& scene, const Instance& instance,
                                    std::uint32_t triangle, float u, float v, float area) {
    const float whole = triangleWorldArea(scene, instance, triangle);
    return materialOver(scene, instance, triangle, u, v, whole > 0 ? area / whole : 0);
}

Metal surfaceMetal(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v) {
    const Material& m = scene.materialOf(instance);
    if (!(m.metallic > 0))
        return {};
    const Assets& assets = *scene.assets;
    const TrianglePoint point = pointOf(scene.meshOf(instance), triangle, u, v);
    const glm::vec4 texel = point.texture(assets, m.metallicRoughnessTexture, TexelKind::Data, 0);
    const glm::vec4 base = m.baseColor * point.interpolate(point.mesh.colors, glm::vec4(1)) *
                           point.texture(assets, m.baseColorTexture, TexelKind::Color, 0);
    return {glm::clamp(glm::vec3(base), 0.f, 1.f), m.metallic * texel.z, m.roughness * texel.y};
}

} // namespace limn
