// SPDX-License-Identifier: MIT
#include "engine/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

static constexpr float kMaxAlbedo = 0.99f;

static const std::array<float, 256>& srgbToLinear() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t;
        for (int i = 0; i < 256; ++i) {
            const double c = i / 255.0;
            t[std::size_t(i)] =
                float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
        }
        return t;
    }();
    return table;
}

/// Texel index in [0, size) of the possibly outside texel `i`.
static std::uint32_t wrapTexel(std::int64_t i, std::uint32_t size, Wrap wrap) {
    const std::int64_t n = size;
    switch (wrap) {
    case Wrap::Repeat:
        return std::uint32_t(((i % n) + n) % n);
    case Wrap::Clamp:
        return std::uint32_t(std::clamp<std::int64_t>(i, 0, n - 1));
    case Wrap::Mirror: {
        const std::int64_t m = ((i % (2 * n)) + 2 * n) % (2 * n);
        return std::uint32_t(m < n ? m : 2 * n - 1 - m);
    }
    }
    return 0;
}

static glm::vec4 fetch(const Image& image, std::uint32_t x, std::uint32_t y, bool srgb) {
    const std::uint8_t* p = &image.rgba[(std::size_t(y) * image.width + x) * 4];
    const float a = float(p[3]) / 255.f;
    if (!srgb)
        return {float(p[0]) / 255.f, float(p[1]) / 255.f, float(p[2]) / 255.f, a};
    const std::array<float, 256>& linear = srgbToLinear();
    return {linear[p[0]], linear[p[1]], linear[p[2]], a};
}

static glm::vec2 transformUv(const TextureRef& texture, glm::vec2 uv) {
    uv *= texture.scale;
    if (texture.rotation != 0) {
        // KHR_texture_transform: a counter-clockwise turn of the image, v down.
        const float c = std::cos(texture.rotation), s = std::sin(texture.rotation);
        uv = {c * uv.x + s * uv.y, -s * uv.x + c * uv.y};
    }
    return uv + texture.offset;
}

glm::vec4 sampleTexture(const Assets& assets, const TextureRef& texture, glm::vec2 uv, bool srgb) {
    if (texture.image < 0 || std::size_t(texture.image) >= assets.images.size())
        return glm::vec4(1);
    const Image& image = assets.images[std::size_t(texture.image)];
    if (image.rgba.empty())
        return glm::vec4(1);
    uv = transformUv(texture, uv);
    // Far outside [0, 1] floats cannot tell texels apart anyway; the clamp keeps the conversion to
    // integers defined.
    const glm::vec2 size{float(image.width), float(image.height)};
    const glm::vec2 at = glm::clamp(uv * size, -1e12f, 1e12f);
    if (texture.nearest) {
        const std::uint32_t x =
            wrapTexel(std::int64_t(std::floor(at.x)), image.width, texture.wrapU);
        const std::uint32_t y =
            wrapTexel(std::int64_t(std::floor(at.y)), image.height, texture.wrapV);
        return fetch(image, x, y, srgb);
    }
    const glm::vec2 corner = glm::floor(at - 0.5f), f = at - 0.5f - corner;
    const auto i = std::int64_t(corner.x), j = std::int64_t(corner.y);
    const std::uint32_t x0 = wrapTexel(i, image.width, texture.wrapU);
    const std::uint32_t x1 = wrapTexel(i + 1, image.width, texture.wrapU);
    const std::uint32_t y0 = wrapTexel(j, image.height, texture.wrapV);
    const std::uint32_t y1 = wrapTexel(j + 1, image.height, texture.wrapV);
    const glm::vec4 top = glm::mix(fetch(image, x0, y0, srgb), fetch(image, x1, y0, srgb), f.x);
    const glm::vec4 bottom = glm::mix(fetch(image, x0, y1, srgb), fetch(image, x1, y1, srgb), f.x);
    return glm::mix(top, bottom, f.y);
}

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
    glm::vec4 texture(const Assets& assets, const TextureRef& t, bool srgb) const {
        if (t.image < 0)
            return glm::vec4(1);
        const glm::vec2 uv = interpolate(t.texCoord == 1 ? mesh.uv1 : mesh.uv0, glm::vec2(0));
        return sampleTexture(assets, t, uv, srgb);
    }
};

} // namespace

static TrianglePoint pointOf(const Mesh& mesh, std::uint32_t triangle, float u, float v) {
    return {mesh, mesh.triangle(triangle), {1 - u - v, u, v}};
}

bool isCutout(const Material& material) {
    return material.alphaMode != AlphaMode::Opaque;
}

static float cutAlpha(const Material& material, float alpha) {
    switch (material.alphaMode) {
    case AlphaMode::Opaque:
        return 1;
    case AlphaMode::Mask:
        return alpha >= material.alphaCutoff ? 1.f : 0.f;
    case AlphaMode::Blend:
        return alpha >= kBlendCutoff ? 1.f : 0.f;
    }
    return 1;
}

float surfaceAlpha(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v) {
    const Material& m = scene.materialOf(instance);
    if (!isCutout(m))
        return 1;
    const TrianglePoint point = pointOf(scene.meshOf(instance), triangle, u, v);
    return cutAlpha(m, m.baseColor.w * point.interpolate(point.mesh.colors, glm::vec4(1)).w *
                           point.texture(*scene.assets, m.baseColorTexture, true).w);
}

SurfaceMaterial surfaceMaterial(const Scene& scene, const Instance& instance,
                                std::uint32_t triangle, float u, float v) {
    const Material& m = scene.materialOf(instance);
    const Assets& assets = *scene.assets;
    const TrianglePoint point = pointOf(scene.meshOf(instance), triangle, u, v);
    const glm::vec4 base = m.baseColor * point.interpolate(point.mesh.colors, glm::vec4(1)) *
                           point.texture(assets, m.baseColorTexture, true);
    float metallic = m.metallic;
    if (metallic > 0)
        metallic *= point.texture(assets, m.metallicRoughnessTexture, false).z;
    SurfaceMaterial s;
    s.albedo = glm::clamp(glm::vec3(base) * (1 - metallic), 0.f, kMaxAlbedo);
    s.emission = m.emission;
    if (m.emission != glm::vec3(0))
        s.emission *= glm::vec3(point.texture(assets, m.emissiveTexture, true));
    s.alpha = cutAlpha(m, base.w);
    return s;
}

} // namespace limn
