// SPDX-License-Identifier: MIT
// Animations at a time, and skins in the pose of their joints.
#include "engine/gltf/gltf_import.h"
#include "tests/core/source_path.h"
#include "tests/gltf/packed_scenes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat4x4.hpp>

namespace limn::gltf_pose_test {
namespace {

Result<ImportedScene> importAt(const GltfBuilder& b, std::optional<double> seconds) {
    const TemporaryFolder folder;
    writeFile(folder.file("scene.glb"), b.glb());
    ImportOptions options;
    options.seconds = seconds;
    return importGltf(folder.file("scene.glb"), {}, options);
}

glm::vec3 placeOf(const Result<ImportedScene>& scene, glm::vec3 point) {
    EXPECT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    return glm::vec3(flat.instances.at(0).toWorld * glm::vec4(point, 1));
}

void expectNear(glm::vec3 value, glm::vec3 expected) {
    EXPECT_LT(glm::distance(value, expected), 1e-5f) << value.x << ' ' << value.y << ' ' << value.z;
}

TEST(GltfPose, NodesMoveWithTime) {
    GltfBuilder b = triangleScene();
    const int times = scalars(b, {1, 2, 4});
    animate(b, {{"node", 0}, {"path", "translation"}}, times,
            b.vec3({{0, 0, 0}, {2, 0, 0}, {2, 4, 0}}));
    expectNear(placeOf(importAt(b, {}), {0, 0, 0}), {0, 0, 0});
    expectNear(placeOf(importAt(b, 0.), {0, 0, 0}), {0, 0, 0});
    expectNear(placeOf(importAt(b, 1.5), {0, 0, 0}), {1, 0, 0});
    expectNear(placeOf(importAt(b, 3.), {0, 0, 0}), {2, 2, 0});
    expectNear(placeOf(importAt(b, 9.), {0, 0, 0}), {2, 4, 0});
    b.json["animations"][0]["samplers"][0]["interpolation"] = "STEP";
    expectNear(placeOf(importAt(b, 1.9), {0, 0, 0}), {0, 0, 0});
    expectNear(placeOf(importAt(b, 2.), {0, 0, 0}), {2, 0, 0});
    const Result<ImportedScene> still = importAt(b, {});
    EXPECT_TRUE(std::ranges::any_of(still->repairs, [](const std::string& line) {
        return line.find("--time") != std::string::npos;
    }));
}

/// Hermite's spline through two keys: with tangents of its slope it is straight, and with others it
/// is x(t) = 3 t^2 - 2 t^3 + t (1 - t)^2 v.
TEST(GltfPose, CubicSplinesFollowTheirTangents) {
    GltfBuilder b = triangleScene();
    const int times = scalars(b, {0, 2});
    animate(b, {{"node", 0}, {"path", "translation"}}, times,
            b.vec3({{0, 0, 0}, {0, 0, 0}, {0.5f, 3, 0}, {0.5f, 0, 0}, {1, 1, 0}, {0, 0, 0}}),
            "CUBICSPLINE");
    for (const float t : {0.25f, 0.5f, 0.8f}) {
        const glm::vec3 p = placeOf(importAt(b, double(2 * t)), {0, 0, 0});
        const float smooth = 3 * t * t - 2 * t * t * t;
        expectNear(p, {t, smooth + 2 * t * (1 - t) * (1 - t) * 3, 0});
    }
}

TEST(GltfPose, RotationsTakeTheShorterWayAtEvenSpeed) {
    GltfBuilder b = triangleScene();
    const float h = std::sqrt(0.5f);
    const std::vector<glm::vec4> turns{{0, 0, 0, 1}, {0, 0, -h, -h}}; // 90 degrees about z
    const int output = b.accessor(b.view(turns), "VEC4", GltfBuilder::kFloat, 2);
    const int times = scalars(b, {0, 3});
    animate(b, {{"node", 0}, {"path", "rotation"}}, times, output);
    const float angle = glm::pi<float>() / 6;
    expectNear(placeOf(importAt(b, 1.), {1, 0, 0}), {std::cos(angle), std::sin(angle), 0});
}

TEST(GltfPose, LightsAndMorphWeightsChangeWithTime) {
    GltfBuilder b = triangleScene();
    b.json["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", b.vec3({{0, 0, 2}, {0, 0, 2}, {0, 0, 2}})}}};
    b.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    b.json["scenes"][0]["nodes"].push_back(1);
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 1}}};
    const int times = scalars(b, {0, 1});
    animate(b, {{"node", 0}, {"path", "weights"}}, times, scalars(b, {0, 1}));
    const auto pointer = [](const char* path) {
        return nlohmann::json{{"path", "pointer"},
                              {"extensions", {{"KHR_animation_pointer", {{"pointer", path}}}}}};
    };
    animate(b, pointer("/extensions/KHR_lights_punctual/lights/0/intensity"), times,
            scalars(b, {2, 6}));
    animate(b, pointer("/extensions/KHR_lights_punctual/lights/0/color"), times,
            b.vec3({{1, 0, 0}, {0, 0, 1}}));
    animate(b, pointer("/materials/0/alphaCutoff"), times, scalars(b, {0, 1}));
    const Result<ImportedScene> scene = importAt(b, 0.25);
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    expectNear(scene->assets->meshes.at(0).positions.at(1), {1, 0, 0.5f});
    ASSERT_EQ(flat.lights.size(), 1U);
    EXPECT_FLOAT_EQ(flat.lights[0].strength, 3);
    expectNear(flat.lights[0].color, {0.75f, 0, 0.25f});
    EXPECT_TRUE(std::ranges::any_of(scene->repairs, [](const std::string& line) {
        return line == "1 animated properties that stay as they are";
    }));
}

/// Posing the document that was read at rest is reading it at that time.
TEST(GltfPose, AnAnimationPosesADocumentAsImportingAtATimeDoes) {
    GltfBuilder b = triangleScene();
    const auto lamp = [](int index) {
        return nlohmann::json{{"KHR_lights_punctual", {{"light", index}}}};
    };
    b.json["nodes"].push_back({{"translation", {1, 2, 3}}, {"extensions", lamp(0)}});
    b.json["nodes"].push_back(
        {{"rotation", {0, 0, 0.6, 0.8}}, {"children", {0, 1}}, {"camera", 0}});
    b.json["nodes"].push_back({{"translation", {4, 0, 0}}, {"extensions", lamp(0)}});
    b.json["nodes"].push_back({{"translation", {9, 9, 9}}}); // nothing is seen of it
    b.json["scenes"][0]["nodes"] = {2, 3, 4};
    b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 7}, {"spot", nlohmann::json::object()}}};
    const int times = scalars(b, {0, 2, 3});
    const float h = std::sqrt(0.5f);
    const std::vector<glm::vec4> turns{{0, 0, 0, 1}, {h, 0, 0, h}, {0, h, 0, h}};
    animate(b, {{"node", 2}, {"path", "rotation"}}, times,
            b.accessor(b.view(turns), "VEC4", GltfBuilder::kFloat, 3));
    animate(b, {{"node", 2}, {"path", "translation"}}, times,
            b.vec3({{0, 0, 0}, {5, 0, 0}, {0, 0, 1}}));
    animate(b, {{"node", 0}, {"path", "scale"}}, times, b.vec3({{1, 1, 1}, {3, 1, 2}, {1, 1, 1}}));
    animate(b, {{"node", 4}, {"path", "translation"}}, times,
            b.vec3({{1, 1, 1}, {3, 1, 2}, {1, 1, 1}}));
    animate(b,
            {{"path", "pointer"},
             {"extensions",
              {{"KHR_animation_pointer",
                {{"pointer", "/extensions/KHR_lights_punctual/lights/0/intensity"}}}}}},
            times, scalars(b, {2, 6, 1}));
    const Result<ImportedScene> rest = importAt(b, {});
    ASSERT_TRUE(rest) << rest.error().message;
    ASSERT_TRUE(rest->animation);
    EXPECT_EQ(rest->animation->duration(), 3);
    EXPECT_EQ(rest->animation->tracks.size(), 5U); // two lamps have one intensity
    for (const double seconds : {0.1, 1.0, 2.5, 3.0, 8.0}) {
        const Result<ImportedScene> there = importAt(b, seconds);
        ASSERT_TRUE(there) << there.error().message;
        const Scene expected = flatten(there->document, there->assets),
                    scene = flatten(posedDocument(rest->document, *rest->animation, seconds),
                                    rest->assets);
        ASSERT_EQ(scene.instances.size(), expected.instances.size());
        for (const glm::vec3 p : {glm::vec3(0), glm::vec3(1, 2, 3)})
            expectNear(glm::vec3(scene.instances[0].toWorld * glm::vec4(p, 1)),
                       glm::vec3(expected.instances[0].toWorld * glm::vec4(p, 1)));
        ASSERT_EQ(scene.lights.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            expectNear(scene.lights[i].position, expected.lights[i].position);
            expectNear(scene.lights[i].direction, expected.lights[i].direction);
            EXPECT_EQ(scene.lights[i].strength, expected.lights[i].strength);
        }
        expectNear(scene.cameras.at(0).eye, expected.cameras.at(0).eye);
        expectNear(scene.cameras[0].target, expected.cameras[0].target);
        expectNear(scene.cameras[0].up, expected.cameras[0].up);
    }
    Document moving = rest->document;
    makeMovingDynamic(moving, *rest->animation);
    EXPECT_TRUE(flatten(moving, rest->assets).instances.at(0).dynamic);
    EXPECT_FALSE(flatten(rest->document, rest->assets).instances.at(0).dynamic);
    EXPECT_FALSE(importAt(triangleScene(), {})->animation);
}

TEST(GltfPose, AMalformedAnimationLeavesTheSceneAtRest) {
    GltfBuilder b = triangleScene();
    animate(b, {{"node", 0}, {"path", "translation"}}, scalars(b, {3, 1, 2}),
            b.vec3({{0, 0, 0}, {5, 0, 0}, {0, 0, 1}}));
    const Result<ImportedScene> scene = importAt(b, {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_FALSE(scene->animation);
    EXPECT_TRUE(std::ranges::any_of(scene->repairs, [](const std::string& line) {
        return line.find("animations[0].channels[0].sampler: input") != std::string::npos;
    }));
}

TEST(GltfPose, JointsMoveTheVerticesOfASkin) {
    const Result<ImportedScene> scene = importAt(bentStrip(), {});
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    ASSERT_EQ(flat.instances.size(), 1U);
    const Mesh& mesh = flat.meshOf(flat.instances[0]);
    const auto corner = [&](std::size_t k) {
        return glm::vec3(flat.instances[0].toWorld * glm::vec4(mesh.positions[k], 1));
    };
    expectNear(corner(1), {5, 0, 1});
    expectNear(corner(3), {6, 0, 1});
    expectNear(corner(4), {6, 1, 0});
    expectNear(corner(5), {6, 1, 1});
    expectNear(mesh.normals[5], {-1, 0, 0});
    expectNear(mesh.normals[3], glm::normalize(glm::vec3(-1, 1, 0)));
}

TEST(GltfPose, DamagedSkinsAndAnimationsAreRefusedByName) {
    const auto problem = [](const auto& change) {
        GltfBuilder b = bentStrip();
        const int times = scalars(b, {0, 1});
        animate(b, {{"node", 2}, {"path", "translation"}}, times, b.vec3({{1, 0, 0}, {1, 1, 0}}));
        change(b);
        const Result<ImportedScene> scene = importAt(b, 0.5);
        return scene ? std::string("read") : scene.error().message;
    };
    const auto expect = [&](const char* words, const auto& change) {
        const std::string message = problem(change);
        EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    expect("read", [](GltfBuilder&) {});
    expect("skins[0].inverseBindMatrices",
           [](GltfBuilder& b) { b.json["skins"][0]["inverseBindMatrices"] = 0; });
    expect("JOINTS_0: element", [](GltfBuilder& b) { b.json["skins"][0]["joints"] = {1}; });
    expect("animations[0].channels[0].sampler",
           [](GltfBuilder& b) { b.json["animations"][0]["channels"][0]["sampler"] = 7; });
    expect("animations[0].channels[0].sampler: its values have 1", [](GltfBuilder& b) {
        b.json["animations"][0]["samplers"][0]["output"] =
            b.json["animations"][0]["samplers"][0]["input"];
    });
    expect("animations[0].channels[0].sampler: input",
           [](GltfBuilder& b) { b.json["animations"][0]["samplers"][0]["input"] = 99; });
    expect("ancestor", [](GltfBuilder& b) {
        b.json["nodes"][2]["children"] = {1};
        b.json["scenes"][0]["nodes"] = {0};
    });
}

/// The fox stands still at rest and runs in its first animation.
TEST(GltfPose, AFoxMoves) {
    const std::filesystem::path folder = sourcePath("../shared/scenes/objects/Fox");
    std::filesystem::path file;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
                file = entry.path();
    if (file.empty())
        GTEST_SKIP() << "the scenes in ../shared/scenes are absent";
    const auto boundsAt = [&](std::optional<double> seconds) {
        ImportOptions options;
        options.seconds = seconds;
        const Result<ImportedScene> scene = importGltf(file.string(), {}, options);
        EXPECT_TRUE(scene) << scene.error().message;
        return flatten(scene->document, scene->assets).bounds;
    };
    const Bounds rest = boundsAt({}), early = boundsAt(0.3), late = boundsAt(1.4);
    const float size = glm::length(rest.size());
    EXPECT_GT(glm::distance(early.lower, late.lower), 1e-3f * size);
    EXPECT_LT(glm::distance(early.size(), rest.size()), 0.3f * size); // it is still a fox
}

} // namespace
} // namespace limn::gltf_pose_test
