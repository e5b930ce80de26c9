// SPDX-License-Identifier: MIT
#include "app/commands/render_image.h"

#include "app/commands/progress_line.h"
#include "engine/core/log.h"
#include "engine/gpu/device.h"
#include "engine/measure/final_gather.h"
#include "engine/techniques/device/device_table.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn {

// Nothing is measured for a single picture, because that would take longer than relighting it on
// either device.
static RelightOn choose(const gpu::Device& device, const RenderRequest& request) {
    const VkPhysicalDeviceProperties& p = device.properties;
    return chooseRelight(
        request.relightOn, true,
        rememberedRelightTimes(
            defaultRelightTimesFile(),
            relightTimesKey(p.deviceName, p.driverVersion,
                            sizeClassOf(*request.technique, request.prepared.data.get()))));
}

namespace {

/// A device and what it keeps between pictures.
struct GpuDrawing {
    std::unique_ptr<gpu::Device> device;
    Viewport viewport;
    std::unique_ptr<Lighting> lighting; ///< null: bounced light is the CPU's
    bool chosen = false;                ///< which of the two

    explicit GpuDrawing(std::unique_ptr<gpu::Device> on)
        : device(std::move(on)), viewport(*device) {}

    Result<void> chooseLighting(const RenderRequest& request);
    Result<void> relight(const Scene& scene, const RenderRequest& request, RenderedImage& result);
    Result<RenderedImage> draw(const Scene& scene, const RenderRequest& request);
    /// Returns false where there is nothing to add.
    bool addGathered(const Scene& scene, const RenderRequest& request, ImageF& linear) const;

    const IndirectField* cpuField = nullptr; ///< of this picture, where the light is the CPU's
};

Result<void> GpuDrawing::chooseLighting(const RenderRequest& request) {
    chosen = true;
    if (choose(*device, request) == RelightOn::Cpu)
        return {};
    auto made = lightOnDevice(*request.technique, *device, viewport, request.prepared);
    if (made)
        lighting = std::move(*made);
    else if (request.relightOn == RelightOn::Gpu)
        return fail("--relight: " + made.error().message);
    else
        logWarning(fmt::format("relighting on the CPU: {}", made.error().message));
    return {};
}

// Bounces until nothing changes, as on the CPU.
Result<void> GpuDrawing::relight(const Scene& scene, const RenderRequest& request,
                                 RenderedImage& result) {
    if (!request.relight)
        return {};
    if (!chosen && request.technique)
        if (const Result<void> done = chooseLighting(request); !done)
            return done;
    if (!lighting) {
        const CpuLight light = request.relight(request.view == View::Lit);
        viewport.setIndirect(light.field);
        cpuField = &light.field;
        result.relightDevice = "cpu";
        result.relight = light.report;
        return {};
    }
    const Viewpoint view{request.camera, float(request.width) / float(request.height)};
    result.relight = lighting->update({.scene = scene,
                                       .bounces = scene.relight.maxBounces,
                                       .view = request.lightAll ? nullptr : &view},
                                      {});
    result.relightDevice = device->properties.deviceName;
    return {};
}

bool GpuDrawing::addGathered(const Scene& scene, const RenderRequest& request,
                             ImageF& linear) const {
    FieldRenderOptions options = fieldOptions(request);
    if (options.gatherRays > 0 && request.relight)
        options.straight = lighting           ? lighting->straightField(scene)
                           : request.straight ? request.straight()
                                              : nullptr;
    if (!options.straight)
        return false;
    const IndirectField onDevice = lighting ? lighting->readField() : IndirectField();
    const TraceScene trace(scene);
    const FinalGather gather(trace, lighting ? onDevice : *cpuField, *request.layout, options);
    if (!gather.any())
        return false;
    gather.addTo(linear, progressOnStderr());
    endProgressLine();
    return true;
}

Result<RenderedImage> GpuDrawing::draw(const Scene& scene, const RenderRequest& request) {
    const VkPhysicalDeviceProperties& properties = device->properties;
    const std::uint32_t limit = properties.limits.maxImageDimension2D;
    if (std::max(request.width, request.height) > limit)
        return fail(fmt::format("--width, --height: {} draws at most {} pixels a side",
                                properties.deviceName, limit));
    RenderedImage result;
    viewport.setScene(scene, request.layout);
    if (const auto lit = relight(scene, request, result); !lit)
        return tl::make_unexpected(lit.error());
    viewport.setOverlay(request.overlay);
    ViewportOptions options;
    options.view = request.view;
    options.camera = request.camera;
    options.width = request.width;
    options.height = request.height;
    options.nearRays = request.nearRays;
    options.tonemap = request.tonemap;
    options.exposureEv = request.exposureEv;
    options.inspection = request.inspection;
    const Progress progress = progressOnStderr();
    progress.at("samples", 0);
    viewport.render(options);
    for (std::uint32_t n = 1; n < request.samplesPerPixel; ++n) {
        progress.at("samples", float(n) / float(request.samplesPerPixel));
        viewport.refine();
    }
    endProgressLine();
    result.device = properties.deviceName;
    result.linear = viewport.readLinear();
    const bool added = addGathered(scene, request, result.linear);
    // The viewport fades its picture beneath an overlay, and does not know of the light added.
    const bool drawnOver = request.overlay || request.inspection != Inspection::None;
    if (request.tonemapped)
        result.picture =
            added && !drawnOver ? toneMappedAs(request, result.linear) : viewport.readTonemapped();
    return result;
}

} // namespace

Result<DrawPicture> drawingOnGpu(const std::string& device) {
    auto made = gpu::createDevice({.name = device});
    if (!made)
        return fail("--device: " + made.error().message);
    return [drawing = std::make_shared<GpuDrawing>(std::move(*made))](
               const Scene& scene, const RenderRequest& request) {
        return drawing->draw(scene, request);
    };
}

} // namespace limn
