// SPDX-License-Identifier: MIT
#include "engine/scene/surface/texture.h"

#include "engine/math/packing.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

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

/// Texel index in [0, size) of texel `i`, which may lie outside.
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

/// Bilinear lookup in texels of one size, read by `fetch`.
template <class Fetch>
static glm::vec4 bilinear(glm::uvec2 size, const TextureRef& texture, glm::vec2 uv,
                          const Fetch& fetchTexel) {
    // Far outside [0, 1], floats cannot distinguish texels anyway; the clamp keeps the conversion
    // to integers defined.
    const glm::vec2 position = glm::clamp(uv * glm::vec2(size), -1e12f, 1e12f);
    const glm::vec2 corner = glm::floor(position - 0.5f), f = position - 0.5f - corner;
    const auto i = std::int64_t(corner.x), j = std::int64_t(corner.y);
    const std::uint32_t x0 = wrapTexel(i, size.x, texture.wrapU);
    const std::uint32_t x1 = wrapTexel(i + 1, size.x, texture.wrapU);
    const std::uint32_t y0 = wrapTexel(j, size.y, texture.wrapV);
    const std::uint32_t y1 = wrapTexel(j + 1, size.y, texture.wrapV);
    const glm::vec4 top = glm::mix(fetchTexel(x0, y0), fetchTexel(x1, y0), f.x);
    const glm::vec4 bottom = glm::mix(fetchTexel(x0, y1), fetchTexel(x1, y1), f.x);
    return glm::mix(top, bottom, f.y);
}

static const Image* imageOf(const Assets& assets, const TextureRef& texture) {
    if (texture.image < 0 || std::size_t(texture.image) >= assets.images.size())
        return nullptr;
    const Image& image = assets.images[std::size_t(texture.image)];
    return image.rgba.empty() ? nullptr : &image;
}

glm::vec4 sampleTexture(const Assets& assets, const TextureRef& texture, glm::vec2 uv, bool srgb) {
    const Image* image = imageOf(assets, texture);
    if (!image)
        return glm::vec4(1);
    uv = transformUv(texture, uv);
    const glm::uvec2 size(image->width, image->height);
    if (texture.nearest) {
        const glm::vec2 texel = glm::floor(glm::clamp(uv * glm::vec2(size), -1e12f, 1e12f));
        return fetch(*image, wrapTexel(std::int64_t(texel.x), size.x, texture.wrapU),
                     wrapTexel(std::int64_t(texel.y), size.y, texture.wrapV), srgb);
    }
    return bilinear(size, texture, uv,
                    [&](std::uint32_t x, std::uint32_t y) { return fetch(*image, x, y, srgb); });
}

/// A texel with the weighting that mips use for averaging.
static glm::vec4 weighed(const Image& image, std::uint32_t x, std::uint32_t y, TexelKind kind) {
    const glm::vec4 texel = fetch(image, x, y, kind != TexelKind::Data);
    return kind == TexelKind::CutoutColor ? glm::vec4(glm::vec3(texel) * texel.w, texel.w) : texel;
}

/// Box filter to half the size, rounded down. On sides of odd length, texels on a border are
/// weighted by their parts on either side.
template <class Fetch>
static std::vector<glm::vec4> halved(glm::uvec2 from, glm::uvec2 to, const Fetch& fetchTexel) {
    const auto overlap = [](std::uint32_t i, std::uint32_t j, float ratio) {
        return std::min(float(i) + 1, float(j + 1) * ratio) - std::max(float(i), float(j) * ratio);
    };
    const glm::vec2 ratio = glm::vec2(from) / glm::vec2(to);
    std::vector<glm::vec4> result(std::size_t(to.x) * to.y);
    for (std::uint32_t y = 0; y < to.y; ++y)
        for (std::uint32_t x = 0; x < to.x; ++x) {
            glm::vec4 sum(0);
            float weights = 0;
            for (auto j = std::uint32_t(float(y) * ratio.y);
                 j < from.y && float(j) < float(y + 1) * ratio.y; ++j)
                for (auto i = std::uint32_t(float(x) * ratio.x);
                     i < from.x && float(i) < float(x + 1) * ratio.x; ++i) {
                    const float w = std::max(overlap(i, x, ratio.x) * overlap(j, y, ratio.y), 0.f);
                    sum += fetchTexel(i, j) * w;
                    weights += w;
                }
            result[std::size_t(y) * to.x + x] = sum / weights;
        }
    return result;
}

MipChain buildMips(const Image& image, TexelKind kind) {
    MipChain chain;
    std::vector<glm::vec4> texels;
    glm::uvec2 size(image.width, image.height);
    if (image.rgba.empty())
        return chain;
    while (size.x > 1 || size.y > 1) {
        const glm::uvec2 half = glm::max(size / 2U, 1U);
        texels = texels.empty() ? halved(size, half,
                                         [&](std::uint32_t x, std::uint32_t y) {
                                             return weighed(image, x, y, kind);
                                         })
                                : halved(size, half, [&](std::uint32_t x, std::uint32_t y) {
                                      return texels[std::size_t(y) * size.x + x];
                                  });
        MipChain::Level level{half.x, half.y, {}};
        level.rgba.reserve(texels.size());
        for (const glm::vec4& t : texels)
            level.rgba.push_back(
                {floatToHalf(t.x), floatToHalf(t.y), floatToHalf(t.z), floatToHalf(t.w)});
        chain.levels.push_back(std::move(level));
        size = half;
    }
    return chain;
}

const MipChain& MipStore::of(const std::vector<Image>& images, std::size_t image,
                             TexelKind kind) const {
    std::call_once(m_once, [&] {
        m_count = images.size() * kKinds;
        m_entries = std::make_unique<Entry[]>(m_count);
    });
    Entry& entry = m_entries[image * kKinds + std::size_t(kind)];
    std::call_once(entry.once, [&] { entry.mips = buildMips(images[image], kind); });
    return entry.mips;
}

std::uint64_t MipStore::bytes() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < m_count; ++i)
        for (const MipChain::Level& level : m_entries[i].mips.levels)
            sum += level.rgba.size() * sizeof level.rgba[0];
    return sum;
}

/// Lookup in one level: level 0 is the image, level n the (n - 1)st of its mips.
static glm::vec4 sampleLevel(const Image& image, const MipChain& mips, std::size_t level,
                             const TextureRef& texture, glm::vec2 uv, TexelKind kind) {
    if (level == 0)
        return bilinear(
            {image.width, image.height}, texture, uv,
            [&](std::uint32_t x, std::uint32_t y) { return weighed(image, x, y, kind); });
    const MipChain::Level& mip = mips.levels[level - 1];
    return bilinear({mip.width, mip.height}, texture, uv, [&](std::uint32_t x, std::uint32_t y) {
        const auto& t = mip.rgba[std::size_t(y) * mip.width + x];
        return glm::vec4(halfToFloat(t[0]), halfToFloat(t[1]), halfToFloat(t[2]),
                         halfToFloat(t[3]));
    });
}

glm::vec4 sampleTextureFootprint(const Assets& assets, const TextureRef& texture, glm::vec2 uv,
                                 float uvArea, TexelKind kind) {
    const Image* image = imageOf(assets, texture);
    const float texels = image ? uvArea * std::abs(texture.scale.x * texture.scale.y) *
                                     float(image->width) * float(image->height)
                               : 0;
    if (!(texels > 1))
        return sampleTexture(assets, texture, uv, kind != TexelKind::Data);
    const MipChain& mips = assets.mips.of(assets.images, std::size_t(texture.image), kind);
    const float level = std::min(0.5f * std::log2(texels), float(mips.levels.size()));
    const auto lower = std::size_t(level);
    const glm::vec2 transformed = transformUv(texture, uv);
    glm::vec4 mean = sampleLevel(*image, mips, lower, texture, transformed, kind);
    if (const float f = level - float(lower); f > 0)
        mean = glm::mix(mean, sampleLevel(*image, mips, lower + 1, texture, transformed, kind), f);
    if (kind == TexelKind::CutoutColor && mean.w > 0)
        mean = {glm::vec3(mean) / mean.w, mean.w};
    return mean;
}

} // namespace limn
