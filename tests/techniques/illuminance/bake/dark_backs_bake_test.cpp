// SPDX-License-Identifier: MIT
// Where nothing lights or sees the backs of a surface, its bake is that of a one-sided surface.
#include "engine/field/sample_field.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/techniques/illuminance/bake/staged_room.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::dark_backs_test {
namespace {

/// The room with blocks that have two sides or one, seen by a camera in the air.
Scene roomOf(bool twoSided) {
    Scene scene = stagedRoom({});
    scene.cameras.push_back({.eye = glm::vec3(1, 3, 1)});
    scene.materials.push_back(scene.materials[0]);
    scene.materials.back().doubleSided = twoSided;
    for (const std::uint32_t block : {3U, 4U})
        scene.instances[block].material = std::uint32_t(scene.materials.size() - 1);
    return scene;
}

/// Moves the camera into the lower block.
Scene seenFromWithin(Scene scene) {
    scene.cameras[0].eye = glm::vec3(2.4f, 0.5f, 1.5f);
    return scene;
}

void expectEqual(const Bake& a, const Bake& b) {
    EXPECT_EQ(a.lightmap, b.lightmap);
    EXPECT_EQ(a.surfels, b.surfels);
    EXPECT_EQ(a.tree, b.tree);
    EXPECT_EQ(a.caches, b.caches);
}

std::size_t surfelsOf(const Bake& bake, std::uint32_t instance) {
    return std::size_t(std::ranges::count(bake.surfels.instance, instance));
}

TEST(DarkBacksOfABake, HaveNeitherTexelsNorSurfels) {
    const Scene scene = roomOf(true);
    const Bake made = baked(scene);
    expectEqual(made, baked(roomOf(false)));
    EXPECT_EQ(made.sceneHash, bakeInputHash(scene));
    EXPECT_GT(surfelsOf(made, 3), 0U);
    EXPECT_EQ(made.lightmap.instances[3].backRows, 0U);
    EXPECT_GT(made.lightmap.instances[2].backRows, 0U); // the sheet
    // Seen from inside, one block has both sides. The other, which shares its mesh, has one.
    const Bake seen = baked(seenFromWithin(scene));
    EXPECT_EQ(seen.sceneHash, made.sceneHash);
    EXPECT_GT(seen.lightmap.instances[3].backRows, 0U);
    EXPECT_EQ(seen.lightmap.instances[4].backRows, 0U);
    const auto inside = [&](const Bake& bake, std::uint32_t instance) {
        const glm::vec3 middle = scene.instances[instance].toWorld * glm::vec4(0.5f, 0.6f, 0.5f, 1);
        std::size_t count = 0;
        for (std::size_t s = 0; s < bake.surfels.size(); ++s)
            if (bake.surfels.instance[s] == instance &&
                glm::dot(bake.surfels.normal[s], bake.surfels.position[s] - middle) < 0)
                ++count;
        return count;
    };
    EXPECT_EQ(inside(made, 3), 0U);
    EXPECT_EQ(2 * inside(seen, 3), surfelsOf(seen, 3));
    EXPECT_EQ(inside(seen, 4), 0U);
}

TEST(DarkBacksOfABake, AreFoundAnewWhateverTheStoreHolds) {
    StageStore store;
    const Bake seen = baked(seenFromWithin(roomOf(true)), &store);
    expectEqual(baked(roomOf(true), &store), baked(roomOf(true)));
    expectEqual(baked(seenFromWithin(roomOf(true)), &store), seen);
}

TEST(DarkBacksOfABake, AreBlackInPictures) {
    const Scene scene = roomOf(true);
    const auto made = std::make_shared<const Bake>(baked(scene));
    Relighter relighter(made, LitBands::All);
    Scene lit = scene;
    lit.lights.push_back({.kind = LightKind::Point, .position = glm::vec3(1, 3.5f, 1)});
    relighter.relight(lit, TraceScene(lit), 4);
    FieldPoint point{relighter.field(), made->lightmap, lit, 3, 0, 0.3f, 0.3f, {}, {}};
    const Mesh& mesh = lit.meshOf(lit.instances[3]);
    double front = 0;
    for (point.triangle = 0; point.triangle < mesh.triangleCount(); ++point.triangle) {
        point.normal = triangleNormal(mesh, point.triangle);
        point.back = false;
        front += double(sampleIrradiance(point).x);
        point.back = true;
        point.normal = -point.normal;
        EXPECT_EQ(sampleIrradiance(point), glm::vec3(0));
    }
    EXPECT_GT(front, 0);
}

} // namespace
} // namespace limn::dark_backs_test
