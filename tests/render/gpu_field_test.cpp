// SPDX-License-Identifier: MIT
#include "engine/field/grid_depth.h"
#include "engine/field/sample_field.h"
#include "engine/measure/compare.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/illuminance/gpu/relit_scene.h"

#include <random>

namespace limn::gpu_field_test {
namespace {

class ViewportGpuField : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        if (!device)
            return;
        scene = court();
        // An instance that is lit from the grid.
        simple::SceneBuilder b;
        b.scene = scene;
        b.assets = std::make_shared<Assets>(*scene.assets);
        b.add(simple::sphere(0.4f, 2, false), glm::translate(glm::mat4(1), {3.2f, 0.8f, 1}), true);
        scene = b.build();
        trace = std::make_unique<TraceScene>(scene);
        made = baked(*trace, scene.bake);
        layout = std::shared_ptr<LightmapLayout>(made, &made->lightmap);
        relighter = gpuRelighter(*device, made);
        values = surfelValues(*made, scene, *trace);
        options.camera = {.eye = {3, 4, 9}, .target = {2, 1, 2}, .fovY = 0.7f};
        options.width = options.height = 64;
    }
    void TearDown() override {
        relighter.reset();
        ViewportTest::TearDown();
    }

    Scene scene;
    std::unique_ptr<TraceScene> trace;
    std::shared_ptr<Bake> made;
    std::unique_ptr<GpuRelighter> relighter;
    SurfelValues values;
};

TEST_F(ViewportGpuField, LooksTheSameAsByWayOfTheCpu) {
    relighter->relight(values.inputs(), 4);
    viewport->setIndirect(relighter->field());
    const ImageF direct = draw(scene, View::Irradiance);
    viewport->setIndirect(relighter->readField());
    const ImageF copied = draw(scene, View::Irradiance);
    EXPECT_GT(meanOf(direct), 0.01);
    EXPECT_TRUE(direct.rgb == copied.rgb) << "the same numbers, sampled alike";
}

TEST_F(ViewportGpuField, ShowsWhatIsRelitBetweenFramesWithoutAnotherCall) {
    viewport->setIndirect(relighter->field());
    EXPECT_EQ(meanOf(draw(scene, View::Irradiance)), 0) << "not lit yet";
    relighter->relight(values.inputs(), 30);
    const double once = meanOf(draw(scene, View::Irradiance));
    EXPECT_GT(once, 0.01);
    for (auto* v : {&values.direct, &values.emitted, &values.sky})
        for (glm::vec3& c : *v)
            c *= 2;
    relighter->relight(values.inputs(), 30);
    EXPECT_NEAR(meanOf(draw(scene, View::Irradiance)), 2 * once, 2e-3 * once);
}

TEST_F(ViewportGpuField, AnotherFieldOfTheSameVersionIsAnother) {
    relighter->relight(values.inputs(), 4);
    IndirectField field = relighter->readField();
    viewport->setIndirect(field);
    const double once = meanOf(draw(scene, View::Irradiance));
    for (auto* part : {&field.lightmap, &field.grid})
        for (glm::vec4& c : *part)
            c *= 2.f;
    viewport->setIndirect(field);
    EXPECT_NEAR(meanOf(draw(scene, View::Irradiance)), 2 * once, 1e-5 * once);
}

TEST_F(ViewportGpuField, TheFieldOutlivesItsRelighterAndGivesWayToAnother) {
    relighter->relight(values.inputs(), 4);
    const IndirectField copy = relighter->readField();
    viewport->setIndirect(copy);
    const ImageF before = draw(scene, View::Irradiance);
    viewport->setIndirect(relighter->field());
    relighter.reset();
    EXPECT_TRUE(draw(scene, View::Irradiance).rgb == before.rgb);
    viewport->setIndirect(IndirectField{.version = copy.version});
    EXPECT_EQ(meanOf(draw(scene, View::Irradiance)), 0);
}

using ViewportGrid = ViewportTest;

TEST_F(ViewportGrid, IsReadPastWallsAsOnTheCpu) {
    IndirectField field;
    field.version = 1;
    field.gridSize = {5, 3, 4};
    field.gridBounds = {{-2, -0.8f, -1.8f}, {2.2f, 1.1f, 2}};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> radiance(0, 9);
    field.grid.assign(5 * 3 * 4 * 9, glm::vec4(0));
    for (std::size_t cell = 0; cell < 5 * 3 * 4; ++cell)
        field.grid[cell] = glm::vec4(radiance(random), radiance(random), radiance(random), 0);
    // Walls from a tenth of the reach to beyond it, in no order; some cells in solids.
    std::vector<std::uint16_t> depth(5 * 3 * 4 * kGridDepthTexels);
    for (std::size_t i = 0; i < depth.size(); ++i)
        depth[i] = i / kGridDepthTexels % 7 == 0 ? 0xffff : std::uint16_t(random() % 10240);
    field.gridDepth = std::make_shared<const std::vector<std::uint16_t>>(depth);
    viewport->setIndirect(field);
    const Scene scene = plane().build();
    const ImageF image = draw(scene, View::Irradiance);
    double difference = 0;
    IndirectField plain = field;
    plain.gridDepth = nullptr;
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) {
            const glm::vec3 p = planePoint(options, x, y), n(0, 1, 0);
            const glm::vec3 is = sampleIrradiance({field, {}, scene, 0, 0, 0, 0, p, n});
            expectNear(pixel(image, x, y), is, 2e-3f);
            difference +=
                double(std::abs(is.x - sampleIrradiance({plain, {}, scene, 0, 0, 0, 0, p, n}).x));
        }
    EXPECT_GT(difference / (32 * 32), 0.3); // else the walls are not seen at all
}

TEST_F(ViewportGrid, IsReadByMomentsOfDistancesAsOnTheCpu) {
    IndirectField field;
    field.gridSize = {5, 3, 4};
    field.gridBounds = {{-2, -0.8f, -1.8f}, {2.2f, 1.1f, 2}};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(0, 9), distance(0.1f, 1.2f);
    field.grid.assign(5 * 3 * 4 * 9, glm::vec4(0));
    for (std::size_t cell = 0; cell < 5 * 3 * 4; ++cell)
        field.grid[cell] = glm::vec4(value(random), value(random), value(random), 0);
    const Scene scene = plane().build();
    for (const bool smooth : {false, true}) {
        GridMoments moments{.smooth = smooth};
        for (std::size_t i = 0; i < 5 * 3 * 4 * kGridDepthTexels; ++i) {
            const float mean = distance(random);
            const bool solid = i / kGridDepthTexels % 7 == 0;
            moments.texels.push_back(solid ? glm::vec2(0) : glm::vec2(mean, 1.05f * mean * mean));
        }
        field.gridMoments = std::make_shared<const GridMoments>(std::move(moments));
        ++field.version;
        viewport->setIndirect(field);
        const ImageF image = draw(scene, View::Irradiance);
        for (std::uint32_t y = 0; y < 32; ++y)
            for (std::uint32_t x = 0; x < 32; ++x) {
                const glm::vec3 p = planePoint(options, x, y), n(0, 1, 0);
                expectNear(pixel(image, x, y),
                           sampleIrradiance({field, {}, scene, 0, 0, 0, 0, p, n}), 3e-3f);
            }
    }
}

} // namespace
} // namespace limn::gpu_field_test
