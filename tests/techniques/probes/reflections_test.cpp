// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"
#include "engine/field/field_reading.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/sampling.h"
#include "engine/picture/field_lobe.h"
#include "engine/picture/field_render.h"
#include "engine/techniques/probes/marched_part.h"
#include "tests/techniques/probes/lit_by_probes.h"

#include <gtest/gtest.h>

#include <optional>

namespace limn::reflections_test {
namespace {

constexpr std::uint32_t kMetal = 1;

Material metal(float roughness, glm::vec3 emission = glm::vec3(0)) {
    Material m = simple::lambert(glm::vec3(0.9f), emission);
    m.metallic = 1;
    m.roughness = roughness;
    return m;
}

/// The room with lamps, whose block is of polished metal.
Scene roomWithMetal(float roughness = 0.1f) {
    Scene scene = room();
    scene.materials.push_back(metal(roughness));
    scene.instances[1].material = kMetal;
    return scene;
}

struct Reflected : LitByProbes {
    explicit Reflected(Scene s, std::map<std::string, double> settings = {})
        : LitByProbes(std::move(s), [&] {
              settings.try_emplace("probes.count", 64);
              return settings;
          }()) {}

    LightingReport march() {
        return lighting->update(
            {.scene = scene, .trace = trace.get(), .bounces = 64, .reflections = true}, {});
    }
    const MarchedMaps* maps() const { return marchedMapsOf(lighting->field()->parts); }
};

/// Calls `visit` with reflections at points of metal that rays from `eye` meet.
template <class Visit>
int reflect(const Reflected& lit, glm::vec3 eye, const Visit& visit) {
    const DirectionSet ways(4000, true, 0);
    int count = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const Ray ray{eye, ways[i]};
        const Hit hit = lit.trace->closestHit(ray);
        if (!hit || lit.scene.instances[hit.instance].material != kMetal)
            continue;
        const std::optional<SurfacePoint> p = surfacePoint(*lit.trace, hit);
        if (!p)
            continue;
        visit(fieldReflection(*lit.trace, glossyPoint(*lit.trace, hit, ray, *p)));
        ++count;
    }
    return count;
}

TEST(ProbeReflections, AFurnaceIsReflectedAsItIs) {
    const glm::vec3 L(2, 3, 4);
    for (const float roughness : {0.f, 0.1f, 0.3f, 0.45f}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0), L));
        b.addMaterial(metal(roughness, L));
        // No ray of a probe meets an edge, where it could leave the room.
        b.add(simple::box(glm::vec3(0), glm::vec3(4.1f, 3.05f, 5.03f), true));
        b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false, kMetal));
        Reflected lit(b.build());
        lit.march();
        ASSERT_TRUE(lit.maps());
        const FieldPart* part = reflectingPart(*lit.lighting->field());
        const int count = reflect(lit, {3, 2, 3}, [&](const FieldReflection& r) {
            EXPECT_LT(glm::distance(sampleReflection(*part, r.lobe).radiance, L), 1e-4f)
                << roughness;
        });
        EXPECT_GT(count, 10);
    }
}

TEST(ProbeReflections, AreThereOnlyWhereTheyAreWantedAndShow) {
    Reflected dull(room());
    EXPECT_FALSE(dull.march().lacks);
    EXPECT_FALSE(dull.maps()) << "nothing is glossy";
    Reflected off(roomWithMetal(), {{"probes.reflections", 0}});
    EXPECT_FALSE(off.march().lacks);
    EXPECT_FALSE(off.maps());
    Reflected lit(roomWithMetal());
    const LightingReport without = lit.update();
    EXPECT_TRUE(without.lacks) << "this light is not for pictures that the CPU draws";
    EXPECT_FALSE(lit.maps());
    EXPECT_EQ(counterOf(without, "reflection_bytes"), 0);
    const LightingReport report = lit.march();
    ASSERT_TRUE(lit.maps());
    EXPECT_FALSE(report.lacks);
    EXPECT_GE(counterOf(report, "reflection_bytes"), double(lit.maps()->bytes()));
    EXPECT_TRUE(lit.march().skipped);
    lit.scene.technique.settings["probes.reflections"] = 0;
    lit.march();
    EXPECT_FALSE(lit.maps());
}

TEST(ProbeReflections, FollowColoursWithoutARayAndChangesLikeAFreshStart) {
    Reflected lit(roomWithMetal());
    lit.march();
    const std::vector<glm::vec3> before = lit.maps()->radiance[0];
    for (Light& light : lit.scene.lights)
        light.color = {2, 0, 1};
    EXPECT_EQ(counterOf(lit.march(), "rays"), 0);
    float brightest = 0;
    for (std::size_t k = 0; k < before.size(); ++k) {
        brightest = std::max(brightest, before[k].x);
        EXPECT_NEAR(lit.maps()->radiance[0][k].x, 2 * before[k].x, 1e-5f * (1 + before[k].x));
        EXPECT_EQ(lit.maps()->radiance[0][k].y, 0);
    }
    EXPECT_GT(brightest, 0.1f);
    lit.scene.lights[1].position = {3.5f, 2, 4};
    lit.scene.materials[0].baseColor = glm::vec4(0.3f);
    lit.scene.instances[1].toWorld[3] = {1, 0, 1, 1};
    lit.trace = std::make_shared<const TraceScene>(lit.scene);
    lit.march();
    Reflected fresh(lit.scene, lit.scene.technique.settings);
    const ThreadLimit one(1);
    fresh.march();
    EXPECT_EQ(lit.maps()->radiance, fresh.maps()->radiance);
    EXPECT_EQ(lit.maps()->planes, fresh.maps()->planes);
    EXPECT_EQ(lit.maps()->nearest, fresh.maps()->nearest);
}

TEST(ProbeReflections, ExplainWhereTheirLightComesFrom) {
    Scene scene = roomWithMetal(0.3f);
    scene.sky.radiance = glm::vec3(1);
    Reflected lit(scene, {{"probes.bounces", 1}});
    lit.march();
    FieldReading reading;
    const int count = reflect(lit, {3, 2, 3}, [&](const FieldReflection& r) {
        addReflection(*lit.lighting->field(), r.lobe, r.weight, reading);
    });
    ASSERT_GT(count, 10);
    const glm::vec3 is = valueOf(reading, *lit.lighting->field());
    EXPECT_GT(is.x, 0.1f);
    const Explanation why = lit.lighting->explain(lit.scene, reading, {});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(totalOf(why.byOrigin)[c], is[c], 1e-4f * is[c]);
        EXPECT_NEAR(totalOf(why.bySender)[c], is[c], 1e-4f * is[c]);
    }
}

TEST(ProbeReflections, APictureCountsThemAndMirrorsTheHalfOfTheWallThatGlows) {
    // A mirror for a floor, and a wall behind it whose left half glows.
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.2f)));
    b.addMaterial(metal(0));
    b.addMaterial(simple::lambert(glm::vec3(0), glm::vec3(5)));
    b.add(simple::box({0, 0, 0}, {4, 3, 4}, true));
    b.add(simple::quad({0, 0.01f, 4}, {4, 0, 0}, {0, 0, -4}, kMetal));
    b.add(simple::quad({0, 0.02f, 0.01f}, {2, 0, 0}, {0, 2.9f, 0}, 2));
    Reflected lit(b.build(), {{"probes.side", 64}});
    lit.march();
    FieldRenderOptions options;
    options.camera.eye = {2, 1.5f, 3.5f};
    options.camera.target = {2, 0.5f, 1};
    options.width = options.height = 32;
    ReflectionCounts counts;
    options.reflections = &counts;
    const ImageF image =
        renderField(*lit.trace, *lit.lighting->field(), layoutWithoutLightmap(lit.scene), options);
    const std::uint32_t row = 22 * 32; // of the floor
    EXPECT_NEAR(image.rgb[row + 8].x, 0.9f * 5, 0.5f);
    EXPECT_LT(image.rgb[row + 24].x, 0.5f);
    EXPECT_GT(counts.all, 16U * 32 * 8);
    EXPECT_LT(double(counts.unknown), 0.01 * double(counts.all));
}

} // namespace
} // namespace limn::reflections_test
