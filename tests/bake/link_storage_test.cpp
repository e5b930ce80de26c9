// SPDX-License-Identifier: MIT
#include "engine/bake/link_storage.h"

#include "engine/math/cone.h"
#include "engine/math/packing.h"
#include "engine/math/sh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limn {
namespace {

/// Random cones of a mean transport of about `transport`, up to a thousand times more or less.
std::vector<Cone> randomCones(std::size_t count, float transport) {
    std::mt19937 rng(5);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Cone> cones;
    for (std::uint32_t node = 0; node < count; ++node)
        cones.push_back({node, glm::normalize(glm::vec3(normal(rng), normal(rng), normal(rng))),
                         2 * unit(rng) * unit(rng), transport * std::pow(10.f, 6 * unit(rng) - 3),
                         0});
    return cones;
}

Caches cachesOf(LinkStorage storage, int bands, const std::vector<Cone>& cones) {
    const PackedLinks packed[] = {packLinks(storage, bands, cones)};
    Caches caches;
    joinLinks(packed, caches);
    return caches;
}

TEST(LinkStorage, ShLinksHoldWhatTheirConesExpandTo) {
    const std::vector<Cone> cones = randomCones(40, 1e-3f);
    for (int bands = 2; bands <= kMaxBands; ++bands) {
        const PackedLinks packed = packLinks(LinkStorage::Sh, bands, cones);
        ASSERT_EQ(packed.shCoefficients.size(), cones.size() * std::size_t(bands * bands));
        EXPECT_TRUE(packed.links.empty());
        float y[kMaxCoefficients], g[kMaxBands];
        for (std::size_t k = 0; k < cones.size(); ++k) {
            shBasis(bands, cones[k].direction, y);
            coneFactors(bands, cones[k].u, g);
            EXPECT_EQ(packed.shNode[k], cones[k].node);
            for (int i = 0; i < bands * bands; ++i) {
                const double exact =
                    double(cones[k].transport * g[int(std::sqrt(i))]) * double(y[i]);
                const double kept = std::ldexp(
                    double(halfToFloat(
                        packed.shCoefficients[k * std::size_t(bands * bands) + std::size_t(i)])),
                    -packed.linkExponent);
                EXPECT_NEAR(kept, exact, 0x1p-11 * std::abs(exact) + 1e-12)
                    << bands << " bands, coefficient " << i;
            }
        }
    }
}

TEST(LinkStorage, NoTransportIsTooSmallOrTooLargeForHalfs) {
    for (const float transport : {1e-30f, 1e-12f, 6e-8f, 1e-3f, 1.f, 1e9f})
        for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
            const std::vector<Cone> cones = randomCones(200, transport);
            const Caches caches = cachesOf(storage, 4, cones);
            for (std::uint32_t k = 0; k < cones.size(); ++k) {
                const LinkWeight link = linkWeight(caches, 0, k);
                EXPECT_EQ(link.node, cones[k].node);
                // A half's rounding; the smallest may be a millionth of the largest.
                EXPECT_NEAR(link.transport / cones[k].transport, 1, 0x1p-11)
                    << transport << " storage " << int(storage);
            }
        }
}

TEST(LinkStorage, ScalesByPowersOfTwoAlone) {
    const std::vector<Cone> one = {{7, {0, 0, 1}, 0.5f, 0.25f, 0}};
    EXPECT_EQ(linkWeight(cachesOf(LinkStorage::Rtp, 3, one), 0, 0).transport, 0.25f);
    EXPECT_EQ(packLinks(LinkStorage::Rtp, 3, {}).linkExponent, 0);
}

TEST(LinkStorage, JoinsTheLinksOfAllCachesInTheirOrder) {
    const std::vector<Cone> cones = randomCones(5, 1);
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        const PackedLinks whole = packLinks(storage, 3, cones),
                          part = packLinks(storage, 3, std::span(cones).first(2));
        const PackedLinks packed[] = {part, {}, whole};
        Caches caches;
        joinLinks(packed, caches);
        EXPECT_EQ(caches.linkBegin, (std::vector<std::uint32_t>{0, 2, 2, 7}));
        EXPECT_EQ(caches.linkCount(), 7U);
        EXPECT_EQ(caches.linkExponent,
                  (std::vector<std::int8_t>{part.linkExponent, 0, whole.linkExponent}));
        EXPECT_EQ(linkWeight(caches, 2, 4).node, cones[2].node);
        const std::uint64_t bytes = caches.links.size() * sizeof(Link) +
                                    caches.shNode.size() * sizeof(std::uint32_t) +
                                    caches.shCoefficients.size() * sizeof(std::uint16_t);
        EXPECT_EQ(bytes, 7 * bytesPerLink(storage, 3));
    }
}

} // namespace
} // namespace limn
