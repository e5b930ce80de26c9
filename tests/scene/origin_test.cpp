// SPDX-License-Identifier: MIT
#include "engine/scene/origin.h"

#include "engine/scene/light/light_spec.h"

#include "tests/gltf/gltf_builder.h"

#include <glm/geometric.hpp>

namespace limn::origin_test {
namespace {

using Json = nlohmann::json;

/// A rotated triangle of 1 m, a point light and a camera within 3 m of `at`, all children of one
/// node. `root`: that node's translation is `at`; else those of its children are.
GltfBuilder placedScene(const glm::dvec3& at, bool root) {
    GltfBuilder b = triangleScene();
    const auto place = [&](glm::dvec3 p) {
        p += root ? glm::dvec3(0) : at;
        return Json{p.x, p.y, p.z};
    };
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    b.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    b.json["nodes"] = {
        {{"mesh", 0}, {"translation", place({0.1, 0.2, 0.3})}, {"rotation", {0, 0.6, 0, 0.8}}},
        {{"translation", place({0.7, 0.01, -0.03})},
         {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        {{"camera", 0}, {"translation", place({0.1, 0.4, 2.3})}},
        {{"children", {0, 1, 2}}}};
    if (root)
        b.json["nodes"][3]["translation"] = {at.x, at.y, at.z};
    b.json["scenes"] = {{{"nodes", {3}}}};
    return b;
}

Scene flattened(const ImportedScene& scene) {
    return flatten(scene.document, scene.assets);
}

TEST(Origin, AScenesPartsLieFarAwayAsTheyDoNearby) {
    const Scene near = flattened(imported(placedScene(glm::dvec3(0), true)));
    EXPECT_EQ(near.origin, glm::dvec3(0));
    for (const double away : {1e3, 1e6, 1e7, 1e9})
        for (const bool root : {true, false}) {
            const glm::dvec3 at(away, -away, 0.5 * away);
            const ImportedScene moved = imported(placedScene(at, root));
            const Scene far = flattened(moved);
            EXPECT_LE(glm::distance(far.origin, at), 4) << away;
            const double tolerance = 2e-6 + 1e-15 * away; // of floats, and of doubles there
            const auto difference = [&](glm::vec3 a, glm::vec3 b) {
                return glm::distance(toFile(far.origin, a) - at, glm::dvec3(b));
            };
            ASSERT_EQ(far.instances.size(), 1U);
            const glm::mat4 &a = far.instances[0].toWorld, &b = near.instances[0].toWorld;
            EXPECT_LE(difference(a[3], b[3]), tolerance) << away << root;
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(glm::distance(a[c], b[c]), 1e-6f);
            EXPECT_LE(difference(far.bounds.upper, near.bounds.upper), tolerance);
            EXPECT_LE(difference(far.lights.at(0).position, near.lights.at(0).position), tolerance);
            EXPECT_LE(difference(far.cameras.at(0).eye, near.cameras.at(0).eye), tolerance);
            EXPECT_LE(glm::distance(far.cameras[0].target - far.cameras[0].eye,
                                    near.cameras[0].target - near.cameras[0].eye),
                      1e-6f);
        }
}

TEST(Origin, StaysWhereItIsWhenSomethingIsEdited) {
    ImportedScene scene = imported(placedScene({1e6, 0, 0}, true));
    const glm::dvec3 before = flattened(scene).origin;
    for (auto& [id, object] : scene.document.objects)
        if (Node* node = std::get_if<Node>(&object))
            node->transform.translation.y += 100;
    EXPECT_EQ(flattened(scene).origin, before);
}

/// A document with one mesh of `size` whose lower corner is at `at`.
struct OneMesh {
    Document document;
    std::vector<Mesh> meshes{1};
    ObjectId id;

    OneMesh(glm::dvec3 at, float size) {
        meshes[0].positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        Node node;
        node.transform.translation = at;
        node.meshes = {0};
        id = addObject(document, node);
    }
    glm::dvec3 origin() const { return originOf(document, meshes); }
};

TEST(Origin, IsARoundPlaceNearWhatIsFarAndElseZero) {
    // The diagonal of 14.1 m makes steps of 16 m.
    EXPECT_EQ(OneMesh({1e6 + 3, -4e5, 7}, 10).origin(), glm::dvec3(1e6 + 16, -4e5, 0));
    EXPECT_EQ(OneMesh({220, 0, 0}, 10).origin(), glm::dvec3(0));
    EXPECT_EQ(OneMesh({230, 0, 0}, 10).origin(), glm::dvec3(240, 0, 0));
    EXPECT_EQ(OneMesh({2e12, 0, 0}, 10).origin(), glm::dvec3(0)) << "is refused";
    EXPECT_EQ(originOf(Document{}, {}), glm::dvec3(0));
    EXPECT_EQ(OneMesh({1e6, 0, 0}, 0).origin(), glm::dvec3(0)) << "has no size";
}

TEST(Origin, IsThatOfWhatIsSeenAndStatic) {
    OneMesh scene({1e6, 0, 0}, 10);
    Node other;
    other.meshes = {0, 7}; // the latter is not there
    const ObjectId id = addObject(scene.document, other);
    EXPECT_EQ(scene.origin(), glm::dvec3(0)) << "the scene is as large as it is far";
    std::get<Node>(scene.document.objects[id]).visible = false;
    EXPECT_NE(scene.origin(), glm::dvec3(0));
    std::get<Node>(scene.document.objects[id]).visible = true;
    std::get<Node>(scene.document.objects[id]).dynamic = true;
    EXPECT_NE(scene.origin(), glm::dvec3(0));
}

// Vertices that far are floats in the file, and 6 cm apart; that much cannot be mended.
TEST(Origin, IsThatOfVerticesToo) {
    GltfBuilder b;
    b.mesh(
        {{"attributes", {{"POSITION", b.vec3({{1e6f, 0, 0}, {1e6f + 1, 0, 0}, {1e6f, 1, 0}})}}}});
    const Scene scene = flattened(imported(b));
    EXPECT_EQ(scene.origin, glm::dvec3(1e6, 0, 0));
    EXPECT_EQ(scene.bounds.upper, glm::vec3(1, 1, 0));
}

TEST(Origin, ASkinnedMeshIsPlacedAboutIt) {
    GltfBuilder b = placedScene({1e6, 0, 0}, true);
    b.json["skins"] = {{{"joints", {1}}}};
    b.json["nodes"][0]["skin"] = 0;
    const Scene scene = flattened(imported(b));
    ASSERT_EQ(scene.instances.size(), 1U);
    const glm::dvec3 at = toFile(scene.origin, glm::vec3(scene.instances[0].toWorld[3]));
    EXPECT_LE(glm::distance(at, glm::dvec3(1e6 + 0.7, 0.01, -0.03)), 1e-6);
}

TEST(Origin, ALightIsGivenInTheFilesCoordinates) {
    const glm::dvec3 origin(1e6, 0, -64);
    const Result<Light> lamp = parseLight("point pos=1000000.3,0.1,-63.5 cd=1", origin);
    ASSERT_TRUE(lamp);
    EXPECT_LE(glm::distance(lamp->position, glm::vec3(0.3f, 0.1f, 0.5f)), 1e-6f);
    EXPECT_EQ(parseLight("point cd=1", origin)->position, glm::vec3(-1e6f, 0, 64));
}

} // namespace
} // namespace limn::origin_test
