// SPDX-License-Identifier: MIT
#include "app/render_image.h"

#include "engine/core/log.h"
#include "engine/gpu/device.h"
#include "engine/relight/dimming.h"
#include "engine/render/viewport_relighter.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn {

// Nothing is measured for one picture: that would take longer than to relight it on either.
static RelightOn choose(const gpu::Device& device, const Scene& scene,
                        const RenderRequest& request) {
    if (request.relightOn == RelightOn::Auto && dimsLinks(scene))
        return RelightOn::Cpu; // only it does that
    const VkPhysicalDeviceProperties& p = device.properties;
    return chooseRelight(
        request.relightOn, true,
        rememberedRelightTimes(defaultRelightTimesFile(),
                               relightTimesKey(p.deviceName, p.driverVersion, *request.bake)));
}

// Bounces until nothing changes, as the CPU does.
static Result<void> relight(gpu::Device& device, Viewport& viewport, const Scene& scene,
                            const RenderRequest& request, RenderedImage& result) {
    if (!request.relight)
        return {};
    const bool onGpu = choose(device, scene, request) == RelightOn::Gpu;
    auto relighter = onGpu ? ViewportRelighter::create(device, request.bake)
                           : Result<std::unique_ptr<ViewportRelighter>>();
    if (!relighter && request.relightOn == RelightOn::Gpu)
        return fail("--relight: " + relighter.error().message);
    if (!relighter)
        logWarning(fmt::format("relighting on the CPU: {}", relighter.error().message));
    if (!relighter || !*relighter) {
        const CpuLight light = request.relight();
        viewport.setIndirect(light.field);
        result.relightDevice = "cpu";
        result.relight = light.stats;
        return {};
    }
    result.relight = (*relighter)->relight(viewport, scene, request.bake->settings.maxBounces, {});
    result.relightDevice = device.properties.deviceName;
    return {};
}

Result<RenderedImage> renderOnGpu(const Scene& scene, const RenderRequest& request) {
    const auto device = gpu::createDevice({.name = request.device});
    if (!device)
        return fail("--device: " + device.error().message);
    const std::uint32_t limit = (*device)->properties.limits.maxImageDimension2D;
    if (std::max(request.width, request.height) > limit)
        return fail(fmt::format("--width, --height: {} draws at most {} pixels a side",
                                (*device)->properties.deviceName, limit));
    Viewport viewport(**device);
    RenderedImage result;
    if (request.bake) // the layout lives as long as the bake
        viewport.setScene(scene, {request.bake, &request.bake->lightmap});
    else
        viewport.setScene(scene, nullptr);
    if (const auto lit = relight(**device, viewport, scene, request, result); !lit)
        return tl::make_unexpected(lit.error());
    viewport.setOverlay(request.overlay);
    ViewportOptions options;
    options.view = request.view;
    options.camera = request.camera;
    options.width = request.width;
    options.height = request.height;
    options.tonemap = request.tonemap;
    options.exposureEv = request.exposureEv;
    viewport.render(options);
    result.device = (*device)->properties.deviceName;
    result.linear = viewport.readLinear();
    if (request.tonemapped)
        result.picture = viewport.readTonemapped();
    return result;
}

} // namespace limn
