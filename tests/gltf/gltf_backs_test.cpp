// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_backs.h"
#include "engine/scene/mesh/bounds.h"
#include "engine/scene/scene.h"
#include "tests/gltf/gltf_builder.h"

#include <cmath>

#include <gtest/gtest.h>

namespace limn::gltf_backs_test {
namespace {

/// A unit square at height z that faces +z, or -z as its back does.
Mesh square(float z, bool isBack, std::uint32_t material = 0) {
    Mesh m;
    m.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
    m.normals.assign(4, {0, 0, isBack ? -1.f : 1.f});
    m.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    m.indices = isBack ? std::vector<std::uint32_t>{2, 1, 0, 0, 3, 2}
                       : std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3};
    m.material = material;
    return m;
}

Mesh joined(const Mesh& a, const Mesh& b) {
    Mesh m = a;
    const auto first = std::uint32_t(a.positions.size());
    m.positions.insert(m.positions.end(), b.positions.begin(), b.positions.end());
    m.normals.insert(m.normals.end(), b.normals.begin(), b.normals.end());
    m.uv0.insert(m.uv0.end(), b.uv0.begin(), b.uv0.end());
    for (const std::uint32_t i : b.indices)
        m.indices.push_back(first + i);
    return m;
}

struct Join {
    std::vector<std::vector<std::uint32_t>> parts;
    std::vector<Mesh> meshes;
    std::vector<Material> materials = std::vector<Material>(2);

    std::size_t run() { return joinBacks(parts, meshes, materials); }
    std::size_t triangles() const {
        std::size_t sum = 0;
        for (const Mesh& m : meshes)
            sum += m.triangleCount();
        return sum;
    }
};

TEST(GltfBacks, TwoSheetsBackToBackBecomeOneThatIsTwoSided) {
    Join apart{{{0, 1}}, {square(0, false), square(0, true)}};
    EXPECT_EQ(apart.run(), 2U);
    EXPECT_EQ(apart.parts[0], std::vector<std::uint32_t>{0});
    EXPECT_EQ(apart.meshes[0], square(0, false));
    EXPECT_TRUE(apart.meshes[1].indices.empty()); // later ones keep their indices
    EXPECT_TRUE(apart.materials[0].doubleSided);
    EXPECT_EQ(apart.materials.size(), 2U);

    Join together{{{0}}, {joined(square(0, false), square(0, true))}};
    EXPECT_EQ(together.run(), 2U);
    EXPECT_EQ(together.meshes[0], square(0, false));
    EXPECT_TRUE(together.materials[0].doubleSided);
}

TEST(GltfBacks, WhatHasNoBackStaysOneSided) {
    Join mixed{
        {{0}, {1}},
        {joined(joined(square(0, false), square(1, false)), square(0, true)), square(2, false)}};
    mixed.materials[0].name = "Paper";
    EXPECT_EQ(mixed.run(), 2U);
    ASSERT_EQ(mixed.meshes.size(), 3U);
    EXPECT_EQ(mixed.meshes[0], square(1, false));
    EXPECT_EQ(mixed.parts[0], (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(mixed.meshes[2].positions, square(0, false).positions);
    ASSERT_EQ(mixed.materials.size(), 3U);
    EXPECT_EQ(mixed.meshes[2].material, 2U);
    EXPECT_FALSE(mixed.materials[0].doubleSided);
    EXPECT_TRUE(mixed.materials[2].doubleSided);
    EXPECT_EQ(mixed.materials[2].name, "Paper (two-sided)");
}

TEST(GltfBacks, SheetsThatDifferStayApart) {
    const auto changed = [](auto change) {
        Mesh m = square(0, true);
        change(m);
        return m;
    };
    const Mesh others[] = {changed([](Mesh& m) { m.positions[1].x = 1.001f; }),
                           changed([](Mesh& m) {
                               m.normals.assign(4, {0, 0, 1});
                           }),
                           changed([](Mesh& m) { m.uv0[1].x = 0.5f; }),
                           changed([](Mesh& m) { m.uv0.clear(); }),
                           changed([](Mesh& m) {
                               m.colors.assign(4, {1, 0, 0, 1});
                           }),
                           changed([](Mesh& m) { m.material = 1; }),
                           square(0, false)};
    for (const Mesh& other : others) {
        Join join{{{0, 1}}, {square(0, false), other}};
        join.materials[1].roughness = 0.25f;
        const std::size_t pairs = join.run();
        const std::size_t corners = other.positions[1].x == 1 && other.uv0 == square(0, true).uv0;
        EXPECT_LE(pairs, corners == 1 ? 0U : 1U) << &other - others; // one triangle is unchanged
        EXPECT_EQ(join.triangles(), 4 - pairs);
    }
    Join distant{{{0}, {1}}, {square(0, false), square(0, true)}}; // not seen together
    EXPECT_EQ(distant.run(), 0U);
}

/// Thousands of triangles in one place, as a hostile file may have, take no time.
TEST(GltfBacks, StacksOfTrianglesAreLeftAlone) {
    Mesh stack;
    stack.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    stack.normals.assign(3, {0, 0, 1});
    for (int i = 0; i < 100000; ++i)
        stack.indices.insert(stack.indices.end(), {0, 1, 2});
    Join join{{{0}}, {stack}};
    EXPECT_EQ(join.run(), 0U);
}

TEST(GltfBacks, AFileWithSheetsBackToBackIsTwoSided) {
    GltfBuilder b;
    const int corners = b.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
              back = b.vec3({{0, 1, 0}, {1, 0, 0}, {0, 0, 0}});
    b.json["materials"] = {{{"name", "Paper"}}};
    b.json["meshes"] = {{{"primitives",
                          {{{"attributes", {{"POSITION", corners}}}, {"material", 0}},
                           {{"attributes", {{"POSITION", back}}}, {"material", 0}}}}}};
    b.json["nodes"] = {{{"mesh", 0}}};
    b.json["scenes"] = {{{"nodes", {0}}}};
    const ImportedScene scene = imported(b);
    const Scene flat = flatten(scene.document, scene.assets);
    ASSERT_EQ(flat.instances.size(), 1U);
    EXPECT_EQ(flat.meshOf(flat.instances[0]).triangleCount(), 1U);
    EXPECT_TRUE(flat.materialOf(flat.instances[0]).doubleSided);
    EXPECT_TRUE(hasRepair(scene, "1 pairs of triangles back to back"));
}

} // namespace
} // namespace limn::gltf_backs_test
