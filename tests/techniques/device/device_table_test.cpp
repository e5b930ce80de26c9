// SPDX-License-Identifier: MIT
#include "engine/techniques/device/device_table.h"

#include "engine/lightmap/atlas.h"
#include "engine/measure/compare.h"
#include "engine/picture/field_render.h"
#include "engine/techniques/technique_table.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace limn::device_table_test {
namespace {

class DeviceTableTest : public ViewportTest {};

TEST_F(DeviceTableTest, LightThatIsReadBackIsThatOfTheCpu) {
    Scene scene = *litRoom(300, 400);
    int lit = 0;
    for (const Technique* technique : techniques()) {
        SCOPED_TRACE(technique->name);
        if (!lightsOnDevice(*technique)) {
            EXPECT_FALSE(lightOnDevice(*technique, *device, *viewport, {}));
            continue;
        }
        ++lit;
        scene.technique.technique = technique->name;
        const TraceScene trace(scene);
        Prepared prepared;
        auto known = std::make_shared<const LightmapLayout>(layoutWithoutLightmap(scene));
        if (const Precomputation* p = technique->precomputation) {
            prepared = {*p->prepare(trace, {}, {}), std::make_shared<const Scene>(scene)};
            known = {prepared.data, &prepared.data->layout()};
        }
        viewport->setScene(scene, known);
        const auto onDevice = lightOnDevice(*technique, *device, *viewport, prepared);
        ASSERT_TRUE(onDevice) << onDevice.error().message;
        const LightingReport report = (*onDevice)->update({.scene = scene, .bounces = 64}, {});
        EXPECT_FALSE(report.skipped);
        EXPECT_EQ((*onDevice)->field(), nullptr);
        const auto onCpu = technique->light(prepared);
        onCpu->update({.scene = scene, .trace = &trace, .bounces = 64}, {});
        EXPECT_TRUE(onCpu->readField() == *onCpu->field());

        FieldRenderOptions shown{.view = View::Irradiance, .width = 32, .height = 24};
        shown.camera = {.eye = {0.4f, 2.4f, 4.6f}, .target = {2.5f, 0.5f, 1}};
        const ImageF mine = renderField(trace, (*onDevice)->readField(), *known, shown),
                     expected = renderField(trace, *onCpu->field(), *known, shown);
        double squares = 0;
        for (std::size_t p = 0; p < mine.rgb.size(); ++p)
            squares +=
                double(glm::dot(mine.rgb[p] - expected.rgb[p], mine.rgb[p] - expected.rgb[p]));
        const double mean = meanOf(expected),
                     rms = std::sqrt(squares / (3 * double(mine.rgb.size()))) / mean;
        ASSERT_GT(mean, 0);
        std::printf("%-14s rms difference %.2e of the mean\n", technique->name, rms);
        // Shadow maps differ from shadow rays at edges, on a share of the surfaces about as wide as
        // their texels; halfs round each coefficient.
        EXPECT_LT(rms, 0.01);
        viewport->setIndirect(IndirectField{}); // the light's own ends with it
    }
    EXPECT_GE(lit, 4);
}

} // namespace
} // namespace limn::device_table_test
