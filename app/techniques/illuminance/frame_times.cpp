// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/frame_times.h"

#include "engine/gpu/device.h"
#include "engine/techniques/illuminance/gpu/viewport_relighter.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"

#include <chrono>
#include <optional>
#include <utility>

namespace limn {

namespace {

/// A viewport with bounced light from one device or the other, or without any.
struct FrameViewport {
    gpu::Device& device;
    Viewport viewport{device};
    ViewportOptions options;
    const TraceScene& trace;
    std::unique_ptr<Relighter> cpu;
    std::unique_ptr<ViewportRelighter> gpu;
    std::optional<CacheFlags> seen; ///< caches to light; none: all

    FrameTimes draw(const Scene& lit, std::uint32_t bounces);
};

FrameTimes FrameViewport::draw(const Scene& lit, std::uint32_t bounces) {
    const auto start = std::chrono::steady_clock::now();
    viewport.setLighting(lit);
    const CacheFlags* wanted = seen ? &*seen : nullptr;
    const RelightStats light = gpu   ? gpu->relight(viewport, lit, bounces, {}, wanted)
                               : cpu ? cpu->relight(lit, trace, bounces, {}, wanted)
                                     : RelightStats{};
    if (cpu)
        viewport.setIndirect(cpu->field());
    viewport.render(options);
    device.waitIdle();
    const std::chrono::duration<double, std::milli> total =
        std::chrono::steady_clock::now() - start;
    const ViewportStats& drawn = viewport.stats();
    FrameTimes t;
    t.shadowMaps = drawn.shadowMs + (gpu ? drawn.relightShadowMs : 0);
    t.lightsOnSurfels = light.directMs - (gpu ? drawn.relightShadowMs : 0);
    t.surfels = light.surfelLightMs + light.surfelReadMs;
    t.pull = light.pullMs;
    t.caches = light.cacheLightMs;
    t.field = light.fieldMs;
    t.upload = drawn.uploadMs;
    t.geometry = drawn.geometryMs;
    t.indirect = drawn.indirectMs;
    t.direct = drawn.directMs;
    t.tonemap = drawn.tonemapMs;
    if (!lit.lights.empty())
        t.perLight = (t.shadowMaps + t.lightsOnSurfels) / double(lit.lights.size());
    t.total = total.count();
    t.cachesUnseen = light.cachesUnseen;
    t.bandsLit = light.bandsLit;
    return t;
}

} // namespace

Result<DrawnFrames> drawFrames(const FrameOptions& o, const TraceScene& trace,
                               const std::shared_ptr<const Bake>& bake, int runs,
                               const std::function<FrameScene(int k)>& sceneAt) {
    const auto device = gpu::createDevice({.name = o.device});
    if (!device)
        return tl::make_unexpected(device.error());
    FrameScene shown = sceneAt(0);
    FrameViewport frame{.device = **device, .trace = trace};
    frame.options.view = o.view;
    frame.options.width = o.width;
    frame.options.height = o.height;
    if (o.indirect && o.onGpu) {
        auto made = ViewportRelighter::create(**device, bake);
        if (!made)
            return tl::make_unexpected(made.error());
        frame.gpu = std::move(*made);
    } else if (o.indirect) {
        frame.cpu = std::make_unique<Relighter>(bake);
    }
    if (o.seenOnly)
        frame.seen = seenCaches(cacheFootprints(shown.scene, *bake), shown.camera,
                                float(o.width) / float(o.height));
    frame.viewport.setCoarseShadows(o.coarseShadows);
    frame.viewport.setScene(shown.scene, {bake, &bake->lightmap});
    DrawnFrames drawn{.device = (*device)->properties.deviceName};
    for (int k = 0; k <= runs; ++k) {
        if (k > 0)
            shown = sceneAt(k);
        frame.options.camera = shown.camera;
        const FrameTimes times = frame.draw(shown.scene, o.bounces);
        if (k > 0)
            drawn.frames.push_back(times);
    }
    const ViewportStats& stats = frame.viewport.stats();
    drawn.lightsLeftOut = stats.lightsLeftOut;
    drawn.geometryDrawn = std::uint32_t(stats.geometryDrawn - 1);
    drawn.bytes = stats.gpuBytes;
    return drawn;
}

} // namespace limn
