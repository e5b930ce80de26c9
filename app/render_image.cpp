// SPDX-License-Identifier: MIT
#include "app/render_image.h"

#include "engine/gpu/device.h"
#include "engine/render/viewport.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn {

Result<RenderedImage> renderOnGpu(const Scene& scene, const RenderRequest& request) {
    const auto device = gpu::createDevice({.name = request.device});
    if (!device)
        return fail("--device: " + device.error().message);
    const std::uint32_t limit = (*device)->properties.limits.maxImageDimension2D;
    if (std::max(request.width, request.height) > limit)
        return fail(fmt::format("--width, --height: {} draws at most {} pixels a side",
                                (*device)->properties.deviceName, limit));
    Viewport viewport(**device);
    viewport.setScene(scene, request.layout);
    if (request.field)
        viewport.setIndirect(*request.field);
    viewport.setOverlay(request.overlay);
    ViewportOptions options;
    options.view = request.view;
    options.camera = request.camera;
    options.width = request.width;
    options.height = request.height;
    options.tonemap = request.tonemap;
    options.exposureEv = request.exposureEv;
    viewport.render(options);
    RenderedImage result;
    result.device = (*device)->properties.deviceName;
    result.linear = viewport.readLinear();
    if (request.tonemapped)
        result.picture = viewport.readTonemapped();
    return result;
}

} // namespace limn
