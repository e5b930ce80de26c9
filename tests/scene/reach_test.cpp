// SPDX-License-Identifier: MIT
#include "engine/scene/reach.h"

#include "tests/gltf/gltf_builder.h"

#include <limits>

namespace limn::reach_test {
namespace {

using Json = nlohmann::json;

/// Of a triangle whose node, and that of a parent, have these transforms.
std::string problem(const Json& node, const Json& parent) {
    const TemporaryFolder folder;
    GltfBuilder b = triangleScene();
    b.json["nodes"] = Json::array({node, parent});
    b.json["nodes"][0]["mesh"] = 0;
    b.json["nodes"][1]["children"] = {0};
    b.json["scenes"] = {{{"nodes", {1}}}};
    writeFile(folder.file("s.glb"), b.glb());
    const Result<ImportedScene> scene = importGltf(folder.file("s.glb"));
    return scene ? "" : scene.error().message;
}

TEST(Reach, PlacedMeshesMustLieWithinIt) {
    EXPECT_EQ(problem({{"translation", {1e11, 0, 0}}}, {{"scale", {2, 2, 2}}}), "");
    for (const auto& [node, parent] :
         {std::pair<Json, Json>{{{"translation", {1e13, 0, 0}}}, Json::object()},
          {{{"translation", {1e11, 0, 0}}}, {{"scale", {1e3, 1, 1}}}},
          {{{"scale", {1e30, 1, 1}}}, {{"scale", {1e30, 1, 1}}}},
          {{{"scale", {1, 1e13, 1}}}, Json::object()}})
        EXPECT_NE(problem(node, parent).find("beyond 1e+12 m of the origin"), std::string::npos)
            << problem(node, parent);
}

TEST(Reach, LightsAndCamerasMustLieWithinIt) {
    Scene scene;
    EXPECT_EQ(reachDefect(scene), "");
    Light light;
    light.name = "far";
    light.position.y = 2e12f;
    light.kind = LightKind::Directional;
    scene.lights = {light};
    EXPECT_EQ(reachDefect(scene), "") << "a sun lies nowhere";
    scene.lights[0].kind = LightKind::Spot;
    EXPECT_EQ(reachDefect(scene), "the light 'far' lies beyond 1e+12 m of the origin");
    scene.lights.clear();
    scene.cameras = {{.name = "c", .target = {0, 0, std::numeric_limits<float>::quiet_NaN()}}};
    EXPECT_NE(reachDefect(scene).find("the camera 'c'"), std::string::npos);
}

// The eye and a point one metre ahead are the same there.
TEST(Reach, ACameraFarAwayLooksWhereItLooks) {
    GltfBuilder b = triangleScene();
    b.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    b.json["nodes"].push_back({{"camera", 0}, {"translation", {4e7, 0, 0}}});
    b.json["scenes"] = {{{"nodes", {0, 1}}}};
    const ImportedScene imported = limn::imported(b);
    const Scene scene = flatten(imported.document, imported.assets);
    ASSERT_EQ(scene.cameras.size(), 1U);
    const Camera& camera = scene.cameras[0];
    EXPECT_LT(camera.target.z, camera.eye.z);
    const glm::vec3 ahead = rayDirection(camera, 1, 0, 0);
    EXPECT_NEAR(ahead.x, 0, 1e-6f);
    EXPECT_NEAR(ahead.z, -1, 1e-6f);
}

} // namespace
} // namespace limn::reach_test
