// SPDX-License-Identifier: MIT
// A lookup on a page reads what the same lookup in the whole lightmap reads.
#include "engine/lightmap/lightmap_pages.h"

#include "engine/lightmap/atlas.h"
#include "engine/lightmap/charts.h"
#include "tests/lightmap/furniture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

namespace limn::lightmap_pages_test {
namespace {

using namespace simple;

struct Room {
    Room() {
        std::vector<MeshCharts> charts;
        for (const Mesh& mesh : scene.assets->meshes)
            charts.push_back(buildCharts(mesh));
        layout = buildAtlas(scene, std::move(charts), scene.bake).layout;
    }
    Scene scene = furniture();
    LightmapLayout layout;
};

/// A bilinear lookup in a texture of `size` whose texel t holds values[texelAt[t]].
double lookup(const std::vector<std::uint32_t>& texelAt, glm::uvec2 size,
              const std::vector<double>& values, glm::vec2 uv) {
    LightmapLayout texture;
    texture.width = size.x;
    texture.height = size.y;
    const Bilinear at = bilinearAt(texture, uv);
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += double(at.weight[k]) * values[texelAt[at.texel[k]]];
    return sum;
}

void expectEqualLookups(const Room& room, std::uint32_t factor, std::uint32_t maxSide) {
    const PlainLightmap plain = plainLightmap(room.scene, room.layout, factor);
    const LightmapPages one = onePage(room.scene, room.layout, factor),
                        pages = lightmapPages(room.scene, room.layout, factor, maxSide);
    ASSERT_GT(pages.count, 1U);
    EXPECT_LE(pages.width, maxSide);
    EXPECT_LE(pages.height, maxSide);
    std::mt19937 rng(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<double> values(plain.texels.size());
    for (double& v : values)
        v = double(unit(rng));
    std::vector<std::vector<std::uint32_t>> texels;
    for (std::uint32_t page = 0; page < pages.count; ++page)
        texels.push_back(pageTexels(plain, pages, page));
    std::set<std::uint32_t> seen;
    for (int k = 0; k < 20000; ++k) {
        const std::size_t i = rng() % room.scene.instances.size(), side = rng() % 2;
        const LightmapPages::Side &whole = one.instances[i][side], &part = pages.instances[i][side];
        ASSERT_EQ(whole.uv.size(), part.uv.size());
        if (whole.uv.empty())
            continue;
        const MeshCharts& charts = room.layout.meshes[room.scene.instances[i].mesh];
        const std::size_t t = rng() % charts.chartOfTriangle.size();
        float u = unit(rng), v = unit(rng);
        if (u + v > 1)
            u = 1 - u, v = 1 - v;
        const auto at = [&](const std::vector<glm::vec2>& uv) {
            return uv[charts.indices[3 * t]] * (1 - u - v) + uv[charts.indices[3 * t + 1]] * u +
                   uv[charts.indices[3 * t + 2]] * v;
        };
        const std::uint32_t page = part.page[charts.chartOfTriangle[t]];
        ASSERT_LT(page, pages.count);
        seen.insert(page);
        EXPECT_NEAR(lookup(texels[page], {pages.width, pages.height}, values, at(part.uv)),
                    lookup(plain.texelAt, {plain.width, plain.height}, values, at(whole.uv)), 1e-3)
            << "instance " << i << ", side " << side << ", triangle " << t;
    }
    EXPECT_EQ(seen.size(), pages.count);
}

TEST(LightmapPages, ReadTheSameLightAsOnePage) {
    const Room room;
    expectEqualLookups(room, 1, 40);
    expectEqualLookups(room, 3, 100);
}

TEST(LightmapPages, CopiesDoNotOverlap) {
    const Room room;
    const LightmapPages pages = lightmapPages(room.scene, room.layout, 1, 40);
    std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> taken;
    for (const LightmapPages::Copy& copy : pages.copies)
        for (std::uint32_t y = 0; y < copy.size.y; ++y)
            for (std::uint32_t x = 0; x < copy.size.x; ++x)
                EXPECT_TRUE(taken.emplace(copy.page, copy.to.x + x, copy.to.y + y).second);
}

TEST(LightmapPages, ALightmapThatFitsStaysAsItIs) {
    const Room room;
    const std::uint32_t side = std::max(room.layout.width, room.layout.height);
    const LightmapPages pages = lightmapPages(room.scene, room.layout, 3, 3 * side);
    EXPECT_EQ(pages.count, 1U);
    EXPECT_EQ(pages.width, 3 * room.layout.width);
    EXPECT_EQ(pages.instances[0][0].uv, room.layout.instances[0].uv);
    EXPECT_EQ(expectedPages(room.scene, room.layout, 3, 3 * side), 1U);
    EXPECT_EQ(pageTexels(plainLightmap(room.scene, room.layout, 3), pages, 0),
              plainLightmap(room.scene, room.layout, 3).texelAt);
}

TEST(LightmapPages, TheirNumberIsForeseen) {
    const Room room;
    const LargestChart largest = largestChart(room.scene, room.layout);
    ASSERT_GT(largest.side, 8U);
    EXPECT_EQ(largest.instance, 0U); // a wall
    for (const std::uint32_t side : {largest.side, largest.side + 3, 2 * largest.side}) {
        const double pages = lightmapPages(room.scene, room.layout, 1, side).count;
        EXPECT_NEAR(expectedPages(room.scene, room.layout, 1, side), pages, 0.5 * pages) << side;
    }
}

} // namespace
} // namespace limn::lightmap_pages_test
