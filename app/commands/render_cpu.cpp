// SPDX-License-Identifier: MIT
#include "app/commands/progress_line.h"
#include "app/commands/render_image.h"

#include "engine/measure/field_render.h"
#include "engine/scene/tone_map.h"

namespace limn {

RenderedImage renderOnCpu(const Scene& scene, const RenderRequest& request) {
    FieldRenderOptions options;
    options.view = request.view;
    options.camera = request.camera;
    options.width = request.width;
    options.height = request.height;
    options.samplesPerPixel = request.samplesPerPixel;
    options.nearRays = request.nearRays;
    static const IndirectField noField;
    static const LightmapLayout noLayout;
    RenderedImage result;
    result.device = "cpu";
    const IndirectField* field = &noField;
    if (request.relight) {
        const CpuLight light = request.relight(request.view == View::Lit);
        field = &light.field;
        result.relightDevice = "cpu";
        result.relight = light.report;
    }
    MarchedCounts marched;
    options.marched = &marched;
    result.linear =
        renderField(TraceScene(scene), *field, request.layout ? *request.layout : noLayout, options,
                    progressOnStderr());
    endProgressLine();
    result.marchedRays = marched.rays;
    result.unknownRays = marched.unknown;
    if (!request.tonemapped)
        return result;
    const bool data = request.view == View::Albedo || request.view == View::Normals;
    result.picture = toneMappedImage(result.linear, data ? Tonemap::None : request.tonemap,
                                     data ? 0 : request.exposureEv); // as the viewport shows data
    return result;
}

} // namespace limn
