// SPDX-License-Identifier: MIT
#include "engine/trace/alpha_mask.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limn {

static std::shared_ptr<const AlphaImage> alphaOf(const Image& image) {
    auto result = std::make_shared<AlphaImage>();
    result->width = int(image.width);
    result->height = int(image.height);
    result->alpha.resize(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < result->alpha.size(); ++i)
        result->alpha[i] = image.rgba[4 * i + 3];
    return result;
}

AlphaMask makeAlphaMask(const Assets& assets, const Mesh& mesh, const Material& material,
                        AlphaImages& images) {
    AlphaMask mask;
    mask.mesh = &mesh;
    mask.texture = material.baseColorTexture;
    mask.factor = material.baseColor.w;
    mask.cutoff = alphaCutoff(material);
    const std::int32_t i = mask.texture.image;
    const std::vector<glm::vec2>& uv = mesh.uv(mask.texture.texCoord);
    if (i < 0 || std::size_t(i) >= assets.images.size() ||
        assets.images[std::size_t(i)].rgba.empty())
        return mask;
    if (!uv.empty())
        mask.uv = &uv;
    std::shared_ptr<const AlphaImage>& cached = images[i];
    if (!cached)
        cached = alphaOf(assets.images[std::size_t(i)]);
    mask.image = cached;
    return mask;
}

static int wrapped(int i, int size, Wrap wrap) {
    switch (wrap) {
    case Wrap::Repeat:
        i %= size;
        return i < 0 ? i + size : i;
    case Wrap::Clamp:
        return std::clamp(i, 0, size - 1);
    case Wrap::Mirror:
        i %= 2 * size;
        if (i < 0)
            i += 2 * size;
        return i < size ? i : 2 * size - 1 - i;
    }
    return 0;
}

static float texel(const AlphaImage& image, const TextureRef& texture, int x, int y) {
    x = wrapped(x, image.width, texture.wrapU);
    y = wrapped(y, image.height, texture.wrapV);
    return float(image.alpha[std::size_t(y) * std::size_t(image.width) + std::size_t(x)]) / 255.f;
}

static glm::vec2 transformed(const TextureRef& texture, glm::vec2 uv) {
    uv *= texture.scale;
    if (texture.rotation != 0) {
        const float c = std::cos(texture.rotation), s = std::sin(texture.rotation);
        uv = {c * uv.x + s * uv.y, c * uv.y - s * uv.x};
    }
    return uv + texture.offset;
}

static float sampleAlpha(const AlphaImage& image, const TextureRef& texture, glm::vec2 uv) {
    uv = transformed(texture, uv);
    // Coordinates beyond a thousand repeats have hardly any fraction left, but they and NaN must
    // not overflow int.
    uv.x = std::abs(uv.x) < 1e4f ? uv.x : 0;
    uv.y = std::abs(uv.y) < 1e4f ? uv.y : 0;
    if (texture.wrapU == Wrap::Repeat)
        uv.x -= std::floor(uv.x);
    if (texture.wrapV == Wrap::Repeat)
        uv.y -= std::floor(uv.y);
    const float x = uv.x * float(image.width), y = uv.y * float(image.height);
    if (texture.nearest)
        return texel(image, texture, int(std::floor(x)), int(std::floor(y)));
    const float x0 = std::floor(x - 0.5f), y0 = std::floor(y - 0.5f);
    const float fx = x - 0.5f - x0, fy = y - 0.5f - y0;
    const int ix = int(x0), iy = int(y0);
    const float top =
        texel(image, texture, ix, iy) * (1 - fx) + texel(image, texture, ix + 1, iy) * fx;
    const float bottom =
        texel(image, texture, ix, iy + 1) * (1 - fx) + texel(image, texture, ix + 1, iy + 1) * fx;
    return top * (1 - fy) + bottom * fy;
}

std::array<AlphaCorner, 3> alphaCorners(const AlphaMask& mask, std::uint32_t triangle) {
    const std::array<std::uint32_t, 3> vertex = mask.mesh->triangle(triangle);
    std::array<AlphaCorner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k].factor = mask.factor;
        if (!mask.mesh->colors.empty())
            corners[k].factor *= mask.mesh->colors[vertex[k]].w;
        if (mask.image)
            corners[k].uv =
                transformed(mask.texture, mask.uv ? (*mask.uv)[vertex[k]] : glm::vec2(0));
    }
    return corners;
}

bool opaqueAt(const AlphaMask& mask, std::uint32_t triangle, float u, float v) {
    const std::array<std::uint32_t, 3> k = mask.mesh->triangle(triangle);
    const float w = 1 - u - v;
    float alpha = mask.factor;
    if (!mask.mesh->colors.empty()) {
        const std::vector<glm::vec4>& c = mask.mesh->colors;
        alpha *= w * c[k[0]].w + u * c[k[1]].w + v * c[k[2]].w;
    }
    if (mask.image) {
        glm::vec2 uv{0};
        if (mask.uv)
            uv = w * (*mask.uv)[k[0]] + u * (*mask.uv)[k[1]] + v * (*mask.uv)[k[2]];
        alpha *= sampleAlpha(*mask.image, mask.texture, uv);
    }
    return alpha >= mask.cutoff;
}

} // namespace limn
