// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/emitted_field.h"

#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limn::emitted_field_test {
namespace {

/// The hall with a window under a sky, a glowing block and a dynamic box, lit by a lamp as well.
Scene glowingHall(LinkStorage storage, std::uint32_t bands) {
    Scene scene = hall(storage, bands, true);
    scene.bake.lightmapCaches = 1000;
    scene.bake.rays = 64;
    scene.materials.push_back(simple::lambert(glm::vec3(0.5f), {1, 2, 0.5f}));
    scene.instances[1].material = 1;
    scene.sky.radiance = {0.5f, 0.6f, 0.9f};
    scene.lights.resize(1);
    scene.lights[0].position = {3, 2, 4};
    scene.lights[0].strength = 30;
    Instance moving = scene.instances[1];
    moving.material = 0;
    moving.dynamic = true;
    moving.toWorld = glm::translate(glm::mat4(1), glm::vec3(1.5f, 0, 1.5f));
    scene.instances.push_back(moving);
    return scene;
}

double difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, double(glm::length(a[i] - b[i])));
    return most;
}

double brightest(const std::vector<glm::vec4>& of) {
    double most = 0;
    for (const glm::vec4 c : of)
        most = std::max(most, double(glm::length(c)));
    return most;
}

/// The field of a scene in which nothing reflects and no light shines.
IndirectField litAlone(const std::shared_ptr<const Bake>& baked, Scene scene) {
    scene.lights.clear();
    for (Material& m : scene.materials)
        m.baseColor = {0, 0, 0, 1};
    Relighter relighter(baked);
    relighter.relight(scene, TraceScene(scene), 4);
    return relighter.field();
}

TEST(EmittedField, IsTheFieldOfASceneThatReflectsNothing) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const std::uint32_t bands : {2U, 3U, 4U}) {
            SCOPED_TRACE(testing::Message() << int(storage) << ", " << bands << " bands");
            const Scene scene = glowingHall(storage, bands);
            const auto baked = bakeOf(TraceScene(scene));
            const IndirectField emitted = emittedField(baked, scene),
                                expected = litAlone(baked, scene);
            ASSERT_EQ(emitted.lightmap.size(), expected.lightmap.size());
            ASSERT_EQ(emitted.gridSize, expected.gridSize);
            ASSERT_EQ(emitted.grid.size(), expected.grid.size());
            EXPECT_EQ(emitted.bands, expected.bands);
            EXPECT_EQ(emitted.chroma(), expected.chroma());
            EXPECT_TRUE(emitted.continues);
            EXPECT_GT(brightest(expected.lightmap), 1);
            EXPECT_LT(difference(emitted.lightmap, expected.lightmap),
                      1e-5 * brightest(expected.lightmap));
            EXPECT_LT(difference(emitted.grid, expected.grid), 1e-5 * brightest(expected.grid));
        }
}

TEST(EmittedField, LacksWhatDynamicObjectsHide) {
    Scene scene = glowingHall(LinkStorage::Rtp, 3);
    const auto baked = bakeOf(TraceScene(scene));
    const IndirectField with = emittedField(baked, scene);
    scene.relight.dynamicOcclusion = false;
    const IndirectField without = emittedField(baked, scene);
    EXPECT_GT(difference(with.lightmap, without.lightmap), 0.1);
}

TEST(EmittedField, HasNoGridWhereNothingReadsOne) {
    Scene scene = glowingHall(LinkStorage::Rtp, 3);
    scene.instances.pop_back();
    const IndirectField emitted = emittedField(bakeOf(TraceScene(scene)), scene);
    EXPECT_EQ(emitted.cells(), 0U);
    EXPECT_TRUE(emitted.grid.empty());
}

} // namespace
} // namespace limn::emitted_field_test
