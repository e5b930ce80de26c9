// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/link_storage.h"

#include "engine/core/large_pages.h"
#include "engine/math/cone.h"
#include "engine/math/packing.h"
#include "engine/math/sh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace limn {

// Exponent of the power of two that brings `largest` into [2^14, 2^15).
static std::int8_t exponentFor(float largest) {
    if (!(largest > 0))
        return 0;
    return std::int8_t(std::clamp(14 - std::ilogb(largest), -126, 126));
}

PackedLinks packCones(std::span<const Cone> cones) {
    PackedLinks out;
    float largest = 0;
    for (const Cone& cone : cones)
        largest = std::max(largest, cone.transport);
    out.linkExponent = exponentFor(largest);
    out.links.reserve(cones.size());
    for (const Cone& cone : cones) {
        const Oct16 d = packOct(cone.direction);
        out.links.push_back({cone.node, d.x, d.y, floatToHalf(cone.u),
                             floatToHalf(std::ldexp(cone.transport, out.linkExponent))});
    }
    return out;
}

PackedLinks packHarmonics([[maybe_unused]] int bands, std::vector<std::uint32_t> nodes,
                          std::span<const float> coefficients) {
    assert(coefficients.size() == nodes.size() * std::size_t(bands * bands));
    PackedLinks out;
    float largest = 0;
    for (const float c : coefficients)
        largest = std::max(largest, std::abs(c));
    out.linkExponent = exponentFor(largest);
    out.shNode = std::move(nodes);
    out.shCoefficients.reserve(coefficients.size());
    for (const float c : coefficients)
        out.shCoefficients.push_back(floatToHalf(std::ldexp(c, out.linkExponent)));
    return out;
}

void joinLinks(std::span<const PackedLinks> packed, Caches& caches) {
    const auto join = [&](auto part, auto& to) {
        std::size_t size = 0;
        for (const PackedLinks& p : packed)
            size += (p.*part).size();
        to.clear();
        reserveLarge(to, size);
        for (const PackedLinks& p : packed)
            to.insert(to.end(), (p.*part).begin(), (p.*part).end());
    };
    join(&PackedLinks::links, caches.links);
    join(&PackedLinks::shNode, caches.shNode);
    join(&PackedLinks::shCoefficients, caches.shCoefficients);
    caches.linkBegin = {0};
    caches.linkExponent.clear();
    for (const PackedLinks& p : packed) {
        caches.linkExponent.push_back(p.linkExponent);
        caches.linkBegin.push_back(caches.linkBegin.back() +
                                   std::uint32_t(p.links.size() + p.shNode.size()));
    }
}

std::uint64_t bytesPerLink(LinkStorage storage, std::uint32_t bands) {
    if (storage == LinkStorage::Rtp)
        return sizeof(Link);
    return sizeof(std::uint32_t) + sizeof(std::uint16_t) * bands * bands;
}

LinkWeight linkWeight(const Caches& caches, std::uint32_t c, std::uint32_t k) {
    const float scale = std::ldexp(1.f, -caches.linkExponent[c]);
    if (caches.shNode.empty())
        return {caches.links[k].node, halfToFloat(caches.links[k].transport) * scale};
    const std::size_t coefficients = caches.shCoefficients.size() / caches.shNode.size();
    // The first band is transport * Y_00, Y_00 = 1 / (2 sqrt(pi)).
    constexpr float kOverY00 = float(2 / std::numbers::inv_sqrtpi);
    return {caches.shNode[k],
            halfToFloat(caches.shCoefficients[k * coefficients]) * kOverY00 * scale};
}

void expandLink(const Caches& caches, std::uint32_t c, std::uint32_t k, int bands,
                float* coefficients) {
    const float scale = std::ldexp(1.f, -caches.linkExponent[c]);
    const auto count = std::size_t(bands * bands);
    if (!caches.shNode.empty()) {
        const std::size_t stored = caches.shCoefficients.size() / caches.shNode.size();
        for (std::size_t i = 0; i < count; ++i)
            coefficients[i] = halfToFloat(caches.shCoefficients[k * stored + i]) * scale;
        return;
    }
    const Link& link = caches.links[k];
    float g[kMaxBands];
    shBasis(bands, unpackOct(link.octX, link.octY), coefficients);
    coneFactors(bands, halfToFloat(link.u), g);
    for (int l = 0, i = 0; l < bands; ++l)
        for (; i < (l + 1) * (l + 1); ++i)
            coefficients[i] *= halfToFloat(link.transport) * scale * g[l];
}

} // namespace limn
