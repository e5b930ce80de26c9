// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/seen_caches.h"
#include "tests/techniques/illuminance/gpu/relit_scene.h"
#include "tests/techniques/illuminance/relight/differing_caches.h"

namespace limn::gpu_seen_caches_test {
namespace {

class GpuSeenCaches : public DeviceTest {};

struct Views {
    CacheFlags a, b, all;
};

Views viewsOf(const Scene& scene, const Bake& bake) {
    const CacheFootprints footprints = cacheFootprints(scene, bake);
    Camera camera;
    camera.eye = {3.2f, 1.8f, 4.2f};
    camera.target = {0, 1, 3};
    Views v{seenCaches(footprints, camera, 1.5f), {}, CacheFlags(bake.caches.lightmapCount, 1)};
    camera.target = {4, 1.5f, 0};
    v.b = seenCaches(footprints, camera, 1.5f);
    return v;
}

TEST_F(GpuSeenCaches, AreLitAsIfAllWereAndTheOthersLater) {
    const Scene scene = court();
    const TraceScene trace(scene);
    for (const std::uint32_t chroma : {0U, 1U}) {
        BakeSettings settings = scene.bake;
        settings.bands = 4;
        settings.surfels = 100; // some caches are read by none
        settings.chromaBands = chroma;
        const std::shared_ptr<Bake> made = baked(trace, settings);
        const Views views = viewsOf(scene, *made);
        const SurfelValues values = surfelValues(*made, scene, trace);
        for (const std::uint32_t bounces : {1U, 2U, 64U}) {
            const auto all = gpuRelighter(*device, made), few = gpuRelighter(*device, made);
            ASSERT_TRUE(all && few);
            for (int call = 0; call < 3; ++call) { // the light stands, the camera turns to and fro
                const CacheFlags& seen = call % 2 == 0 ? views.a : views.b;
                all->relight(values.inputs(), bounces);
                const GpuRelightStats stats = few->relight(values.inputs(), bounces, {}, &seen);
                const IndirectField a = all->readField(), f = few->readField();
                EXPECT_EQ(differing(*made, a, f, seen), 0U) << bounces << " bounces " << call;
                if (call == 0) {
                    EXPECT_GT(stats.cachesUnread, 10U);
                    EXPECT_GT(stats.cachesUnseen, made->caches.lightmapCount / 10);
                    EXPECT_GT(differing(*made, a, f, views.all), 20U);
                }
                EXPECT_EQ(a.grid, f.grid);
                ASSERT_TRUE(all->readRadiosity() == few->readRadiosity());
            }
            const GpuRelightStats rest = few->relight(values.inputs(), 0);
            EXPECT_EQ(rest.bounces, 0U);
            EXPECT_EQ(rest.cachesUnseen, 0U);
            EXPECT_EQ(all->readField().lightmap, few->readField().lightmap);
        }
        const auto done = gpuRelighter(*device, made);
        ASSERT_TRUE(done->relight(values.inputs(), 64, {}, &views.a).converged);
        EXPECT_TRUE(done->relight(values.inputs(), 64, {}, &views.a).skipped);
        EXPECT_FALSE(done->relight(values.inputs(), 64, {}, &views.b).skipped);
        EXPECT_TRUE(done->relight(values.inputs(), 64, {}, &views.b).skipped);
    }
}

} // namespace
} // namespace limn::gpu_seen_caches_test
