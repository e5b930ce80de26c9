// SPDX-License-Identifier: MIT
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/charts.h"
#include "engine/lightmap/planar_set.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace limn::charts_test {
namespace {

using namespace simple;

/// A wavy strip with a hole, a sphere and a fan of crossing sheets: curved, open, non-manifold.
Mesh awkwardMesh() {
    Mesh m = sphere(1, 2, false);
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> any(-1, 1);
    for (int i = 0; i < 60; ++i) { // a soup
        const auto base = std::uint32_t(m.positions.size());
        for (int k = 0; k < 3; ++k) {
            m.positions.emplace_back(3 + any(rng), any(rng), any(rng));
            m.normals.emplace_back(0, 1, 0);
        }
        m.indices.insert(m.indices.end(), {base, base + 1, base + 2});
    }
    const auto spine = std::uint32_t(m.positions.size());
    m.positions.insert(m.positions.end(), {{0, 0, 4}, {0, 2, 4}});
    for (int i = 0; i < 6; ++i) { // sheets sharing one edge
        const float a = float(i);
        m.positions.emplace_back(std::cos(a), 0, 4 + std::sin(a));
        m.indices.insert(m.indices.end(),
                         {spine, spine + 1, std::uint32_t(m.positions.size() - 1)});
    }
    m.normals.resize(m.positions.size(), {0, 1, 0});
    return m;
}

TEST(PlanarSet, OverlapSeesInteriorsAndNotSharedEdges) {
    const Triangle2 a = {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)};
    EXPECT_TRUE(trianglesOverlap(a, a));
    EXPECT_FALSE(trianglesOverlap(a, {glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}));
    EXPECT_TRUE(trianglesOverlap(a, {glm::vec2(0.9f, 0), glm::vec2(1, 1), glm::vec2(0, 0.9f)}));
    EXPECT_TRUE(
        trianglesOverlap(a, {glm::vec2(0.2f, 0.2f), glm::vec2(0.2f, 0.3f), glm::vec2(0.3f, 0.2f)}));
    EXPECT_FALSE(trianglesOverlap(a, {glm::vec2(2, 2), glm::vec2(3, 2), glm::vec2(2, 3)}));
}

TEST(Charts, EveryTriangleKeepsItsCornersAndLiesFlatToScale) {
    const Mesh mesh = awkwardMesh();
    const MeshCharts charts = buildCharts(mesh);
    ASSERT_EQ(charts.indices.size(), mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        EXPECT_EQ(charts.sourceVertex[charts.indices[i]], mesh.indices[i]);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const glm::vec2 a = charts.chartUv[charts.indices[3 * t]],
                        b = charts.chartUv[charts.indices[3 * t + 1]],
                        c = charts.chartUv[charts.indices[3 * t + 2]];
        const auto [ia, ib, ic] = mesh.triangle(t);
        const float flat = std::abs((b - a).x * (c - a).y - (b - a).y * (c - a).x);
        const float real = glm::length(glm::cross(mesh.positions[ib] - mesh.positions[ia],
                                                  mesh.positions[ic] - mesh.positions[ia]));
        EXPECT_LE(flat, real * 1.001f);
        EXPECT_GE(flat, real * 0.49f); // within 60 degrees of the chart's plane
    }
}

TEST(Charts, NoTwoTrianglesOfAChartOverlap) {
    const MeshCharts charts = buildCharts(awkwardMesh());
    const std::size_t count = charts.chartOfTriangle.size();
    const auto flat = [&](std::size_t t) {
        return Triangle2{charts.chartUv[charts.indices[3 * t]],
                         charts.chartUv[charts.indices[3 * t + 1]],
                         charts.chartUv[charts.indices[3 * t + 2]]};
    };
    for (std::size_t s = 0; s < count; ++s)
        for (std::size_t t = 0; t < s; ++t)
            if (charts.chartOfTriangle[s] == charts.chartOfTriangle[t]) {
                EXPECT_FALSE(trianglesOverlap(flat(s), flat(t))) << s << " " << t;
            }
}

TEST(Charts, AuthoredUvIsUsedOnlyWhenItDoesNotOverlap) {
    Mesh m = quad({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
    m.uv1 = {{0.1f, 0.1f}, {0.5f, 0.1f}, {0.5f, 0.5f}, {0.1f, 0.5f}};
    EXPECT_EQ(lightmapUvDefect(m), "");
    const MeshCharts charts = buildCharts(m);
    ASSERT_EQ(charts.chartSize.size(), 1U);
    EXPECT_NEAR(charts.chartSize[0].x, 2, 1e-5); // to the scale of the surface
    m.uv1[2] = {1.5f, 0.5f};
    EXPECT_EQ(lightmapUvDefect(m), "TEXCOORD_1 outside [0, 1]");
    m.uv1 = {{0, 0}, {1, 0}, {1, 1}, {0.9f, 0.1f}}; // folds the second triangle over the first
    EXPECT_EQ(lightmapUvDefect(m), "TEXCOORD_1 overlaps itself");
    m.uv1.assign(4, {0.5f, 0.5f});
    EXPECT_EQ(lightmapUvDefect(m), "TEXCOORD_1 has triangles without area");
}

Scene awkwardScene() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    const std::uint32_t mesh = b.addMesh(awkwardMesh());
    b.addInstance(mesh);
    b.addInstance(mesh, glm::mat4(glm::vec4(0, 0, 3, 0), glm::vec4(0, -2, 0, 0),
                                  glm::vec4(1, 0, 0, 0), glm::vec4(9, 0, 0, 1)));
    b.addInstance(mesh, glm::mat4(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 1, 0, 0),
                                  glm::vec4(0, 0, 1, 0), glm::vec4(0, 9, 0, 1))); // mirrored
    b.add(box(glm::vec3(-5), glm::vec3(15), true));
    return b.build();
}

Atlas atlasOf(const Scene& scene, const BakeSettings& settings) {
    std::vector<MeshCharts> charts;
    for (const Mesh& m : scene.assets->meshes)
        charts.push_back(buildCharts(m));
    return buildAtlas(scene, charts, settings);
}

/// Axis and sign of the largest component of a chart's summed normal: -3 … -1, 1 … 3.
int sideOf(const Mesh& mesh, const MeshCharts& charts, std::uint32_t chart) {
    glm::vec3 sum(0);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        if (charts.chartOfTriangle[t] == chart)
            sum += triangleNormal(mesh, t) * triangleArea(mesh, t);
    const glm::vec3 size = glm::abs(sum);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    return sum[axis] < 0 ? -1 - axis : 1 + axis;
}

TEST(Atlas, ALookupMeetsTexelsOfItsOwnChartOrOfNeighboursThatFaceTheSameSide) {
    const Scene scene = awkwardScene();
    BakeSettings settings;
    settings.lightmapCaches = 3000;
    const Atlas atlas = atlasOf(scene, settings);
    struct Users { // of a texel
        std::set<std::uint32_t> instances;
        std::set<std::uint32_t> charts;
        glm::vec3 lower{1e30f}, upper{-1e30f}; ///< of the points, object space
    };
    std::vector<Users> users(std::size_t(atlas.layout.width) * atlas.layout.height);
    std::vector<bool> cached(users.size());
    for (const AtlasTexel& t : atlas.texels)
        cached[t.texel] = true;
    std::mt19937 rng(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t mesh = scene.instances[i].mesh;
        const MeshCharts& charts = atlas.layout.meshes[mesh];
        for (std::uint32_t t = 0; t < charts.chartOfTriangle.size(); ++t)
            for (int k = 0; k < 20; ++k) {
                glm::vec2 b(unit(rng), unit(rng));
                if (b.x + b.y > 1)
                    b = 1.f - b;
                const Bilinear lookup =
                    bilinearAt(atlas.layout, lightmapUv(atlas.layout, i, mesh, t, b.x, b.y, false));
                for (int c = 0; c < 4; ++c) {
                    if (lookup.weight[c] < 1e-3f) // rounding at a texel centre
                        continue;
                    EXPECT_TRUE(cached[lookup.texel[c]]);
                    Users& u = users[lookup.texel[c]];
                    const glm::vec3 p = trianglePoint(scene.assets->meshes[mesh], t, b);
                    u.instances.insert(i);
                    u.charts.insert(charts.chartOfTriangle[t]);
                    u.lower = glm::min(u.lower, p);
                    u.upper = glm::max(u.upper, p);
                }
            }
    }
    // A texel's lookups reach 2 texels; sides are rounded to whole texels, so a texel may be up to
    // twice as wide as wanted. Charts that share it lie in a slab of 1 + 2 texels.
    std::size_t shared = 0;
    for (const Users& u : users) {
        EXPECT_LE(u.instances.size(), 1U);
        if (u.charts.size() < 2)
            continue;
        ++shared;
        const std::uint32_t mesh = scene.instances[*u.instances.begin()].mesh;
        std::set<int> sides;
        for (const std::uint32_t c : u.charts)
            sides.insert(sideOf(scene.assets->meshes[mesh], atlas.layout.meshes[mesh], c));
        EXPECT_EQ(sides.size(), 1U);
        const float texel =
            1 / (atlas.texelsPerMetre * atlasScale(scene.instances[*u.instances.begin()]));
        const glm::vec3 size = (u.upper - u.lower) / texel;
        EXPECT_LT(std::max({size.x, size.y, size.z}), 4.f);
    }
    EXPECT_LT(shared, atlas.texels.size() / 10);
}

/// Two parallel bars along x as one mesh: `width` thick, with a gap of half that between them.
Scene barsScene(float width) {
    Mesh bars = box({0, 0, 0}, {20, width, width}, false);
    const Mesh other = box({0, 0, 1.5f * width}, {20, width, 2.5f * width}, false);
    const auto first = std::uint32_t(bars.positions.size());
    bars.positions.insert(bars.positions.end(), other.positions.begin(), other.positions.end());
    bars.normals.insert(bars.normals.end(), other.normals.begin(), other.normals.end());
    bars.uv0.clear();
    for (const std::uint32_t i : other.indices)
        bars.indices.push_back(first + i);
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(bars);
    return b.build();
}

/// The texel that a corner of a triangle reads most.
std::uint32_t texelAt(const Atlas& atlas, std::uint32_t triangle, int corner) {
    const glm::vec2 at(corner == 1 ? 1 : 0, corner == 2 ? 1 : 0);
    const Bilinear b =
        bilinearAt(atlas.layout, lightmapUv(atlas.layout, 0, 0, triangle, at.x, at.y, false));
    return b.texel[std::max_element(&b.weight[0], &b.weight[0] + 4) - &b.weight[0]];
}

// The front of a window's frame may face a dark room while the side of the frame faces the sky.
TEST(Atlas, AStripWiderThanAnEighthOfATexelHasTexelsOfItsOwnAtBothEdges) {
    BakeSettings settings;
    settings.texelsPerMetre = 1;
    for (const float width : {0.14f, 0.3f, 0.45f}) {
        const Scene scene = barsScene(width);
        const Atlas atlas = atlasOf(scene, settings);
        const Mesh& mesh = scene.assets->meshes[0];
        std::map<std::uint32_t, std::set<int>> readers; // faces of the bars, by texel
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            if (triangleArea(mesh, t) < width) // the ends of the bars
                continue;
            for (int a = 0; a < 3; ++a) {
                readers[texelAt(atlas, t, a)].insert(int(t / 2));
                for (int b = 0; b < a; ++b)
                    EXPECT_NE(texelAt(atlas, t, a), texelAt(atlas, t, b)) << width;
            }
        }
        EXPECT_EQ(readers.size(), 32U);
        for (const auto& [texel, faces] : readers)
            EXPECT_EQ(faces.size(), 1U) << width;
    }
    const Atlas narrow = atlasOf(barsScene(0.06f), settings);
    EXPECT_LT(narrow.texels.size(), 8U * 21) << "faces that look alike share texels";
}

TEST(Atlas, ATwoSidedSurfaceHasOnePlaceForEachSide) {
    Scene scene = awkwardScene();
    BakeSettings settings;
    settings.texelsPerMetre = 4;
    const Atlas one = atlasOf(scene, settings);
    SceneBuilder b;
    b.scene = scene;
    b.assets = std::make_shared<Assets>(*scene.assets);
    Material both = lambert(glm::vec3(0.5f));
    both.doubleSided = true;
    b.addMaterial(both);
    b.scene.instances[1].material = 1;
    const Atlas two = atlasOf(b.build(), settings);
    const auto count = [](const Atlas& atlas, std::uint32_t instance, std::uint32_t back) {
        return std::ranges::count_if(atlas.texels, [&](const AtlasTexel& t) {
            return t.instance == instance && t.back == back;
        });
    };
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        EXPECT_EQ(two.layout.instances[i].backRows > 0, i == 1);
        EXPECT_EQ(count(two, i, 0), count(one, i, 0));
        EXPECT_EQ(count(two, i, 1), i == 1 ? count(one, i, 0) : 0);
    }
    std::map<std::uint32_t, const AtlasTexel*> at;
    for (const AtlasTexel& t : two.texels)
        EXPECT_TRUE(at.emplace(t.texel, &t).second);
    const std::uint32_t down = two.layout.instances[1].backRows * two.layout.width;
    for (const AtlasTexel& t : two.texels)
        if (t.instance == 1 && !t.back) {
            const AtlasTexel& below = *at.at(t.texel + down);
            EXPECT_TRUE(below.instance == 1 && below.back == 1 && below.count == t.count);
        }
    const std::uint32_t mesh = scene.instances[1].mesh;
    for (std::uint32_t t = 0; t < two.layout.meshes[mesh].chartOfTriangle.size(); ++t) {
        const Bilinear front = bilinearAt(two.layout,
                                          lightmapUv(two.layout, 1, mesh, t, 0.3f, 0.3f, false)),
                       back = bilinearAt(two.layout,
                                         lightmapUv(two.layout, 1, mesh, t, 0.3f, 0.3f, true));
        for (int k = 0; k < 4; ++k)
            if (front.weight[k] > 1e-3f) {
                EXPECT_EQ(back.texel[k], front.texel[k] + down);
                EXPECT_NEAR(back.weight[k], front.weight[k], 1e-4f);
            }
    }
}

TEST(Atlas, MeetsTheWantedNumberOfTexels) {
    const Scene scene = awkwardScene();
    for (const std::uint32_t wanted : {1000U, 5000U, 20000U}) {
        BakeSettings settings;
        settings.lightmapCaches = wanted;
        const std::size_t got = atlasOf(scene, settings).texels.size();
        EXPECT_LE(got, wanted);
        EXPECT_GE(got, wanted * 8 / 10);
    }
}

TEST(Atlas, TexelsAreOrderedAndEachOnce) {
    BakeSettings settings;
    settings.lightmapCaches = 2000;
    const Atlas atlas = atlasOf(awkwardScene(), settings);
    for (std::size_t i = 1; i < atlas.texels.size(); ++i)
        EXPECT_LT(atlas.texels[i - 1].texel, atlas.texels[i].texel);
}

} // namespace
} // namespace limn::charts_test
