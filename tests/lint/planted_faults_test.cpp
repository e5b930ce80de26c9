// SPDX-License-Identifier: MIT
// Rooms with one fault each: it is found, and nothing else.
#include "tests/lint/lint_room.h"

#include <atomic>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::lint_test {
namespace {

std::string textOf(const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& f : findings)
        text += std::string(f.rule->name) + " " + f.path + ": " + f.problem + "\n";
    return text;
}

/// Expects one finding, of that rule about that object.
void expectOnly(const LintRoom& room, std::string_view rule, ObjectId object) {
    const std::vector<Finding> findings = room.lint();
    ASSERT_EQ(findings.size(), 1U) << textOf(findings);
    EXPECT_EQ(findings[0].rule->name, rule) << textOf(findings);
    EXPECT_EQ(findings[0].object, object) << textOf(findings);
    EXPECT_TRUE(findings[0].problem.ends_with('.')) << findings[0].problem;
    EXPECT_TRUE(findings[0].advice.ends_with('.')) << findings[0].advice;
}

TEST(PlantedFaults, NoneAreFoundInACleanRoom) {
    EXPECT_EQ(textOf(CleanRoom().lint()), "");
}

TEST(PlantedFaults, BlackAlbedo) {
    CleanRoom room;
    room.material(2).baseColor = {0.004f, 0.004f, 0.004f, 1};
    expectOnly(room, "black-albedo", room.table);
    room.material(2).baseColor = {0.01f, 0.01f, 0.01f, 1}; // velvet
    EXPECT_EQ(textOf(room.lint()), "");
}

TEST(PlantedFaults, BrightAlbedo) {
    CleanRoom room;
    room.material(2).baseColor = {1, 1, 1, 1};
    expectOnly(room, "bright-albedo", room.table);
}

TEST(PlantedFaults, BlackMetalIsBlackAndGoldIsNot) {
    CleanRoom room;
    room.material(2).metallic = 1;
    room.material(2).baseColor = {1, 0.8f, 0.3f, 1};
    EXPECT_EQ(textOf(room.lint()), "");
    room.material(2).baseColor = {0, 0, 0, 1};
    expectOnly(room, "black-albedo", room.table);
}

TEST(PlantedFaults, MissingUv) {
    CleanRoom room;
    room.meshOf(room.crate).uv0.clear();
    expectOnly(room, "missing-uv", room.crate);
}

TEST(PlantedFaults, DegenerateUv) {
    CleanRoom room;
    std::vector<glm::vec2>& uv = room.meshOf(room.crate).uv0;
    for (glm::vec2& p : uv)
        p = {0, 1};
    expectOnly(room, "degenerate-uv", room.crate);
    for (glm::vec2& p : uv) // a colour of a palette
        p = {0.25f, 0.5f};
    EXPECT_EQ(textOf(room.lint()), "");
}

TEST(PlantedFaults, OverlappingLightmapUv) {
    CleanRoom room;
    Mesh& crate = room.meshOf(room.crate);
    crate.uv1.assign(crate.positions.size(), glm::vec2(0)); // each face covers the same square
    for (std::size_t t = 0; t < crate.triangleCount(); ++t) {
        const auto [a, b, c] = crate.triangle(t);
        crate.uv1[a] = {0, 0};
        crate.uv1[b] = {1, 0};
        crate.uv1[c] = {1, 1};
    }
    expectOnly(room, "lightmap-uv", room.crate);
    room.material(1).baseColorTexture.texCoord = 1; // textures may overlap
    EXPECT_EQ(textOf(room.lint()), "");
}

TEST(PlantedFaults, ThinWall) {
    for (const double thickness : {0., 0.004, 0.03}) {
        CleanRoom room;
        const bool sheet = thickness == 0; // of one face, which is two-sided
        const ObjectId wall = room.add(
            "Partition",
            boxMesh({1.5, 0, -2}, {1.5 + thickness, 3, 1}, sheet ? PositiveX : AllFaces), 2);
        room.material(2).doubleSided = sheet;
        const std::vector<Finding> findings = room.lint();
        ASSERT_EQ(findings.size(), 1U) << thickness << "\n" << textOf(findings);
        EXPECT_EQ(findings[0].rule->name, "thin-wall") << textOf(findings);
        EXPECT_EQ(findings[0].object, wall);
        EXPECT_EQ(findings[0].severity, thickness > 0.02 ? Severity::Note : Severity::Warning);
        ASSERT_TRUE(findings[0].place);
        EXPECT_NEAR(findings[0].place->x, 1.5 + thickness / 2, thickness / 2 + 1e-3);
    }
}

TEST(PlantedFaults, BackFaces) {
    CleanRoom room;
    Mesh& crate = room.meshOf(room.crate);
    for (std::size_t i = 0; i < crate.indices.size(); i += 3)
        std::swap(crate.indices[i + 1], crate.indices[i + 2]);
    for (glm::vec3& n : crate.normals)
        n = -n;
    expectOnly(room, "back-faces", room.crate);
}

TEST(PlantedFaults, ASunOfOneLuxUnderABrightSky) {
    CleanRoom room;
    room.add("Terrace", boxMesh({-20, -0.5, 4}, {20, 0, 20}), 2);
    Sky sky;
    sky.radiance = glm::vec3(3000);
    addObject(room.document, sky);
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = glm::normalize(glm::vec3(0.2f, -1, 0.1f));
    sun.strength = 1;
    const ObjectId id = addObject(room.document, sun);
    expectOnly(room, "dim-light", id);
    room.light(id).strength = 50000;
    EXPECT_EQ(textOf(room.lint()), "");
}

TEST(PlantedFaults, ALampOfAMillionCandela) {
    CleanRoom room;
    room.light(room.lamp).strength = 1e6f;
    expectOnly(room, "strong-light", room.lamp);
}

TEST(PlantedFaults, ALampThatNoSurfaceSees) {
    CleanRoom room;
    const ObjectId id = room.addLamp("Buried", {-2.5f, 0.5f, -0.5f}); // in the crate
    expectOnly(room, "unseen-light", id);
}

TEST(PlantedFaults, ALampOfNoStrength) {
    CleanRoom room;
    const ObjectId id = room.addLamp("Off", {1, 2, 1});
    room.light(id).strength = 0;
    expectOnly(room, "zero-light", id);
    room.light(id).enabled = false;
    EXPECT_EQ(textOf(room.lint()), "");
}

TEST(PlantedFaults, NoLight) {
    CleanRoom room;
    std::erase_if(room.document.objects,
                  [](const auto& entry) { return std::holds_alternative<Light>(entry.second); });
    expectOnly(room, "dark-scene", 0);
}

TEST(PlantedFaults, TinyMesh) {
    CleanRoom room;
    Transform transform;
    transform.translation = {2, 1.2, 0};
    transform.scale = glm::vec3(1e-6f);
    const ObjectId id = room.add("Speck", boxMesh({0, 0, 0}, {1, 1, 1}), 2, transform);
    expectOnly(room, "tiny-mesh", id);
}

TEST(PlantedFaults, SceneOfAThousandKilometres) {
    CleanRoom room;
    room.add("Ground", boxMesh({-5e5, -2, -5e5}, {5e5, -1, 5e5}), 2);
    expectOnly(room, "scene-size", 0);
}

TEST(PlantedFaults, FlattenedObject) {
    CleanRoom room;
    Transform transform;
    transform.scale = {1, 0, 0};
    const ObjectId id = room.add("Flat", boxMesh({2, 1, 0}, {3, 2, 1}), 2, transform);
    expectOnly(room, "degenerate-triangles", id);
}

TEST(PlantedFaults, Needles) {
    CleanRoom room;
    Mesh& table = room.meshOf(room.table);
    const auto first = std::uint32_t(table.positions.size());
    for (const glm::vec3 p : {glm::vec3(2, 1, 0), glm::vec3(3, 1, 0), glm::vec3(2.5f, 1, 1e-8f)}) {
        table.positions.push_back(p);
        table.normals.push_back({0, 1, 0});
        table.uv0.resize(table.uv0.empty() ? 0 : table.positions.size());
    }
    table.indices.insert(table.indices.end(), {first, first + 2, first + 1});
    expectOnly(room, "degenerate-triangles", room.table);
}

TEST(PlantedFaults, NumbersThatAreNotFinite) {
    CleanRoom room;
    room.repairs = {"3 triangles with positions not finite removed"};
    expectOnly(room, "non-finite-values", 0);
}

TEST(PlantedFaults, EmptySceneHasNoneButItsDarkness) {
    expectOnly(LintRoom(), "dark-scene", 0);
}

TEST(PlantedFaults, FindsNothingMoreWhenCancelled) {
    const CleanRoom room;
    const Scene scene = flatten(room.document, room.assets);
    const TraceScene trace(scene);
    const std::atomic<bool> cancel = true;
    Progress progress;
    progress.cancel = &cancel;
    EXPECT_FALSE(lintScene({room.document, scene, trace, room.repairs}, progress));
}

} // namespace
} // namespace limn::lint_test
