// SPDX-License-Identifier: MIT
#include "engine/scene/dynamic_spec.h"
#include "engine/scene/scene.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::scene_test {
namespace {

Mesh unitTriangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.indices = {0, 1, 2};
    return mesh;
}

/// Both triangles of the rectangle from `corner` along u and v; its front is cross(u, v).
void addRectangle(Mesh& mesh, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (const glm::vec3 p : {corner, corner + u, corner + u + v, corner + v}) {
        mesh.positions.push_back(p);
        mesh.normals.push_back(glm::normalize(glm::cross(u, v)));
    }
    for (const std::uint32_t i : {0, 1, 2, 0, 2, 3})
        mesh.indices.push_back(first + i);
}

/// Walls, floor and ceiling of a room that face inward, without the side +z where `open`.
Mesh room(glm::vec3 size, bool open) {
    Mesh mesh;
    const glm::vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    addRectangle(mesh, {}, y, z); // -x
    addRectangle(mesh, x, z, y);  // +x
    addRectangle(mesh, {}, z, x); // floor
    addRectangle(mesh, y, x, z);  // ceiling
    addRectangle(mesh, {}, x, y); // -z
    if (!open)
        addRectangle(mesh, z, y, x); // +z
    return mesh;
}

ObjectId addNode(Document& document, ObjectId parent, glm::vec3 translation,
                 std::vector<std::uint32_t> meshes) {
    Node node;
    node.parent = parent;
    node.transform.translation = translation;
    node.meshes = std::move(meshes);
    return addObject(document, node);
}

Scene sceneOf(Mesh mesh) {
    auto assets = std::make_shared<Assets>();
    assets->meshes.push_back(std::move(mesh));
    Document document;
    addNode(document, 0, {}, {0});
    return flatten(document, assets);
}

TEST(Document, MatrixIsTranslationTimesRotationTimesScale) {
    Transform t;
    t.translation = {1, 2, 3};
    t.rotation = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 0, 1)); // x to y
    t.scale = {2, 3, -4};
    const glm::vec3 p(matrix(t) * glm::vec4(1, 1, 1, 1));
    EXPECT_LT(glm::distance(p, {1 - 3, 2 + 2, 3 - 4}), 1e-5f);
}

TEST(Document, IdsAreNeverUsedTwice) {
    Document document;
    const ObjectId a = addObject(document, Light{});
    const ObjectId b = addObject(document, Camera{});
    EXPECT_NE(a, 0u);
    document.objects.erase(b);
    EXPECT_GT(addObject(document, Sky{}), b);
}

TEST(Flatten, TransformsVisibilityAndDynamicComeDownTheTree) {
    auto assets = std::make_shared<Assets>();
    assets->meshes = {unitTriangle()};
    Document document;
    const ObjectId root = addNode(document, 0, {10, 0, 0}, {});
    const ObjectId child = addNode(document, root, {0, 5, 0}, {0});
    addNode(document, 0, {}, {0});
    Scene scene = flatten(document, assets);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].node, child);
    EXPECT_EQ(glm::vec3(scene.instances[0].toWorld[3]), glm::vec3(10, 5, 0));
    EXPECT_EQ(scene.bounds.lower, glm::vec3(0));
    EXPECT_EQ(scene.bounds.upper, glm::vec3(11, 6, 0));

    std::get<Node>(document.objects[root]).dynamic = true;
    EXPECT_TRUE(flatten(document, assets).instances[0].dynamic);
    EXPECT_FALSE(flatten(document, assets).instances[1].dynamic);
    std::get<Node>(document.objects[root]).visible = false;
    scene = flatten(document, assets);
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.bounds.upper, glm::vec3(1, 1, 0));
}

TEST(Flatten, TexelDensitiesMultiplyDownTheTreeWithinTheirLimits) {
    auto assets = std::make_shared<Assets>();
    assets->meshes = {unitTriangle()};
    Document document;
    const ObjectId root = addNode(document, 0, {}, {}), child = addNode(document, root, {}, {0});
    const auto density = [&](float ofRoot, float ofChild) {
        std::get<Node>(document.objects[root]).texelDensity = ofRoot;
        std::get<Node>(document.objects[child]).texelDensity = ofChild;
        return flatten(document, assets).instances[0].texelDensity;
    };
    EXPECT_EQ(density(1, 1), 1);
    EXPECT_EQ(density(2, 3), 6);
    EXPECT_EQ(density(0.5f, 4), 2);
    EXPECT_EQ(density(16, 16), kMaxTexelDensity);
    EXPECT_EQ(density(kMinTexelDensity, 0.25f), kMinTexelDensity);
}

TEST(Flatten, StaticBoundsLeaveDynamicInstancesAndInfinitePlacesOut) {
    auto assets = std::make_shared<Assets>();
    assets->meshes = {unitTriangle()};
    Document document;
    addNode(document, 0, {1, 2, 3}, {0});
    const ObjectId moving = addNode(document, 0, {50, 0, 0}, {0});
    addNode(document, 0, {std::numeric_limits<float>::infinity(), 0, 0}, {0});
    std::get<Node>(document.objects[moving]).dynamic = true;
    const Bounds fixed = staticBounds(flatten(document, assets));
    EXPECT_EQ(fixed.lower, glm::vec3(1, 2, 3));
    EXPECT_EQ(fixed.upper, glm::vec3(2, 3, 3));
}

TEST(DynamicSpec, MarksAndMovesObjectsByName) {
    Document document;
    const ObjectId box = addNode(document, 0, {1, 0, 0}, {}), other = addNode(document, 0, {}, {});
    std::get<Node>(document.objects[box]).name = "Box @ 2";
    std::get<Node>(document.objects[other]).name = "Box";
    ASSERT_TRUE(makeDynamic(document, "Box @ 2@0,-0.5,2e1"));
    const Node& moved = std::get<Node>(document.objects[box]);
    EXPECT_TRUE(moved.dynamic);
    EXPECT_EQ(moved.transform.translation, glm::dvec3(1, -0.5, 20));
    EXPECT_FALSE(std::get<Node>(document.objects[other]).dynamic);
    ASSERT_TRUE(makeDynamic(document, "Box"));
    EXPECT_TRUE(std::get<Node>(document.objects[other]).dynamic);
    const Document before = document;
    for (const char* wrong : {"Ball", "Box@", "Box@1,2", "Box@1,2,3,4", "Box@1,2,nan", "@1,2,3"})
        EXPECT_FALSE(makeDynamic(document, wrong)) << wrong;
    EXPECT_EQ(document, before);
}

TEST(Flatten, AParentMayHaveALaterIdAndAMissingParentIsARoot) {
    auto assets = std::make_shared<Assets>();
    assets->meshes = {unitTriangle()};
    Document document;
    const ObjectId child = addNode(document, 2, {1, 0, 0}, {0});
    addNode(document, 0, {0, 1, 0}, {});
    EXPECT_EQ(glm::vec3(flatten(document, assets).instances[0].toWorld[3]), glm::vec3(1, 1, 0));
    std::get<Node>(document.objects[child]).parent = 99;
    EXPECT_EQ(glm::vec3(flatten(document, assets).instances[0].toWorld[3]), glm::vec3(1, 0, 0));
}

TEST(Flatten, ObjectsKeepTheOrderOfTheirIds) {
    Document document;
    addObject(document, Light{.name = "a"});
    addObject(document, Material{.name = "m"});
    addObject(document, Light{.name = "b", .enabled = false});
    addObject(document, Sky{.radiance = {1, 2, 3}});
    addObject(document, BakeSettings{.surfels = 77});
    const Scene scene = flatten(document, nullptr);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[1].name, "b");
    EXPECT_EQ(scene.materials[0].name, "m");
    EXPECT_EQ(scene.sky.radiance, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.bake.surfels, 77u);
}

TEST(Flatten, AMeshWithoutMaterialAndOneThatIsGoneAreDefined) {
    const Scene plain = sceneOf(unitTriangle());
    ASSERT_EQ(plain.materials.size(), 1u);
    EXPECT_TRUE(plain.materialOf(plain.instances[0]) == Material{});
    Document document;
    addNode(document, 0, {}, {5});
    EXPECT_TRUE(flatten(document, nullptr).instances.empty());
}

/// Whether the 8 corners of the bounds project into the square picture.
bool showsAll(const Camera& camera, const Bounds& bounds) {
    const glm::mat4 clip = projectionMatrix(camera, 1, 0.001f, 1e6f) * viewMatrix(camera);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p{i & 1 ? bounds.upper.x : bounds.lower.x,
                          i & 2 ? bounds.upper.y : bounds.lower.y,
                          i & 4 ? bounds.upper.z : bounds.lower.z};
        const glm::vec4 c = clip * glm::vec4(p, 1);
        if (!(c.w > 0 && std::abs(c.x) <= c.w && std::abs(c.y) <= c.w))
            return false;
    }
    return true;
}

TEST(Flatten, AssignedMaterialsReplaceThoseOfTheMeshes) {
    auto assets = std::make_shared<Assets>();
    assets->meshes.resize(3);
    assets->meshes[0].material = assets->meshes[1].material = assets->meshes[2].material = 1;
    Document document;
    const ObjectId first = addObject(document, Material{.name = "first"});
    addObject(document, Material{.name = "second"});
    const ObjectId node = addObject(document, Node{.meshes = {0, 1, 2}});
    const ObjectId third = addObject(document, Material{.name = "third"});
    std::get<Node>(document.objects.at(node)).materials = {third, 0}; // the last one is missing
    Scene scene = flatten(document, assets);
    EXPECT_EQ(scene.materialOf(scene.instances.at(0)).name, "third");
    EXPECT_EQ(scene.materialOf(scene.instances.at(1)).name, "second");
    EXPECT_EQ(scene.materialOf(scene.instances.at(2)).name, "second");
    std::get<Node>(document.objects.at(node)).materials = {first, node, 1000}; // no materials
    scene = flatten(document, assets);
    EXPECT_EQ(scene.materialOf(scene.instances.at(0)).name, "first");
    EXPECT_EQ(scene.materialOf(scene.instances.at(1)).name, "second");
    EXPECT_EQ(scene.materialOf(scene.instances.at(2)).name, "second");
}

TEST(ChooseCamera, ANameWinsThenTheFirst) {
    Scene scene = sceneOf(unitTriangle());
    scene.cameras = {Camera{.name = "a"}, Camera{.name = "b"}};
    EXPECT_EQ(chooseCamera(scene, "b").name, "b");
    EXPECT_EQ(chooseCamera(scene, {}).name, "a");
    EXPECT_EQ(chooseCamera(scene, "none").name, "a");
}

TEST(ChooseCamera, AnObjectIsSeenWholeFromOutside) {
    Mesh box = room({2, 1, 3}, false);
    for (std::size_t t = 0; t < box.triangleCount(); ++t)
        std::swap(box.indices[3 * t], box.indices[3 * t + 1]); // now it faces outward
    const Scene scene = sceneOf(box);
    EXPECT_TRUE(showsAll(chooseCamera(scene, {}), scene.bounds));
}

TEST(ChooseCamera, AnOpenBoxIsSeenWholeThroughItsOpening) {
    const Scene scene = sceneOf(room({2, 2, 2}, true));
    const Camera camera = chooseCamera(scene, {});
    EXPECT_TRUE(showsAll(camera, scene.bounds));
    EXPECT_GT(camera.eye.z, 2);
    EXPECT_EQ(camera.eye.x, 1);
}

TEST(ChooseCamera, AClosedHallIsSeenFromInsideAlongIt) {
    const Scene scene = sceneOf(room({30, 10, 12}, false));
    const Camera camera = chooseCamera(scene, {});
    EXPECT_TRUE(camera.eye.x > 15 && camera.eye.x < 30 && camera.eye.y > 0 && camera.eye.y < 5);
    EXPECT_EQ(camera.eye.z, 6);
    EXPECT_GT(std::abs(camera.target.x - camera.eye.x), 10);
}

/// Rows of blocks have walls that face inward along every side, but nowhere between them is room.
TEST(ChooseCamera, AWideCourtOfBlocksIsSeenFromAbove) {
    Mesh court;
    for (int i = 0; i < 20; ++i)
        for (int k = 0; k < 20; ++k) {
            const glm::vec3 at(5 * i, 0, 5 * k), x{4, 0, 0}, y{0, 2, 0}, z{0, 0, 4};
            addRectangle(court, at, z, y);     // -x
            addRectangle(court, at + x, y, z); // +x
            addRectangle(court, at, y, x);     // -z
            addRectangle(court, at + z, x, y); // +z
            addRectangle(court, at + y, z, x); // top
        }
    const Scene scene = sceneOf(court);
    const Camera camera = chooseCamera(scene, {});
    EXPECT_TRUE(showsAll(camera, scene.bounds));
    EXPECT_GT(camera.eye.y, 2);
}

TEST(Camera, RaysGoThroughTheirPixels) {
    Camera camera;
    camera.eye = {3, 1, -2};
    camera.target = {0, 0.5f, 4};
    const glm::mat4 clip = projectionMatrix(camera, 1.5f, 0.1f, 100) * viewMatrix(camera);
    for (const glm::vec2 ndc : {glm::vec2(0), glm::vec2(-1, 1), glm::vec2(0.3f, -0.7f)}) {
        const glm::vec3 p = camera.eye + 5.f * rayDirection(camera, 1.5f, ndc.x, ndc.y);
        const glm::vec4 c = clip * glm::vec4(p, 1);
        EXPECT_NEAR(c.x / c.w, ndc.x, 1e-4);
        EXPECT_NEAR(c.y / c.w, ndc.y, 1e-4);
        EXPECT_TRUE(c.z >= 0 && c.z <= c.w);
    }
}

TEST(Camera, UpAlongTheViewStillGivesAView) {
    Camera camera;
    camera.eye = {0, 5, 0};
    camera.target = {};
    const glm::mat4 view = viewMatrix(camera);
    EXPECT_NEAR(glm::determinant(view), 1, 1e-5);
    EXPECT_NEAR((view * glm::vec4(0, 0, 0, 1)).z, -5, 1e-5);
}

} // namespace
} // namespace limn::scene_test
