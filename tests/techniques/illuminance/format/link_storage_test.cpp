// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/link_storage.h"

#include "engine/math/cone.h"
#include "engine/math/packing.h"
#include "engine/math/sh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limn::link_storage_test {
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

/// The same links in either storage.
PackedLinks packed(LinkStorage storage, int bands, std::span<const Cone> cones) {
    if (storage == LinkStorage::Rtp)
        return packCones(cones);
    std::vector<std::uint32_t> nodes;
    std::vector<float> coefficients;
    float y[kMaxCoefficients], g[kMaxBands];
    for (const Cone& cone : cones) {
        nodes.push_back(cone.node);
        shBasis(bands, cone.direction, y);
        coneFactors(bands, cone.u, g);
        for (int i = 0; i < bands * bands; ++i)
            coefficients.push_back(cone.transport * g[int(std::sqrt(i))] * y[i]);
    }
    return packHarmonics(bands, nodes, coefficients);
}

Caches cachesOf(LinkStorage storage, int bands, const std::vector<Cone>& cones) {
    const PackedLinks links[] = {packed(storage, bands, cones)};
    Caches caches;
    joinLinks(links, caches);
    return caches;
}

TEST(LinkStorage, EitherStorageExpandsToTheHarmonicsOfItsCones) {
    const std::vector<Cone> cones = randomCones(40, 1e-3f);
    for (int bands = 2; bands <= kMaxBands; ++bands)
        for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
            const Caches caches = cachesOf(storage, bands, cones);
            EXPECT_EQ(caches.links.empty(), storage == LinkStorage::Sh);
            float y[kMaxCoefficients], g[kMaxBands], is[kMaxCoefficients];
            for (std::uint32_t k = 0; k < cones.size(); ++k) {
                shBasis(bands, cones[k].direction, y);
                coneFactors(bands, cones[k].u, g);
                expandLink(caches, 0, k, bands, is);
                for (int i = 0; i < bands * bands; ++i) {
                    const int l = int(std::sqrt(i));
                    const float exact = cones[k].transport * g[l] * y[i];
                    // A cone's halfs and direction move each band by so much of the transport.
                    const float near = storage == LinkStorage::Sh
                                           ? 0x1p-11f * std::abs(exact) + 1e-12f
                                           : 2e-3f * float(l + 1) * cones[k].transport;
                    EXPECT_NEAR(is[i], exact, near) << bands << " bands, coefficient " << i;
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
    EXPECT_EQ(packCones({}).linkExponent, 0);
}

TEST(LinkStorage, JoinsTheLinksOfAllCachesInTheirOrder) {
    const std::vector<Cone> cones = randomCones(5, 1);
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        const PackedLinks whole = packed(storage, 3, cones),
                          part = packed(storage, 3, std::span(cones).first(2));
        const PackedLinks all[] = {part, {}, whole};
        Caches caches;
        joinLinks(all, caches);
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
} // namespace limn::link_storage_test
