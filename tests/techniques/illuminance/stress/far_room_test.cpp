// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/lit_scene.h"

#include "tests/gltf/gltf_builder.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace limn::far_room_test {
namespace {

using Json = nlohmann::json;

/// The corners of a box's faces with their normals, facing in or out.
void addBox(GltfBuilder& b, glm::vec3 size, bool inward) {
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint16_t> indices;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {0.f, 1.f}) {
            glm::vec3 u(0), v(0), corner(0), n(0);
            u[(axis + 1) % 3] = size[(axis + 1) % 3];
            v[(axis + 2) % 3] = size[(axis + 2) % 3];
            corner[axis] = side * size[axis];
            n[axis] = (side > 0) == inward ? -1.f : 1.f;
            if (n[axis] < 0)
                std::swap(u, v);
            const auto first = std::uint16_t(positions.size());
            for (const glm::vec3 p : {corner, corner + u, corner + u + v, corner + v}) {
                positions.push_back(p);
                normals.push_back(n);
            }
            for (const int i : {0, 1, 2, 0, 2, 3})
                indices.push_back(std::uint16_t(first + i));
        }
    b.json["meshes"].push_back(
        {{"primitives",
          {{{"attributes", {{"POSITION", b.vec3(positions)}, {"NORMAL", b.vec3(normals)}}},
            {"indices", b.indices(indices)}}}}});
}

/// A room of 5 m with two turned blocks and a lamp, all below one root at `at`.
Scene roomAt(double at) {
    GltfBuilder b;
    addBox(b, glm::vec3(5), true);
    addBox(b, {1.5f, 3, 1.5f}, false);
    addBox(b, glm::vec3(1.4f), false);
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 100}}};
    b.json["nodes"] = {
        {{"children", {1, 2, 3, 4}}, {"translation", {at, 0, -at}}},
        {{"mesh", 0}},
        {{"mesh", 1}, {"translation", {0.9, 0.013, 1}}, {"rotation", {0, 0.28, 0, 0.96}}},
        {{"mesh", 2}, {"translation", {2.7, 0.007, 2.6}}, {"rotation", {0, -0.28, 0, 0.96}}},
        {{"translation", {2.513, 4.517, 2.481}},
         {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    b.json["scenes"] = {{{"nodes", {0}}}};
    const ImportedScene scene = imported(b);
    Scene flat = flatten(scene.document, scene.assets);
    flat.bake.surfels = 400;
    flat.bake.lightmapCaches = 400;
    flat.bake.rays = 128;
    return flat;
}

/// Of two lists of as many: the sum of what differs as a share of the first list's.
template <class V>
double difference(const std::vector<V>& a, const std::vector<V>& b) {
    if (a.size() != b.size())
        return 1;
    double differs = 0, all = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        differs += double(glm::distance(glm::vec3(a[i]), glm::vec3(b[i])));
        all += double(glm::length(glm::vec3(a[i])));
    }
    return differs / all;
}

double sumOf(const RelitState& light) {
    double sum = 0;
    for (const glm::vec4& b : light.radiosity)
        sum += double(b.x) + double(b.y) + double(b.z);
    return sum;
}

// The origins are multiples of the 16 m that the room's diagonal is rounded to, so that nothing but
// the rounding of doubles to floats is left between the scenes: it makes some rays of the caches
// meet another surfel, so that now and then one surfel is given another place of its patch. One of
// 400 surfels has about a 400th of the light.
TEST(FarRoom, IsLitAsItIsNearby) {
    constexpr double kOneSurfel = 1.0 / 400;
    const Result<LitScene> near = bakeAndLight(roomAt(0), {});
    ASSERT_TRUE(near);
    ASSERT_GT(sumOf(near->light), 0);
    for (const double at : {1e6, 1e7, 1e9}) {
        const Result<LitScene> far = bakeAndLight(roomAt(at), {});
        ASSERT_TRUE(far) << at;
        ASSERT_EQ(far->scene.instances.size(), 3U);
        EXPECT_LE(difference(near->light.radiosity, far->light.radiosity), kOneSurfel) << at;
        EXPECT_LE(difference(near->light.sh, far->light.sh), kOneSurfel) << at;
        EXPECT_LE(difference(near->light.field.lightmap, far->light.field.lightmap), kOneSurfel)
            << at;
    }
}

// Elsewhere surfels and rays fall otherwise.
TEST(FarRoom, IsLitAsBrightlyAtAnyPlace) {
    const double near = sumOf(bakeAndLight(roomAt(0), {})->light);
    for (const double at : {1e6 + 3.3, -7654321.1})
        EXPECT_NEAR(sumOf(bakeAndLight(roomAt(at), {})->light) / near, 1, 0.01) << at;
}

} // namespace
} // namespace limn::far_room_test
