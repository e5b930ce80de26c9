// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/overlay.h"

#include "engine/core/result.h"
#include "engine/math/packing.h"
#include "engine/overlay/palette.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/link_storage.h"
#include "engine/techniques/illuminance/overlay/dependencies.h"
#include "engine/techniques/illuminance/overlay/link_cut.h"
#include "engine/techniques/illuminance/overlay/surface_text.h"
#include "engine/techniques/illuminance/overlay/texel_overlay.h"
#include "engine/trace/trace_scene.h"
#include "tests/trace/simple_scene.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <map>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace limn::overlay_test {

namespace {

/// A room with a block that cuts into its floor, so that some caches lie in a wall, and a grid.
struct BakedRoom {
    Scene scene;
    Bake bake;

    BakedRoom() {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert({0.8f, 0.2f, 0.4f}));
        b.add(simple::box({-2, 0, -2}, {2, 3, 2}, true));
        b.add(simple::box({-0.5f, -1, -0.5f}, {0.5f, 1, 0.5f}, false));
        b.scene.bake.surfels = 600;
        b.scene.bake.links = 24;
        b.scene.bake.rays = 96;
        b.scene.bake.lightmapCaches = 400;
        b.scene.bake.grid = {3, 3, 3};
        scene = b.build();
        const TraceScene trace(scene);
        Result<Bake> made = limn::bake(trace);
        EXPECT_TRUE(made) << (made ? "" : made.error().message);
        if (made)
            bake = std::move(*made);
    }
};

const BakedRoom& room() {
    static const BakedRoom baked;
    return baked;
}

std::uint32_t firstCache(bool valid) {
    const Caches& caches = room().bake.caches;
    for (std::uint32_t c = 0; c < caches.size(); ++c)
        if (isValid(caches, c) == valid)
            return c;
    ADD_FAILURE() << "no such cache";
    return 0;
}

double sum(const std::vector<float>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0);
}

} // namespace

TEST(LinkCut, LeavesShareTheWeightsThatTheLinksSay) {
    const Bake& bake = room().bake;
    for (std::uint32_t c = 0; c < bake.caches.size(); c += 7) {
        double transport = 0;
        for (std::uint32_t k = bake.caches.linkBegin[c]; k < bake.caches.linkBegin[c + 1]; ++k)
            transport += double(linkWeight(bake.caches, c, k).transport);
        const LinkCut cut = linkCut(bake, c);
        double nodes = 0;
        for (const LinkedNode& n : cut.nodes)
            nodes += double(n.weight);
        EXPECT_NEAR(cut.total, transport, 1e-6 * transport);
        EXPECT_NEAR(nodes, transport, 1e-5 * transport);
        EXPECT_NEAR(sum(cut.leafWeight), transport, 1e-4 * transport);
    }
}

TEST(LinkCut, ANodesWeightGoesToTheLeavesBelowItByTheirShares) {
    // Leaves 0, 1, 2; node 3 = 0.25 * leaf 0 + 0.75 * leaf 1; node 4 = 0.4 * node 3 + 0.6 * leaf 2.
    Bake bake;
    bake.tree.surfels = 2;
    bake.tree.skyCells = 1;
    bake.tree.left = {0, 3};
    bake.tree.right = {1, 2};
    bake.tree.leftWeight = {0.25f, 0.4f};
    bake.tree.parent = {3, 3, 4, 4, ~0u};
    bake.caches.position = {glm::vec3(0)};
    bake.caches.links = {{3, 0, 0, 0, floatToHalf(0.5f)}, {4, 0, 0, 0, floatToHalf(0.25f)}};
    bake.caches.linkBegin = {0, 2};
    bake.caches.linkExponent = {0};
    const LinkCut cut = linkCut(bake, 0);
    EXPECT_EQ(cut.nodes.size(), 2u);
    EXPECT_EQ(cut.nodes[0].node, 3u);
    EXPECT_EQ(cut.nodes[0].leaves, 2u);
    EXPECT_EQ(cut.nodes[1].leaves, 3u);
    EXPECT_FLOAT_EQ(cut.leafWeight[0], 0.25f * (0.5f + 0.4f * 0.25f));
    EXPECT_FLOAT_EQ(cut.leafWeight[1], 0.75f * (0.5f + 0.4f * 0.25f));
    EXPECT_FLOAT_EQ(cut.leafWeight[2], 0.6f * 0.25f);
    EXPECT_FLOAT_EQ(cut.nodeWeight[0], 0.5f);
    EXPECT_FLOAT_EQ(cut.nodeWeight[2], 0.25f);
}

TEST(LinkCut, AnInvalidCacheNamesTheCachesItIsFilledFrom) {
    const LinkCut cut = linkCut(room().bake, firstCache(false));
    EXPECT_TRUE(cut.nodes.empty());
    double weights = 0;
    for (const auto& [source, weight] : cut.filledFrom) {
        EXPECT_TRUE(isValid(room().bake.caches, source));
        weights += double(weight);
    }
    EXPECT_NEAR(weights, 1, 1e-5);
}

TEST(LinkCut, TheCacheAtATexelsOwnPlaceIsThatTexels) {
    const Bake& bake = room().bake;
    const TexelUse use = texelUse(bake.lightmap, room().scene);
    std::uint32_t found = 0, own = 0;
    for (std::uint32_t s = 0; s < bake.surfels.size(); ++s) {
        const glm::vec2 b = bake.surfels.barycentric[s];
        Hit hit;
        hit.instance = bake.surfels.instance[s];
        hit.triangle = bake.surfels.triangle[s];
        hit.u = b.x, hit.v = b.y;
        hit.position = bake.surfels.position[s];
        const auto cache = cacheAt(bake, room().scene, hit);
        ASSERT_TRUE(cache);
        int best = 0;
        for (int k = 1; k < 4; ++k)
            if (bake.surfels.cacheWeight[s][k] > bake.surfels.cacheWeight[s][best])
                best = k;
        found += *cache == bake.surfels.cache[s][best];
        own += use.kind[bake.caches.texel[bake.surfels.cache[s][best]]] == TexelUse::Kind::Unused;
    }
    EXPECT_LT(own, bake.surfels.size() / 10); // read caches of their own
    EXPECT_EQ(found + own, bake.surfels.size());
}

TEST(Clusters, EveryLeafLiesBelowTheClusterThatStandsForItAtItsDepth) {
    const ClusterTree& tree = room().bake.tree;
    std::uint32_t before = 0;
    for (std::uint32_t depth = 0; depth <= treeDepth(tree); ++depth) {
        const std::vector<std::uint32_t> cluster = clustersAtDepth(tree, depth);
        ASSERT_EQ(cluster.size(), tree.leaves());
        for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf) {
            std::uint32_t node = leaf, above = 0;
            while (node != cluster[leaf] && tree.parent[node] != ~0u)
                node = tree.parent[node];
            EXPECT_EQ(node, cluster[leaf]);
            for (std::uint32_t p = node; tree.parent[p] != ~0u; p = tree.parent[p])
                ++above;
            EXPECT_TRUE(above == depth || (above < depth && node == leaf)) << leaf;
        }
        const auto count = std::uint32_t(std::set(cluster.begin(), cluster.end()).size());
        EXPECT_GT(count, before) << "depth " << depth;
        before = count;
    }
    EXPECT_EQ(before, tree.leaves());
}

TEST(Overlays, CachesAreMagentaWhereTheyHaveNoLinks) {
    const Bake& bake = room().bake;
    const OverlayData data = makeOverlay(bake, room().scene, {.kind = Overlay::Caches});
    ASSERT_EQ(data.marks.size(), bake.caches.size());
    std::uint64_t invalid = 0;
    for (std::size_t c = 0; c < data.marks.size(); ++c) {
        const bool magenta = data.marks[c].color == packColor({1, 0, 1});
        EXPECT_EQ(magenta, bake.caches.linkBegin[c] == bake.caches.linkBegin[c + 1]) << c;
        EXPECT_EQ(data.marks[c].position, bake.caches.position[c]);
        EXPECT_GT(data.marks[c].radius, 0);
        invalid += magenta;
    }
    EXPECT_GT(invalid, 0u);
    EXPECT_EQ(invalid, bake.counts.invalidCaches);
}

TEST(Overlays, SurfelsAreDiscsOfAShareOfTheirAreaInTheirAlbedo) {
    const Bake& bake = room().bake;
    const OverlayData data = makeOverlay(bake, room().scene, {.kind = Overlay::Surfels});
    ASSERT_EQ(data.marks.size(), bake.surfels.size());
    for (std::size_t i = 0; i < data.marks.size(); ++i) {
        const OverlayMark& m = data.marks[i];
        EXPECT_EQ(m.position, bake.surfels.position[i]);
        EXPECT_EQ(m.normal, bake.surfels.normal[i]);
        EXPECT_NEAR(3.14159265f * m.radius * m.radius, 0.36f * bake.surfels.area[i],
                    1e-5f * bake.surfels.area[i]);
        EXPECT_EQ(m.color, packColor(encodeSrgb({0.8f, 0.2f, 0.4f})));
    }
}

TEST(Overlays, TheLinkCutShowsWhichSurfelsAreLinkedAndWhichMost) {
    const Bake& bake = room().bake;
    const std::uint32_t cache = firstCache(true);
    const OverlayData data =
        makeOverlay(bake, room().scene, {.kind = Overlay::Links, .cache = cache});
    const LinkCut cut = linkCut(bake, cache);
    ASSERT_EQ(data.marks.size(), bake.surfels.size() + 1); // and the cache
    EXPECT_EQ(data.marks.back().position, bake.caches.position[cache]);
    EXPECT_EQ(data.marks.back().shape, MarkShape::Ring);
    const auto strongest =
        std::max_element(cut.nodeWeight.begin(), cut.nodeWeight.begin() + bake.tree.surfels);
    std::map<std::uint32_t, std::uint32_t> colors;
    for (std::size_t i = 0; i < bake.surfels.size(); ++i)
        if (cut.nodeWeight[i] == 0)
            ++colors[data.marks[i].color];
    EXPECT_LE(colors.size(), 1u);
    EXPECT_FALSE(
        colors.contains(data.marks[std::size_t(strongest - cut.nodeWeight.begin())].color));
}

TEST(Dependencies, ARoomOfEqualRadiosityLightsEverythingInItWithThatMuch) {
    const Bake& bake = room().bake;
    std::vector<glm::vec4> radiosity(bake.tree.size(), glm::vec4(1, 1, 1, 0));
    const auto of = [&](std::uint32_t cache) {
        return dependenciesOf(bake, room().scene, radiosity, cache);
    };
    const glm::vec3 air(1.3f, 2, 1.3f);
    std::uint32_t cell = bake.caches.lightmapCount;
    for (std::uint32_t c = cell; c < bake.caches.size(); ++c)
        if (glm::distance(bake.caches.position[c], air) <
            glm::distance(bake.caches.position[cell], air))
            cell = c;
    for (const std::uint32_t cache : {firstCache(true), cell}) {
        const Dependencies all = of(cache);
        EXPECT_NEAR(all.total, 1, 0.03) << cache;
        EXPECT_EQ(all.sky, 0);
        EXPECT_NEAR(all.sent[0] + all.sent[1], all.total, 1e-9);
        EXPECT_GT(all.sent[1], 0.01) << "the block lights the room and its grid";
    }
    // What is dark sends nothing.
    for (std::uint32_t i = 0; i < bake.surfels.size(); ++i)
        if (bake.surfels.instance[i] == 0)
            radiosity[i] = glm::vec4(0);
    const Dependencies one = of(firstCache(true));
    EXPECT_EQ(one.sent[0], 0);
    EXPECT_GT(one.sent[1], 0);
    EXPECT_EQ(one.total, one.sent[1]);
}

TEST(Dependencies, AnInvalidCellIsLitAsTheCellsThatFillIt) {
    const Bake& bake = room().bake;
    const Caches& caches = bake.caches;
    const std::vector<glm::vec4> radiosity(bake.tree.size(), glm::vec4(1, 1, 1, 0));
    const std::uint32_t invalid = firstCache(false);
    ASSERT_EQ(caches.kind[invalid], CacheKind::Grid);
    double mean = 0;
    for (std::uint32_t k = caches.fillBegin[invalid]; k < caches.fillBegin[invalid + 1]; ++k) {
        ASSERT_EQ(caches.kind[caches.fillSource[k]], CacheKind::Grid);
        mean += double(caches.fillWeight[k]) *
                dependenciesOf(bake, room().scene, radiosity, caches.fillSource[k]).total;
    }
    EXPECT_GT(mean, 0.1);
    EXPECT_NEAR(dependenciesOf(bake, room().scene, radiosity, invalid).total, mean, 1e-6);
}

TEST(Dependencies, TheTexelsOfAnObjectAllGiveItsOwnAnswer) {
    const Bake& bake = room().bake;
    const std::vector<glm::vec4> radiosity(bake.tree.size(), glm::vec4(1, 1, 1, 0));
    std::map<std::uint32_t, Dependencies> byInstance;
    for (std::uint32_t c = 0; c < bake.caches.lightmapCount; c += 37) {
        const Dependencies of = dependenciesOf(bake, room().scene, radiosity, c);
        const auto [at, first] = byInstance.emplace(of.instance, of);
        EXPECT_EQ(of.sent, at->second.sent) << c;
    }
    EXPECT_TRUE(byInstance.contains(0) && byInstance.contains(1));
    // The block cannot see itself, and the room is lit by both.
    EXPECT_EQ(byInstance[1].instance, 1U);
    EXPECT_LT(byInstance[1].sent[1], 0.02 * byInstance[1].total);
    EXPECT_GT(byInstance[0].sent[0], byInstance[0].sent[1]);
}

TEST(Dependencies, TheLegendNamesWhatSendsMostOrSaysThatNothingDoes) {
    const Bake& bake = room().bake;
    LitBake lit{std::vector<glm::vec4>(bake.tree.size(), glm::vec4(1, 1, 1, 0)),
                std::vector<glm::vec3>(bake.caches.size() * 4), 2};
    const OverlayOptions options{.kind = Overlay::Dependencies, .cache = firstCache(true)};
    const OverlayData data = makeOverlay(bake, room().scene, options, &lit);
    EXPECT_EQ(data.marks.size(), bake.surfels.size());
    EXPECT_EQ(data.legend.entries.size(), 5U);
    ASSERT_EQ(data.legend.notes.size(), 3U);
    EXPECT_NE(data.legend.notes[1].find("instance 0 (itself)"), std::string::npos);
    EXPECT_NE(data.legend.notes[2].find("instance 1"), std::string::npos);
    lit.radiosity.assign(lit.radiosity.size(), glm::vec4(0));
    EXPECT_EQ(makeOverlay(bake, room().scene, options, &lit).legend.notes,
              std::vector<std::string>{"No bounced light reaches it"});
}

TEST(SurfaceText, TellsTheNumbersOfTheSurfelCacheAndTexelAtAPoint) {
    const Bake& bake = room().bake;
    const Scene& scene = room().scene;
    const TraceScene trace(scene);
    const Hit hit = trace.closestHit({{1.3f, 2, 0.4f}, {0, -1, 0}});
    ASSERT_TRUE(hit);
    const LitBake lit{std::vector<glm::vec4>(bake.tree.size(), glm::vec4(2, 2, 2, 0)),
                      std::vector<glm::vec3>(bake.caches.size() * 4, glm::vec3(1)), 2};
    const auto textOf = [&](Overlay kind, const LitBake* light) {
        std::string text;
        for (const OverlayLine& line : describeSurface(bake, scene, {.kind = kind}, hit, light))
            text += line.text + "|";
        return text;
    };
    std::uint32_t nearest = 0;
    for (std::uint32_t i = 0; i < bake.surfels.size(); ++i)
        if (glm::distance(bake.surfels.position[i], hit.position) <
            glm::distance(bake.surfels.position[nearest], hit.position))
            nearest = i;
    const std::string surfel = fmt::format("Surfel {}, ", nearest);
    EXPECT_EQ(textOf(Overlay::Surfels, nullptr).find(surfel), 0U);
    EXPECT_NE(textOf(Overlay::Surfels, nullptr).find("Albedo 0.80 0.20 0.40"), std::string::npos);
    EXPECT_NE(textOf(Overlay::SurfelNormals, nullptr).find("+1.00"), std::string::npos);
    EXPECT_NE(textOf(Overlay::LitSurfels, &lit).find("Sends 2 lux"), std::string::npos);
    EXPECT_EQ(textOf(Overlay::LitSurfels, nullptr).find("Sends"), std::string::npos);
    const std::string cache = fmt::format("Cache {}, ", *cacheAt(bake, scene, hit));
    EXPECT_EQ(textOf(Overlay::Caches, nullptr).find(cache), 0U);
    EXPECT_NE(textOf(Overlay::Lobes, &lit).find("Receives"), std::string::npos);
    EXPECT_NE(textOf(Overlay::Density, nullptr).find("texels per metre"), std::string::npos);
    for (std::uint32_t k = 1; k < kOverlays.size(); ++k)
        EXPECT_FALSE(textOf(Overlay(k), &lit).empty()) << kOverlays[k].name;
    Hit unknown = hit;
    unknown.instance = std::uint32_t(scene.instances.size());
    for (std::uint32_t k = 1; k < kOverlays.size(); ++k)
        EXPECT_FALSE(describeSurface(bake, scene, {.kind = Overlay(k)}, unknown, nullptr).empty());
}

TEST(Overlays, OneWithoutAPickOrWithoutABakeSaysSoAndDrawsNothing) {
    EXPECT_TRUE(makeOverlay(room().bake, room().scene, {.kind = Overlay::Links}).marks.empty());
    for (std::uint32_t k = 0; k < kOverlays.size(); ++k) {
        const OverlayData data = makeOverlay(Bake{}, Scene{}, {.kind = Overlay(k)});
        EXPECT_TRUE(data.marks.empty() && data.texels.empty()) << kOverlays[k].name;
    }
}

TEST(Overlays, EachHasALegend) {
    for (std::uint32_t k = 1; k < kOverlays.size(); ++k) {
        const LitBake lit{std::vector<glm::vec4>(room().bake.tree.size(), glm::vec4(1)),
                          std::vector<glm::vec3>(room().bake.caches.size() * 4, glm::vec3(1)), 2};
        const OverlayData data = makeOverlay(room().bake, room().scene,
                                             {.kind = Overlay(k), .depth = 3, .cache = 0}, &lit);
        EXPECT_FALSE(data.legend.title.empty()) << kOverlays[k].name;
        EXPECT_FALSE(data.legend.entries.empty() && data.legend.notes.empty());
        EXPECT_FALSE(data.marks.empty() && data.texels.empty()) << kOverlays[k].name;
    }
}

namespace {

/// A quad of 2 m x 1 m whose UV covers the texels (0, 0) .. (8, 4) of a 16 x 8 lightmap; instances
/// of it further down may lie elsewhere.
struct QuadLayout {
    simple::SceneBuilder builder;
    LightmapLayout layout;

    QuadLayout() {
        builder.addMaterial(simple::lambert({0.5f, 0.5f, 0.5f}));
        builder.addMesh(simple::quad({0, 0, 0}, {2, 0, 0}, {0, 1, 0}));
        layout.width = 16;
        layout.height = 8;
        layout.meshes = {{{0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {0, 0}, {}, {{2, 1}}}};
    }
    void place(glm::vec2 corner, glm::vec2 size) {
        builder.addInstance(0);
        InstanceLightmap uv;
        for (const glm::vec2 c : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}})
            uv.uv.push_back((corner + c * size) / glm::vec2(16, 8));
        layout.instances.push_back(uv);
    }
    TexelUse use() { return texelUse(layout, builder.build()); }
};

} // namespace

TEST(TexelUses, ChartsWithBordersOnTexelCentresUseTheirTexelsOnceAtTheirDensity) {
    QuadLayout q;
    q.place({0.5f, 0.5f}, {8, 4}); // 9 x 5 texels
    q.place({9.5f, 0.5f}, {4, 2}); // its neighbour begins at the next texel
    const TexelUse use = q.use();
    EXPECT_EQ(use.charts, 2u);
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) {
            const std::size_t k = y * 16 + x;
            const bool first = x < 9 && y < 5, second = x >= 9 && x < 14 && y < 3;
            EXPECT_EQ(use.kind[k],
                      first || second ? TexelUse::Kind::Single : TexelUse::Kind::Unused)
                << x << ", " << y;
            EXPECT_EQ(use.chart[k], first ? 0u : second ? 1u : ~0u);
            EXPECT_NEAR(use.density[k], first ? 4 : second ? 2 : 0, 1e-4);
        }
}

TEST(TexelUses, SurfacesThatLieOverEachOtherAreFound) {
    QuadLayout q;
    q.place({0.5f, 0.5f}, {8, 4});
    q.place({6.5f, 0.5f}, {6, 4});
    const TexelUse use = q.use();
    EXPECT_EQ(use.kind[2 * 16 + 3], TexelUse::Kind::Single);
    EXPECT_EQ(use.kind[2 * 16 + 7], TexelUse::Kind::Overlap);
    EXPECT_EQ(use.kind[2 * 16 + 11], TexelUse::Kind::Single);
}

TEST(TexelUses, ATexelThatTwoChartsLookUpWithoutCoveringItTwiceIsShared) {
    QuadLayout q;
    q.place({0.5f, 0.5f}, {3, 3});
    q.place({4.2f, 0.5f}, {3, 3}); // reads texel 3 as well
    q.place({10.5f, 4.5f}, {0, 0});
    q.place({10.5f, 4.5f}, {0, 0}); // two charts of one texel
    const TexelUse use = q.use();
    EXPECT_EQ(use.kind[1 * 16 + 3], TexelUse::Kind::Shared);
    EXPECT_EQ(use.kind[4 * 16 + 10], TexelUse::Kind::Shared);
    EXPECT_NEAR(use.density[4 * 16 + 10], std::sqrt(0.5), 1e-4); // one texel for 2 m^2
}

TEST(TexelUses, ABakesLightmapHasNoOverlapAndUsesTheTexelsOfItsCaches) {
    const Bake& bake = room().bake;
    const TexelUse use = texelUse(bake.lightmap, room().scene);
    std::uint32_t texels = bake.caches.lightmapCount; // and then caches of surfels' own
    while (texels > 0 && use.kind[bake.caches.texel[texels - 1]] == TexelUse::Kind::Unused)
        --texels;
    EXPECT_GE(texels, bake.caches.lightmapCount * 20 / 21);
    for (std::uint32_t c = 0; c < texels; ++c)
        EXPECT_NE(use.kind[bake.caches.texel[c]], TexelUse::Kind::Unused) << c;
    for (const TexelUse::Kind kind : use.kind)
        EXPECT_NE(kind, TexelUse::Kind::Overlap);
}

TEST(LightOverlays, EqualRadiosityIsOneColourAndTwiceAsMuchIsBrighter) {
    const Bake& bake = room().bake;
    LitBake lit{std::vector<glm::vec4>(bake.tree.size(), glm::vec4(2)),
                std::vector<glm::vec3>(bake.caches.size() * 4, glm::vec3(0)), 2};
    lit.radiosity[5] = glm::vec4(4);
    const OverlayData data = makeOverlay(bake, room().scene, {.kind = Overlay::LitSurfels}, &lit);
    ASSERT_EQ(data.marks.size(), bake.surfels.size());
    for (std::size_t i = 0; i < data.marks.size(); ++i)
        EXPECT_EQ(data.marks[i].color == data.marks[0].color, i != 5) << i;
    EXPECT_GT(data.marks[5].color & 255, data.marks[0].color & 255);
    // At the root there is one cluster.
    const OverlayData root =
        makeOverlay(bake, room().scene, {.kind = Overlay::LitClusters, .depth = 0}, &lit);
    for (const OverlayMark& m : root.marks)
        EXPECT_EQ(m.color, root.marks[0].color);
}

TEST(LightOverlays, ALobeReachesAsFarAsTheLightAndIsMagentaWhereThatIsNegative) {
    const Bake& bake = room().bake;
    const std::uint32_t cache = firstCache(true);
    LitBake lit{std::vector<glm::vec4>(bake.tree.size(), glm::vec4(0)),
                std::vector<glm::vec3>(bake.caches.size() * 4, glm::vec3(0)), 2};
    lit.cacheSh[cache * 4 + 1] = glm::vec3(1); // L = sqrt(3 / 4 pi) y
    const OverlayOptions options{.kind = Overlay::Lobes, .cache = cache};
    const OverlayData data = makeOverlay(bake, room().scene, options, &lit);
    ASSERT_FALSE(data.marks.empty());
    glm::vec3 centre(0); // the figure is symmetric
    for (const OverlayMark& m : data.marks)
        centre += m.position / float(data.marks.size());
    const auto isMagenta = [](const OverlayMark& m) {
        return (m.color & 255) > 0 && (m.color >> 8 & 255) == 0;
    };
    float reach = 0;
    for (const OverlayMark& m : data.marks)
        reach = std::max(reach, glm::distance(m.position, centre));
    for (const OverlayMark& m : data.marks) {
        const glm::vec3 d = m.position - centre;
        const float r = glm::length(d);
        if (r < 0.1f * reach)
            continue;
        EXPECT_EQ(isMagenta(m), d.y < 0);
        EXPECT_NEAR(r / reach, std::abs(d.y) / r, 0.02f); // r = cos
    }
}

TEST(LightOverlays, ALobeHasTheColourOfItsLightAndTheUnitsOfTheEditor) {
    const Bake& bake = room().bake;
    const std::uint32_t cache = firstCache(true);
    LitBake lit{std::vector<glm::vec4>(bake.tree.size(), glm::vec4(0)),
                std::vector<glm::vec3>(bake.caches.size() * 4, glm::vec3(0)), 2};
    // Green light from everywhere, and red light from +X, of which -X has less than none.
    lit.cacheSh[std::size_t(cache) * 4] = {0, 1, 0};
    lit.cacheSh[std::size_t(cache) * 4 + 3] = {0.5f, 0, 0};
    const OverlayOptions options{.kind = Overlay::Lobes, .cache = cache};
    const OverlayData data = makeOverlay(bake, room().scene, options, &lit);
    const auto red = [](const OverlayMark& m) { return m.color & 255; };
    const auto byX = [](const OverlayMark& a, const OverlayMark& b) {
        return a.position.x < b.position.x;
    };
    const auto [left, right] = std::ranges::minmax_element(data.marks, byX);
    EXPECT_EQ(red(*left), 0U);
    EXPECT_GT(red(*right), 150U);
    for (const OverlayMark& m : data.marks) {
        EXPECT_GT(m.color >> 8 & 255, red(m)); // green is the brightest
        EXPECT_EQ(m.color >> 16 & 255, 0U);
    }
    ASSERT_EQ(data.legend.entries.size(), 2U);
    for (const OverlayLegend::Entry& entry : data.legend.entries)
        EXPECT_TRUE(entry.text.ends_with(" nits")) << entry.text;
    const OverlayData lamps = makeOverlay(bake, room().scene, {.kind = Overlay::LitSurfels}, &lit);
    for (const OverlayLegend::Entry& entry : lamps.legend.entries)
        EXPECT_TRUE(entry.text.ends_with(" lux")) << entry.text;
}

TEST(Palette, ViridisGrowsLighterAndDistinctColoursDiffer) {
    float before = -1;
    for (int k = 0; k <= 32; ++k) {
        const glm::vec3 c = viridis(float(k) / 32);
        const float grey = glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f));
        EXPECT_GT(grey, before);
        before = grey;
    }
    for (std::uint32_t k = 0; k < 200; ++k)
        for (std::uint32_t other = k + 1; other < k + 8; ++other)
            EXPECT_GT(glm::distance(distinctColor(k), distinctColor(other)), 0.1f)
                << k << ", " << other;
}

} // namespace limn::overlay_test
