// SPDX-License-Identifier: MIT
#include "app/commands/render_image.h"

#include "app/commands/progress_line.h"
#include "engine/core/log.h"
#include "engine/gpu/device.h"
#include "engine/picture/final_gather.h"
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

    const IndirectField* cpuField = nullptr; ///< of this picture, where the light is the CPU's
};

/// Gathers for one picture, from a field that it may own.
struct Gathering {
    FieldRenderOptions options;
    IndirectField onDevice;
    TraceScene trace;
    FinalGather gather;

    Gathering(const GpuDrawing& drawing, const Scene& scene, const RenderRequest& request,
              FieldRenderOptions fieldOptions)
        : options(std::move(fieldOptions)),
          onDevice(drawing.lighting ? drawing.lighting->readField() : IndirectField()),
          trace(scene),
          gather(trace, drawing.lighting ? onDevice : *drawing.cpuField, *request.layout, options) {
    }
};

/// Gathers from the light that `drawing` shows. Null where the picture is not to be gathered.
std::unique_ptr<const Gathering> gatheringOf(const GpuDrawing& drawing, const Scene& scene,
                                             const RenderRequest& request) {
    FieldRenderOptions options = fieldOptions(request);
    if (options.gatherRays > 0 && request.relight)
        options.emitted = drawing.lighting  ? drawing.lighting->emittedField(scene)
                          : request.emitted ? request.emitted()
                                            : nullptr;
    if (!options.emitted)
        return nullptr;
    auto gathering = std::make_unique<const Gathering>(drawing, scene, request, std::move(options));
    return gathering->gather.any() ? std::move(gathering) : nullptr;
}

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
        showLight(request.technique, *device, viewport, light.field);
        cpuField = &light.field;
        result.relightDevice = "cpu";
        result.relight = light.report;
        return {};
    }
    const Viewpoint view = viewpointOf(request.camera, {request.width, request.height});
    result.relight =
        lighting->update({.scene = scene,
                          .bounces = scene.relight.maxBounces,
                          .view = request.lightAll ? viewForAll(*lighting, view) : &view},
                         {});
    result.relightDevice = device->properties.deviceName;
    return {};
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
    // The viewport fades its picture beneath what is drawn over it, so nothing can be added later.
    const bool drawnOver = request.overlay || request.inspection != Inspection::None;
    const auto gathering = drawnOver ? nullptr : gatheringOf(*this, scene, request);
    ViewportOptions options;
    options.view = request.view;
    options.camera = request.camera;
    options.width = request.width;
    options.height = request.height;
    options.diffuse = !gathering;
    options.nearRays = gathering ? 0 : request.nearRays;
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
    if (gathering) {
        gathering->gather.addTo(result.linear, progress);
        endProgressLine();
    }
    if (request.tonemapped)
        result.picture =
            gathering ? toneMappedAs(request, result.linear) : viewport.readTonemapped();
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
