// SPDX-License-Identifier: MIT
#include "tests/techniques/illuminance/gpu/relit_scene.h"

namespace limn::gpu_skips_test {
namespace {

class GpuSkips : public DeviceTest {};

TEST_F(GpuSkips, NoGridCacheIsLitWhereNothingReadsThem) {
    const Scene scene = court();
    const TraceScene trace(scene);
    const auto made = baked(trace, scene.bake);
    const Caches& caches = made->caches;
    const auto gridCaches = std::uint32_t(caches.size()) - caches.lightmapCount;
    ASSERT_LT(caches.fillBegin[caches.lightmapCount], caches.fillBegin[caches.size()]);
    SurfelValues values = surfelValues(*made, scene, trace);
    const auto lit = [&](GpuRelighter& by, bool grid, std::uint32_t bounces = 3) {
        SurfelInputs inputs = values.inputs();
        inputs.grid = grid;
        inputs.settings.maxBounces = 3; // from no bounced light at all
        return by.relight(inputs, bounces);
    };
    const auto always = gpuRelighter(*device, made), toggled = gpuRelighter(*device, made);
    const GpuRelightStats with = lit(*always, true), without = lit(*toggled, false);
    EXPECT_EQ(with.gridCachesSkipped, 0U);
    EXPECT_EQ(without.gridCachesSkipped, gridCaches);
    EXPECT_EQ(with.dispatches, without.dispatches + 3) << "light, fill and write them";
    EXPECT_EQ(toggled->readField().gridSize, glm::uvec3(0));
    EXPECT_TRUE(toggled->readField().grid.empty());
    EXPECT_FALSE(toggled->readField().gridDepth);
    EXPECT_TRUE(toggled->readField().lightmap == always->readField().lightmap);

    EXPECT_EQ(lit(*toggled, true).gridCachesSkipped, 0U);
    EXPECT_TRUE(toggled->readField().grid == always->readField().grid);
    lit(*toggled, false);
    for (glm::vec3& e : values.direct)
        e *= 0.3f;
    lit(*toggled, false);
    lit(*always, true);
    EXPECT_EQ(lit(*toggled, true).gridCachesSkipped, 0U);
    EXPECT_TRUE(toggled->readField().grid == always->readField().grid) << "of the light that is";

    EXPECT_TRUE(lit(*toggled, false, 200).converged);
    EXPECT_TRUE(lit(*toggled, false, 200).skipped);
    EXPECT_GT(lit(*toggled, true, 200).dispatches, 0U);
    EXPECT_TRUE(lit(*toggled, true, 200).skipped);
}

} // namespace
} // namespace limn::gpu_skips_test
