// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/glossy_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// The four texels of the next finer level below texel `t` of a level with `side` texels a side.
std::array<std::size_t, 4> childrenOf(std::size_t t, std::size_t side) {
    const std::size_t x = t % side, y = t / side, lower = 4 * y * side + 2 * x;
    return {lower, lower + 1, lower + 2 * side, lower + 2 * side + 1};
}

bool isDark(glm::vec3 light) {
    return light == glm::vec3(0);
}

/// How filling makes a texel: of its own light, or of that of the coarser texel above it.
struct FilledTexel {
    bool filled = false;
    float scale = 1; ///< of that light
};

/// How all texels of the filled levels are made, by their numbers; `before`: all levels before
/// filling. Each filled texel takes as much as the mean of its four is, so that all four must
/// shrink for that to stay; and they shrink once more where the coarser texel did.
std::vector<FilledTexel> fillPlan(const GlossyMapShape& shape, std::span<const glm::vec3> before) {
    std::vector<FilledTexel> plan(before.size());
    for (std::uint32_t level = std::min(shape.fill, shape.levels() - 1); level-- > 0;) {
        const std::size_t side = shape.tile >> (level + 1);
        const std::size_t fine = shape.firstTexel(level), coarse = shape.firstTexel(level + 1);
        for (std::size_t t = 0; t < side * side; ++t) {
            const auto k = childrenOf(t, side);
            const auto dark =
                std::ranges::count_if(k, [&](std::size_t c) { return isDark(before[fine + c]); });
            const float scale = dark < 4 ? 4 / float(4 + dark) : 1;
            for (const std::size_t c : k) {
                const bool filled = isDark(before[fine + c]);
                plan[fine + c] = {filled, filled ? scale : scale * plan[coarse + t].scale};
            }
        }
    }
    return plan;
}

/// The levels before filling.
void averageLevels(const GlossyMapShape& shape, std::span<glm::vec3> texels) {
    for (std::uint32_t level = 1; level < shape.levels(); ++level) {
        const std::size_t side = shape.tile >> level;
        const std::span<glm::vec3> coarse = texels.subspan(shape.firstTexel(level), side * side);
        const std::span<const glm::vec3> fine =
            texels.subspan(shape.firstTexel(level - 1), 4 * side * side);
        for (std::size_t t = 0; t < coarse.size(); ++t) {
            const auto k = childrenOf(t, side);
            coarse[t] = (fine[k[0]] + fine[k[1]] + fine[k[2]] + fine[k[3]]) * 0.25f;
        }
    }
}

} // namespace

std::uint32_t GlossyMapShape::levels() const {
    return std::uint32_t(std::countr_zero(tile)) + 1;
}

std::size_t GlossyMapShape::firstTexel(std::uint32_t level) const {
    std::size_t first = 0;
    for (std::uint32_t k = 0; k < level; ++k)
        first += std::size_t(tile >> k) * (tile >> k);
    return first;
}

glm::mat3 glossyFrame(glm::vec3 toEye) {
    const float length = glm::length(toEye);
    const glm::vec3 z = length > 0 ? toEye / length : glm::vec3(0, 0, 1);
    const glm::vec3 across(z.z, 0, -z.x);
    const float width = glm::length(across);
    const glm::vec3 x = width > 1e-6f ? across / width : glm::vec3(1, 0, 0);
    return {x, glm::cross(z, x), z};
}

glm::vec2 squareOfHemisphere(glm::vec3 d) {
    // Lambert's azimuthal map: the disk's radius is 1 where z is 0.
    const float radius = std::sqrt(std::max(1 - d.z, 0.f));
    const float length = std::sqrt(d.x * d.x + d.y * d.y);
    if (!(length > 0))
        return glm::vec2(0.5f);
    const glm::vec2 p = glm::vec2(d.x, d.y) * (radius / length);
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const glm::vec2 q = wide ? p : glm::vec2(p.y, p.x);
    const float a = std::copysign(radius, q.x);
    const float b = a * (4 / kPi) * std::atan(q.y / q.x);
    const glm::vec2 square = wide ? glm::vec2(a, b) : glm::vec2(b, a);
    return glm::clamp(square * 0.5f + 0.5f, 0.f, 1.f);
}

glm::vec3 hemisphereOfSquare(glm::vec2 p) {
    const glm::vec2 s = 2.f * p - 1.f;
    if (s == glm::vec2(0))
        return {0, 0, 1};
    const bool wide = std::abs(s.x) > std::abs(s.y);
    const float a = wide ? s.x : s.y, b = wide ? s.y : s.x;
    const float angle = (kPi / 4) * (b / a);
    glm::vec2 disk = a * glm::vec2(std::cos(angle), std::sin(angle));
    if (!wide)
        disk = {disk.y, disk.x};
    const float r2 = glm::dot(disk, disk);
    return {disk * std::sqrt(std::max(2 - r2, 0.f)), 1 - r2};
}

GlossySplat glossySplat(const GlossyMapShape& shape, const glm::mat3& frame, glm::vec3 direction) {
    const glm::vec3 sum = direction + frame[2];
    const float length = glm::length(sum);
    if (!(length > 1e-6f))
        return {};
    const glm::vec3 h = sum / length;
    const glm::vec2 p = squareOfHemisphere(h * frame) * float(shape.tile);
    const glm::uvec2 texel = glm::min(glm::uvec2(p), glm::uvec2(shape.tile - 1));
    const float exponent = float(shape.tile) * float(shape.tile) - 1;
    const float cosine = glm::dot(h, direction);
    const float factor = shape.microfacet
                             ? (exponent + 2) / std::max(cosine, 1 / float(shape.tile)) // a texel
                             : cosine * (exponent + 8);
    return {texel.y * shape.tile + texel.x, factor / (8 * kPi)};
}

void completeGlossyMap(const GlossyMapShape& shape, std::span<glm::vec3> texels) {
    averageLevels(shape, texels);
    if (shape.fill == 0)
        return;
    const std::vector<FilledTexel> plan = fillPlan(shape, texels);
    for (std::uint32_t level = std::min(shape.fill, shape.levels() - 1); level-- > 0;) {
        const std::size_t side = shape.tile >> (level + 1);
        const std::size_t first = shape.firstTexel(level), coarse = shape.firstTexel(level + 1);
        for (std::size_t t = 0; t < side * side; ++t)
            for (const std::size_t c : childrenOf(t, side)) {
                const FilledTexel& made = plan[first + c];
                texels[first + c] = texels[made.filled ? coarse + t : first + c] * made.scale;
            }
    }
}

std::vector<glm::vec3> glossyAdjoint(const GlossyMapShape& shape, std::span<const glm::vec3> finest,
                                     std::span<const glm::vec3> weight) {
    std::vector<glm::vec3> before(shape.texels(), glm::vec3(0));
    std::ranges::copy(finest.first(std::size_t(shape.tile) * shape.tile), before.begin());
    averageLevels(shape, before);
    const std::vector<FilledTexel> plan = fillPlan(shape, before);
    std::vector<glm::vec3> w(weight.begin(), weight.end());
    const std::span<glm::vec3> all(w);
    // Filling goes from coarse to fine, so its adjoint goes from fine to coarse.
    for (std::uint32_t level = 0; level < std::min(shape.fill, shape.levels() - 1); ++level) {
        const std::size_t side = shape.tile >> (level + 1);
        const std::size_t first = shape.firstTexel(level), coarse = shape.firstTexel(level + 1);
        for (std::size_t t = 0; t < side * side; ++t)
            for (const std::size_t c : childrenOf(t, side)) {
                const FilledTexel& made = plan[first + c];
                const glm::vec3 moved = std::exchange(w[first + c], glm::vec3(0)) * made.scale;
                w[made.filled ? coarse + t : first + c] += moved;
            }
    }
    for (std::uint32_t level = shape.levels() - 1; level > 0; --level) {
        const std::size_t side = shape.tile >> level;
        const std::span<const glm::vec3> coarse = all.subspan(shape.firstTexel(level), side * side);
        const std::span<glm::vec3> fine = all.subspan(shape.firstTexel(level - 1), 4 * side * side);
        for (std::size_t t = 0; t < coarse.size(); ++t)
            for (const std::size_t k : childrenOf(t, side))
                fine[k] += coarse[t] * 0.25f;
    }
    w.resize(std::size_t(shape.tile) * shape.tile);
    return w;
}

GlossyLookup lookUpGlossy(const GlossyMapShape& shape, const glm::mat3& frame, glm::vec3 normal,
                          float roughness) {
    GlossyLookup found;
    const glm::vec3 local = normal * frame;
    if (!(local.z > 0))
        return found;
    const glm::vec2 p = squareOfHemisphere(local);
    const float squared = roughness * roughness;
    const float exponent = 2 / (squared * squared + 0.0005f);
    const float resolution = float(shape.tile) * float(shape.tile);
    const float level =
        std::clamp(0.5f * std::log2(resolution / (1 + exponent)), 0.f, float(shape.levels() - 1));
    const auto fine = std::min(std::uint32_t(level), shape.levels() - 1);
    const float toCoarse = level - float(fine);
    for (std::uint32_t k = 0; k < 2; ++k) {
        const float share = k == 0 ? 1 - toCoarse : toCoarse;
        if (!(share > 0))
            continue;
        const float side = float(shape.tile >> (fine + k));
        // Half a texel inside, so that no neighbour would show.
        const glm::vec2 q = glm::clamp(p * side - 0.5f, glm::vec2(0), glm::vec2(side - 1));
        const glm::uvec2 c(q), next = glm::min(c + 1U, glm::uvec2(std::uint32_t(side) - 1));
        const glm::vec2 f = q - glm::vec2(c);
        const auto add = [&](std::uint32_t x, std::uint32_t y, float w) {
            found.texel[found.count] =
                std::uint32_t(shape.firstTexel(fine + k)) + y * std::uint32_t(side) + x;
            found.weight[found.count++] = w * share;
        };
        add(c.x, c.y, (1 - f.x) * (1 - f.y));
        add(next.x, c.y, f.x * (1 - f.y));
        add(c.x, next.y, (1 - f.x) * f.y);
        add(next.x, next.y, f.x * f.y);
    }
    return found;
}

} // namespace limn
