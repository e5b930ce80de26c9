// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/caches/cache_light.h"

#include "engine/math/cone.h"
#include "engine/math/packing.h"
#include "engine/math/sh.h"
#include "engine/math/ycocg.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/link_storage.h"
#include "engine/techniques/illuminance/relight/surfel_read.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace limn::cache_light_test {
namespace {

Bake bakedRoom(LinkStorage storage, std::uint32_t bands, bool window = false,
               std::uint32_t links = 24) {
    Scene scene = hall(storage, bands, window);
    scene.bake.lightmapCaches = 200;
    scene.bake.rays = std::max(128U, 4 * links);
    scene.bake.links = links;
    Result<Bake> baked = bake(TraceScene(scene));
    EXPECT_TRUE(baked) << (baked ? "" : baked.error().message);
    return baked ? std::move(*baked) : Bake{};
}

/// Radiosity of very different strengths, pulled up the tree.
std::vector<glm::vec4> randomRadiosity(const ClusterTree& tree, bool grey) {
    std::mt19937 rng(9);
    std::exponential_distribution<float> strength;
    std::vector<glm::vec4> radiosity(tree.size());
    for (std::uint32_t s = 0; s < tree.leaves(); ++s)
        radiosity[s] = withLuma(grey ? glm::vec3(strength(rng))
                                     : glm::vec3(strength(rng), strength(rng), strength(rng)));
    pullRadiosity(tree, radiosity);
    if (grey) // exactly, whatever the pull rounds
        for (glm::vec4& b : radiosity)
            b = withLuma(glm::vec3(b.x));
    return radiosity;
}

std::vector<glm::vec3> lit(const Bake& baked, const std::vector<glm::vec4>& radiosity,
                           LightBands bands) {
    const auto all = std::uint32_t(baked.caches.size());
    std::vector<glm::vec3> sh(all * std::size_t(bands.luma * bands.luma));
    lightCaches(baked.caches, allLinks(baked.caches), radiosity, bands, runsOf(0, all), sh);
    fillInvalidCaches(baked.caches, bands.luma, runsOf(0, all), sh);
    return sh;
}

/// The bake with the harmonics of its cones instead of them.
Bake inHarmonics(Bake baked) {
    Caches& caches = baked.caches;
    const auto bands = int(baked.settings.bands);
    const auto count = std::size_t(bands * bands);
    std::vector<PackedLinks> packed;
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        const std::uint32_t first = caches.linkBegin[c], last = caches.linkBegin[c + 1];
        std::vector<std::uint32_t> nodes;
        std::vector<float> coefficients((last - first) * count);
        for (std::uint32_t k = first; k < last; ++k) {
            nodes.push_back(caches.links[k].node);
            expandLink(caches, c, k, bands, coefficients.data() + (k - first) * count);
        }
        packed.push_back(packHarmonics(bands, nodes, coefficients));
    }
    joinLinks(packed, caches);
    return baked;
}

TEST(LightCaches, GivesTheSameLightFromEitherStorage) {
    for (std::uint32_t bands = 2; bands <= 8; ++bands) {
        const Bake cones = bakedRoom(LinkStorage::Rtp, bands), harmonics = inHarmonics(cones);
        EXPECT_TRUE(cones.caches.shNode.empty());
        EXPECT_TRUE(harmonics.caches.links.empty());
        const std::vector<glm::vec4> radiosity = randomRadiosity(cones.tree, false);
        const auto a = lit(cones, radiosity, {int(bands), int(bands)}),
                   b = lit(harmonics, radiosity, {int(bands), int(bands)});
        const std::size_t count = std::size_t(bands) * bands;
        double worst = 0;
        for (std::size_t c = 0; c < cones.caches.size(); ++c) {
            double difference = 0, size = 0;
            for (std::size_t i = c * count; i < (c + 1) * count; ++i) {
                difference += double(glm::dot(a[i] - b[i], a[i] - b[i]));
                size += double(glm::dot(a[i], a[i]));
            }
            worst = std::max(worst, std::sqrt(difference / std::max(size, 1e-30)));
        }
        EXPECT_LT(worst, 2e-3) << bands << " bands";
        EXPECT_GT(worst, 0) << "halfs round differently";
    }
}

TEST(LightCaches, GreyLightIsTheSameHoweverFewBandsKeepTheirColour) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const int bands : {2, 3, 4, 8}) {
            const Bake baked = bakedRoom(storage, std::uint32_t(bands));
            const std::vector<glm::vec4> radiosity = randomRadiosity(baked.tree, true);
            const auto whole = lit(baked, radiosity, {bands, bands});
            for (int chroma = 1; chroma < bands; ++chroma)
                EXPECT_TRUE(lit(baked, radiosity, {bands, chroma}) == whole)
                    << bands << " bands, " << chroma << " of chrominance";
        }
}

TEST(LightCaches, FewerChromaBandsLoseOnlyTheColourAboveThem) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (int bands = 2; bands <= 8; ++bands) {
            const Bake baked = bakedRoom(storage, std::uint32_t(bands));
            const std::vector<glm::vec4> radiosity = randomRadiosity(baked.tree, false);
            const auto whole = lit(baked, radiosity, {bands, bands});
            const auto count = std::size_t(bands * bands);
            double lost = 0;
            for (int chroma = 1; chroma < bands; ++chroma) {
                const auto few = lit(baked, radiosity, {bands, chroma});
                for (std::size_t i = 0; i < few.size(); ++i) {
                    const YCoCg is = toYCoCg(few[i]), was = toYCoCg(whole[i]);
                    const bool kept = int(i % count) < chroma * chroma;
                    // Against the cache's mean radiance: rounding of sums.
                    const float near = 2e-5f * whole[i / count * count].y;
                    ASSERT_NEAR(is.y, was.y, near) << bands << " bands, " << chroma;
                    ASSERT_NEAR(is.co, kept ? was.co : 0, near) << bands << " bands, " << chroma;
                    ASSERT_NEAR(is.cg, kept ? was.cg : 0, near) << bands << " bands, " << chroma;
                    lost += kept ? 0 : std::abs(double(was.co));
                }
            }
            EXPECT_GT(lost, 0) << "the light has colour in its higher bands";
        }
}

/// The sum as the header states it, in doubles, from the cones.
std::vector<glm::dvec3> summed(const Bake& baked, const std::vector<glm::vec4>& radiosity,
                               std::uint32_t c, int bands) {
    const Caches& caches = baked.caches;
    std::vector<glm::dvec3> sum(std::size_t(bands * bands), glm::dvec3(0));
    for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k) {
        const Link& link = caches.links[k];
        float y[kMaxCoefficients], g[kMaxBands];
        shBasis(bands, unpackOct(link.octX, link.octY), y);
        coneFactors(bands, halfToFloat(link.u), g);
        const double transport =
            double(halfToFloat(link.transport)) * std::exp2(-double(caches.linkExponent[c]));
        for (int l = 0, i = 0; l < bands; ++l)
            for (; i < (l + 1) * (l + 1); ++i)
                sum[std::size_t(i)] +=
                    glm::dvec3(radiosity[link.node]) * (transport * double(g[l]) * double(y[i]));
    }
    return sum;
}

/// Returns the most links of a cache.
std::uint32_t expectSums(const Bake& baked, int bands) {
    const std::vector<glm::vec4> radiosity = randomRadiosity(baked.tree, false);
    const auto sh = lit(baked, radiosity, {bands, bands});
    const auto count = std::size_t(bands * bands);
    std::uint32_t most = 0;
    for (std::uint32_t c = 0; c < baked.caches.size(); ++c) {
        const std::uint32_t links = baked.caches.linkBegin[c + 1] - baked.caches.linkBegin[c];
        most = std::max(most, links);
        if (links == 0)
            continue;
        const std::vector<glm::dvec3> sum = summed(baked, radiosity, c, bands);
        // Rounding of sums: against the largest, the mean radiance.
        const double near = 2e-5 * (sum[0].x + sum[0].y + sum[0].z);
        for (std::size_t i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(sh[c * count + i][k], sum[i][k], near) << bands << " " << c;
    }
    return most;
}

TEST(LightCaches, IsTheSumOverTheLinks) {
    for (int bands = 2; bands <= 8; ++bands)
        expectSums(bakedRoom(LinkStorage::Rtp, std::uint32_t(bands)), bands);
}

TEST(LightCaches, IsTheSumOverManyLinks) {
    for (const int bands : {3, 4, 8})
        EXPECT_GT(expectSums(bakedRoom(LinkStorage::Rtp, std::uint32_t(bands), false, 400), bands),
                  300U)
            << "more than wait in a block";
}

// When it was r + (l - r) w, a lamp that nothing sees left 2^-24 of its light in what it was joined
// with: more than there is in a dark room.
TEST(PullRadiosity, BringsNothingOfALampWithoutWeight) {
    ClusterTree tree;
    tree.surfels = 3;
    tree.left = {0, 2};
    tree.right = {1, 3};
    tree.leftWeight = {1, 0};
    std::vector<glm::vec4> radiosity = {glm::vec4(1e-5f), glm::vec4(1e6f), glm::vec4(1e6f), {}, {}};
    pullRadiosity(tree, radiosity);
    EXPECT_EQ(radiosity[3], glm::vec4(1e-5f));
    EXPECT_EQ(radiosity[4], glm::vec4(1e-5f));
}

TEST(LightCaches, ABlackSkyNeedsNoneOfItsLinks) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        Bake baked = bakedRoom(storage, 3, true);
        std::vector<glm::vec4> radiosity = randomRadiosity(baked.tree, false);
        const std::vector<std::uint32_t> every = allLinks(baked.caches),
                                         few = linksBeforeSky(baked.caches, baked.tree);
        const auto all = std::uint32_t(baked.caches.size());
        const auto litBy = [&](const std::vector<std::uint32_t>& ends) {
            std::vector<glm::vec3> sh(all * 9U);
            lightCaches(baked.caches, ends, radiosity, {3, 3}, runsOf(0, all), sh);
            return sh;
        };
        std::uint64_t skipped = 0;
        for (std::uint32_t c = 0; c < all; ++c)
            skipped += every[c] - few[c];
        EXPECT_GT(skipped, all / 2);
        EXPECT_NE(litBy(every), litBy(few)); // while it shines
        std::fill_n(radiosity.begin() + baked.tree.surfels, baked.tree.skyCells, glm::vec4(0));
        pullRadiosity(baked.tree, radiosity);
        const auto whole = litBy(every), part = litBy(few);
        for (std::size_t i = 0; i < whole.size(); ++i)
            for (int k = 0; k < 3; ++k) // sums in another order
                ASSERT_NEAR(part[i][k], whole[i][k], 2e-6f * whole[i / 9 * 9][k] + 1e-12f);
    }
}

/// With no more than `most` links of each cache.
Caches shortened(const Caches& caches, std::uint32_t most, std::vector<std::uint32_t>& ends) {
    Caches out = caches;
    out.links.clear(), out.shNode.clear(), out.shCoefficients.clear();
    const auto stored = std::ptrdiff_t(
        caches.shNode.empty() ? 0 : caches.shCoefficients.size() / caches.shNode.size());
    ends.clear();
    for (std::size_t c = 0; c < caches.size(); ++c) {
        const std::ptrdiff_t begin = caches.linkBegin[c];
        ends.push_back(std::min(caches.linkBegin[c] + most, caches.linkBegin[c + 1]));
        const std::ptrdiff_t count = std::ptrdiff_t(ends.back()) - begin;
        if (caches.shNode.empty())
            out.links.insert(out.links.end(), caches.links.begin() + begin,
                             caches.links.begin() + begin + count);
        else
            out.shNode.insert(out.shNode.end(), caches.shNode.begin() + begin,
                              caches.shNode.begin() + begin + count);
        out.shCoefficients.insert(out.shCoefficients.end(),
                                  caches.shCoefficients.begin() + begin * stored,
                                  caches.shCoefficients.begin() + (begin + count) * stored);
        out.linkBegin[c + 1] = out.linkBegin[c] + std::uint32_t(count);
    }
    return out;
}

TEST(LightCaches, IsTheSameWhereverTheArrayOfLinksEnds) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (int bands = 2; bands <= 8; ++bands) {
            const Bake baked = bakedRoom(storage, std::uint32_t(bands));
            const std::vector<glm::vec4> radiosity = randomRadiosity(baked.tree, false);
            const auto all = std::uint32_t(baked.caches.size());
            const auto litBy = [&](const Caches& caches, LinkEnds ends) {
                std::vector<glm::vec3> sh(all * std::size_t(bands * bands));
                lightCaches(caches, ends, radiosity, {bands, bands}, runsOf(0, all), sh);
                return sh;
            };
            for (const std::uint32_t most : {1U, 2U, 5U, 20U}) {
                std::vector<std::uint32_t> ends;
                const Caches few = shortened(baked.caches, most, ends);
                EXPECT_EQ(few.linkCount(), few.linkBegin.back());
                EXPECT_TRUE(litBy(few, allLinks(few)) == litBy(baked.caches, ends))
                    << bands << " bands, " << most << " links";
            }
        }
}

TEST(ReadCaches, IsTheIrradianceOfTheWeightedCaches) {
    std::mt19937 rng(5);
    std::uniform_real_distribution<float> any(-1, 1);
    for (int bands = 2; bands <= 8; ++bands) {
        const auto count = std::size_t(bands * bands);
        std::vector<glm::vec3> sh(9 * count);
        for (glm::vec3& c : sh)
            c = {any(rng), any(rng), any(rng)};
        for (std::size_t c = 0; c < 9; ++c)
            sh[c * count] += 2.f; // mostly bright
        Surfels s;
        for (int i = 0; i < 500; ++i) {
            s.position.emplace_back(0);
            s.normal.push_back(glm::normalize(glm::vec3(any(rng), any(rng), any(rng))));
            s.cache.emplace_back(rng() % 9, rng() % 9, rng() % 9, i % 7 == 0 ? ~0U : rng() % 9);
            s.cacheWeight.emplace_back(0.4f, 0.3f, 0.2f, i % 7 == 0 ? 0 : 0.1f);
        }
        std::vector<glm::vec3> irradiance(s.size());
        readCaches(s, sh, bands, irradiance);
        for (std::size_t i = 0; i < s.size(); ++i) {
            std::vector<glm::vec3> mixed(count, glm::vec3(0));
            for (int k = 0; k < 4; ++k)
                for (std::size_t j = 0; s.cache[i][k] != ~0U && j < count; ++j)
                    mixed[j] += s.cacheWeight[i][k] * sh[s.cache[i][k] * count + j];
            const glm::vec3 e =
                glm::max(shIrradiance(std::min(bands, 3), mixed.data(), s.normal[i]), glm::vec3(0));
            for (int k = 0; k < 3; ++k)
                ASSERT_NEAR(irradiance[i][k], e[k], 2e-5f) << bands;
        }
    }
}

} // namespace
} // namespace limn::cache_light_test
