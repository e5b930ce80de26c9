// SPDX-License-Identifier: MIT
// Links to what sends no light: skipped without loss, and counted.
#include "engine/core/parallel.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"
#include "tests/core/vector_units.h"
#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <algorithm>
#include <iterator>
#include <random>

namespace limn::dark_links_test {
namespace {

Scene litHall(LinkStorage storage, std::uint32_t bands, bool window = false) {
    Scene scene = hall(storage, bands, window);
    scene.bake.lightmapCaches = 100;
    scene.bake.rays = 512;
    scene.bake.links = 80;
    return scene;
}

/// Of surfels of z above `from`: random colours; of the sky: its own; of the others none.
std::vector<glm::vec4> lightBeyond(const Bake& baked, float from, glm::vec3 sky) {
    std::mt19937 rng(4);
    std::uniform_real_distribution<float> any(0.1f, 1);
    std::vector<glm::vec4> radiosity(baked.tree.size(), glm::vec4(0));
    for (std::uint32_t s = 0; s < baked.tree.leaves(); ++s) {
        const glm::vec3 colour(any(rng), any(rng), any(rng));
        if (s >= baked.tree.surfels)
            radiosity[s] = withLuma(sky);
        else if (baked.surfels.position[s].z > from)
            radiosity[s] = withLuma(colour);
    }
    pullRadiosity(baked.tree, radiosity);
    return radiosity;
}

std::uint32_t nodeOf(const Caches& caches, std::uint32_t link) {
    return caches.shNode.empty() ? caches.links[link].node : caches.shNode[link];
}

/// Links in vectors of so many, a cache's last one shorter, of which all are dark.
std::uint64_t inDarkVectors(const Caches& caches, LinkEnds ends,
                            const std::vector<glm::vec4>& radiosity, std::uint32_t lanes) {
    std::uint64_t dark = 0;
    for (std::size_t c = 0; c < caches.size(); ++c)
        for (std::uint32_t k = caches.linkBegin[c]; k < ends[c]; k += lanes) {
            const std::uint32_t end = std::min(k + lanes, ends[c]);
            bool any = false;
            for (std::uint32_t j = k; j < end; ++j)
                any |= radiosity[nodeOf(caches, j)] != glm::vec4(0);
            dark += any ? 0 : end - k;
        }
    return dark;
}

/// With links that carry nothing from a node that is lit in place of those to dark ones.
Caches withoutDark(Caches caches, const std::vector<glm::vec4>& radiosity) {
    const auto bright = std::uint32_t(
        std::ranges::find_if(radiosity, [](glm::vec4 b) { return b.x > 0; }) - radiosity.begin());
    for (Link& link : caches.links)
        if (radiosity[link.node] == glm::vec4(0))
            link.node = bright, link.transport = 0;
    return caches;
}

struct Lit {
    std::vector<glm::vec3> sh;
    LinkCounts counts;
};

Lit lit(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
        LightBands bands) {
    const auto all = std::uint32_t(caches.size());
    Lit result;
    result.sh.resize(all * std::size_t(bands.luma * bands.luma));
    result.counts = lightCaches(caches, ends, radiosity, bands, runsOf(0, all), result.sh);
    return result;
}

/// Kinds of vectors, and how many links each holds.
struct Vectors {
    std::int64_t kind;
    std::uint32_t lanes;
};
constexpr Vectors kVectors[] = {{HWY_AVX3, 16}, {HWY_AVX2, 8}, {HWY_SCALAR, 1}};

std::vector<Vectors> vectorsHere() {
    std::vector<Vectors> here;
    std::ranges::copy_if(kVectors, std::back_inserter(here),
                         [&](const Vectors& v) { return (vectorUnitsHere() & v.kind) != 0; });
    return here;
}

void expectSkipped(const Bake& baked, LightBands bands, std::uint32_t lanes) {
    const Caches& caches = baked.caches;
    const std::vector<std::uint32_t> ends = allLinks(caches);
    // From where only three tenths of the hall are lit: a cut keeps more links to what lights a
    // cache than to the rest, and a vector of 16 links is dark only where all of them are.
    const std::vector<glm::vec4> radiosity = lightBeyond(baked, 3.5f, glm::vec3(0));
    const Lit over = lit(caches, ends, radiosity, bands),
              whole = lit(withoutDark(caches, radiosity), ends, radiosity, bands);
    EXPECT_EQ(over.counts.links, caches.linkCount());
    EXPECT_EQ(over.counts.skipped, inDarkVectors(caches, ends, radiosity, lanes));
    EXPECT_GT(over.counts.skipped, caches.linkCount() / 8);
    EXPECT_LT(over.counts.skipped, caches.linkCount() / 4 * 3);
    EXPECT_EQ(whole.counts.skipped, 0U);
    EXPECT_TRUE(over.sh == whole.sh) << bands.luma << " bands, " << bands.chroma << " coloured";
}

TEST(DarkLinks, AreSkippedByWholeVectorsWithoutAnyLoss) {
    ASSERT_FALSE(vectorsHere().empty());
    for (std::uint32_t bands = 2; bands <= 8; ++bands) {
        const auto baked = bakeOf(TraceScene(litHall(LinkStorage::Rtp, bands)));
        for (const Vectors& vectors : vectorsHere()) {
            const OnlyVectorUnit only(vectors.kind);
            for (int chroma = 1; chroma <= int(bands); ++chroma)
                expectSkipped(*baked, {int(bands), chroma}, vectors.lanes);
        }
    }
}

TEST(DarkLinks, AreAllOrNoneInTheDarkAndInTheLight) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        const Scene scene = litHall(storage, 3, true);
        const auto baked = bakeOf(TraceScene(scene));
        const Caches& caches = baked->caches;
        const std::vector<std::uint32_t> all = allLinks(caches),
                                         some = linksBeforeSky(caches, baked->tree);
        std::uint64_t sky = 0;
        for (std::size_t c = 0; c < all.size(); ++c)
            sky += all[c] - some[c];
        ASSERT_GT(sky, 0U);
        const auto night = lightBeyond(*baked, 9, glm::vec3(0)),
                   noon = lightBeyond(*baked, -1, glm::vec3(1)),
                   lamps = lightBeyond(*baked, -1, glm::vec3(0));
        EXPECT_EQ(lit(caches, all, noon, {3, 3}).counts.skipped, 0U);
        EXPECT_EQ(lit(caches, some, lamps, {3, 3}).counts.skipped, sky);
        const LinkCounts none = lit(caches, some, night, {3, 3}).counts;
        EXPECT_EQ(none.links, caches.linkCount());
        EXPECT_EQ(none.skipped, storage == LinkStorage::Rtp ? caches.linkCount() : sky);
    }
}

TEST(DarkLinks, AreCountedAlikeByAnyNumberOfThreads) {
    const Scene scene = litHall(LinkStorage::Rtp, 3);
    const auto baked = bakeOf(TraceScene(scene));
    const std::vector<glm::vec4> radiosity = lightBeyond(*baked, 2, glm::vec3(0));
    const auto count = [&](int threads) {
        const ThreadLimit limit(threads);
        return lit(baked->caches, allLinks(baked->caches), radiosity, {3, 3}).counts.skipped;
    };
    EXPECT_EQ(count(1), count(2));
    EXPECT_GT(count(1), 0U);
}

TEST(DarkLinks, AreThoseToWhatALampDoesNotReachUntilItsLightHasBounced) {
    Scene scene = litHall(LinkStorage::Rtp, 3);
    scene.lights.resize(1); // onto a part of the floor
    scene.lights[0].kind = LightKind::Spot;
    scene.lights[0].position = {3, 2, 4};
    scene.lights[0].outerAngle = 0.5f;
    scene.relight.maxBounces = 1;
    const TraceScene trace(scene);
    const auto baked = bakeOf(trace);
    const Caches& caches = baked->caches;
    const auto byLightmap = std::uint64_t(caches.linkBegin[caches.lightmapCount]);
    Relighter relighter(baked);
    const RelightStats one = relighter.relight(scene, trace, 1);
    EXPECT_EQ(one.links, byLightmap); // nothing is lit from the grid
    const std::vector<std::uint32_t> lightmapEnds = [&] {
        std::vector<std::uint32_t> ends = allLinks(caches);
        std::copy(caches.linkBegin.begin() + caches.lightmapCount, caches.linkBegin.end() - 1,
                  ends.begin() + caches.lightmapCount);
        return ends;
    }();
    const std::uint64_t expected =
        inDarkVectors(caches, lightmapEnds, relighter.radiosity(), vectorsHere().front().lanes);
    EXPECT_EQ(one.linksSkipped, expected);
    EXPECT_GT(expected, byLightmap / 4);
    EXPECT_EQ(relighter.relight(scene, trace, 0).links, 0U) << "nothing is lit";
    scene.relight.maxBounces = 64;
    relighter.relight(scene, trace, 64);
    scene.lights[0].strength *= 2;
    const RelightStats more = relighter.relight(scene, trace, 3);
    EXPECT_EQ(more.linksSkipped, 0U) << "bounced light is everywhere";
    EXPECT_GT(more.links, 2 * byLightmap);
}

} // namespace
} // namespace limn::dark_links_test
