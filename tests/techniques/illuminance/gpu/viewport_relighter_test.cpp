// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/viewport_relighter.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/illuminance/gpu/relit_scene.h"

namespace limn::viewport_relighter_test {
namespace {

/// A corner that no light reaches through anything else: floor and two walls, one of which glows;
/// and a dynamic object, if any.
Scene corner(const Mesh* object = nullptr) {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert({0.8f, 0.7f, 0.5f}));
    b.addMaterial(lambert({0.7f, 0.1f, 0.1f}, {0.3f, 0.1f, 0.6f}));
    b.add(quad({0, 0, 5}, {4, 0, 0}, {0, 0, -5}, 0));
    b.add(quad({0, 0, 5}, {0, 0, -5}, {0, 3, 0}, 1));
    b.add(quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 0));
    if (object)
        b.add(*object, glm::mat4(1), true);
    Scene scene = b.build();
    scene.bake = court().bake;
    scene.sky.radiance = {0.1f, 0.3f, 0.9f};
    for (const LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Directional}) {
        Light l;
        l.kind = kind;
        l.position = {3, 2, 4};
        l.direction = glm::normalize(glm::vec3(-0.5f, -0.6f, -0.7f));
        l.color = {1, 0.6f, 0.2f};
        l.strength = 3;
        scene.lights.push_back(l);
    }
    return scene;
}

class RelightViewport : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        if (!device)
            return;
        options.camera = {.eye = {5, 4, 8}, .target = {1.5f, 1, 1.5f}, .fovY = 0.7f};
        options.view = View::Irradiance;
        prepare(corner());
    }
    void prepare(const Scene& lit) {
        scene = lit;
        trace = std::make_unique<TraceScene>(scene);
        made = baked(*trace, scene.bake);
        // Shadow maps and rays differ at points that touch the walls beside them; the middles do
        // not.
        made->surfels.lightPoints.clear();
        made->surfels.lightNormals.clear();
        layout = std::shared_ptr<LightmapLayout>(made, &made->lightmap);
        relighter = create();
        cpu = std::make_unique<Relighter>(made);
    }
    void TearDown() override {
        relighter.reset();
        ViewportTest::TearDown();
    }
    std::unique_ptr<ViewportRelighter> create() {
        auto result = ViewportRelighter::create(*device, made);
        EXPECT_TRUE(result) << (result ? "" : result.error().message);
        return result ? std::move(*result) : nullptr;
    }
    RelightStats relight(std::uint32_t bounces = 200) {
        cpu->relight(scene, *trace, bounces);
        viewport->setScene(scene, layout);
        return relighter->relight(*viewport, scene, bounces);
    }
    /// The largest difference from the CPU's light, of its largest value.
    float differenceFromCpu() const {
        const std::vector<glm::vec3> mine = relighter->gpu().readRadiosity();
        const std::vector<glm::vec3> expected = radiosityOf(*cpu);
        float largest = 0, difference = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                largest = std::max(largest, expected[i][k]);
                difference = std::max(difference, std::abs(mine[i][k] - expected[i][k]));
            }
        return difference / largest;
    }

    Scene scene;
    std::unique_ptr<TraceScene> trace;
    std::shared_ptr<Bake> made;
    std::unique_ptr<ViewportRelighter> relighter;
    std::unique_ptr<Relighter> cpu; ///< relights along, by as many bounces
};

// Where nothing casts a shadow nothing may differ but rounding: that of 32-bit sums over links, and
// of the shadow maps' tent, whose 16 weights sum to 1. As in gpu_surfel_light_test.cpp.
constexpr float kRounding = 1e-5f;

TEST_F(RelightViewport, LightsTheBakeAsTheCpuDoes) {
    const RelightStats stats = relight();
    EXPECT_TRUE(stats.converged);
    EXPECT_GT(stats.bounces, 3U);
    EXPECT_EQ(stats.lightsTraced, 3U);
    EXPECT_LT(differenceFromCpu(), kRounding);
}

TEST_F(RelightViewport, FollowsLightsMaterialsAndSky) {
    relight();
    scene.lights[0].position.x = 1;
    scene.lights[1].enabled = false;
    const RelightStats lights = relight();
    EXPECT_EQ(lights.lightsTraced, 1U) << "the maps of lights that stand still are kept";
    EXPECT_EQ(lights.lightsOff, 1U);
    EXPECT_LT(differenceFromCpu(), kRounding);
    scene.materials[0].baseColor = {0.1f, 0.5f, 0.3f, 1};
    EXPECT_EQ(relight().lightsTraced, 0U);
    EXPECT_LT(differenceFromCpu(), kRounding);
    scene.sky.radiance = {1, 0, 0};
    relight();
    EXPECT_LT(differenceFromCpu(), kRounding);
}

TEST_F(RelightViewport, FewBouncesLeaveNothingOfTheLightThatWas) {
    relight();
    for (const std::uint32_t bounces : {1U, 3U}) {
        scene.relight.maxBounces = bounces; // a change of its own
        scene.lights[0].position.x = bounces == 1 ? 1 : 3;
        relight(bounces);
        EXPECT_LT(differenceFromCpu(), kRounding);
        const std::vector<glm::vec3> before = relighter->gpu().readRadiosity();
        relighter = create();
        relighter->relight(*viewport, scene, bounces);
        EXPECT_EQ(relighter->gpu().readRadiosity(), before);
    }
}

TEST_F(RelightViewport, DynamicObjectsOccludeLinksAsOnTheCpu) {
    const Mesh block = simple::box(glm::vec3(-0.4f), glm::vec3(0.4f), false);
    Scene dynamic = corner(&block);
    dynamic.lights.clear(); // shadow maps and rays differ at the edges of shadows
    dynamic.relight.dynamicOcclusion = true;
    prepare(dynamic);
    for (const float x : {0.6f, 1.f, 2.f}) {
        scene.instances.back().toWorld[3] = {x, 0.5f, 1, 1};
        const RelightStats stats = relight();
        EXPECT_GT(stats.linksOccluded, 100U);
        EXPECT_GT(stats.cachesOccluded, 10U);
        EXPECT_GT(stats.occlusionMs, 0);
        EXPECT_LT(differenceFromCpu(), kRounding);
        EXPECT_EQ(relight().occlusionMs, 0) << "it stands still";
    }
    scene.relight.dynamicOcclusion = false;
    EXPECT_EQ(relight().linksOccluded, 0U);
    EXPECT_LT(differenceFromCpu(), kRounding);
}

TEST_F(RelightViewport, DoesNothingWhenNothingChangedAndBouncesHaveConverged) {
    EXPECT_FALSE(relight(1).converged);
    EXPECT_FALSE(relight(1).skipped);
    EXPECT_TRUE(relight().converged);
    const std::uint64_t version = relighter->gpu().fieldVersion();
    const RelightStats idle = relight();
    EXPECT_TRUE(idle.skipped);
    EXPECT_EQ(idle.bounces, 0U);
    EXPECT_EQ(idle.lightsTraced, 0U);
    EXPECT_EQ(relighter->gpu().fieldVersion(), version);
}

TEST_F(RelightViewport, LightsThatReachNothingCostNothing) {
    relight();
    Light far = scene.lights[0], black = far;
    far.position = {0, 0, 20}; // the corner ends at 5
    far.range = 14.9f;
    black.color = glm::vec3(0);
    scene.lights.insert(scene.lights.end(), {far, black});
    const RelightStats stats = relight();
    EXPECT_EQ(stats.lightsOff, 2U);
    EXPECT_EQ(stats.lightsTraced, 0U);
    EXPECT_TRUE(stats.skipped);
    scene.lights[3].range = 15.1f;
    const RelightStats near = relight();
    EXPECT_EQ(near.lightsOff, 1U);
    EXPECT_GT(near.lightsTraced, 0U);
}

TEST_F(RelightViewport, OnlyBandsAndCachesThatSomethingReadsAreLit) {
    Scene wide = corner();
    wide.bake.bands = 6;
    prepare(wide);
    const auto gridCaches = std::uint32_t(made->caches.size()) - made->caches.lightmapCount;
    RelightStats stats = relight();
    EXPECT_EQ(stats.bandsLit, 3U);
    EXPECT_EQ(stats.bandsSkipped, 3U);
    EXPECT_EQ(relighter->gpu().readCacheSh().size(), made->caches.size() * 9);
    EXPECT_EQ(stats.gridCachesSkipped, gridCaches);
    EXPECT_EQ(stats.gridCachesSkipped, cpu->relight(scene, *trace, 0).gridCachesSkipped);
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = 0;
    stats = relight();
    EXPECT_EQ(stats.bandsLit, 6U);
    EXPECT_EQ(stats.bandsSkipped, 0U);
    EXPECT_EQ(relighter->gpu().readCacheSh().size(), made->caches.size() * 36);
    const Mesh ball = simple::sphere(0.1f, 0, false);
    prepare(corner(&ball));
    EXPECT_EQ(relight().gridCachesSkipped, 0U);
}

TEST_F(RelightViewport, TheViewportShowsItsField) {
    relight();
    viewport->render(options);
    const ImageF shown = viewport->readLinear();
    viewport->setIndirect(relighter->gpu().readField());
    viewport->render(options);
    const ImageF copied = viewport->readLinear();
    EXPECT_GT(pixel(shown, 16, 16).x, 0.01f);
    EXPECT_TRUE(shown.rgb == copied.rgb);
}

} // namespace
} // namespace limn::viewport_relighter_test
