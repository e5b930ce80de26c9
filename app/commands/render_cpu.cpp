// SPDX-License-Identifier: MIT
#include "app/commands/progress_line.h"
#include "app/commands/render_image.h"

#include "engine/picture/field_render.h"
#include "engine/scene/tone_map.h"

namespace limn {

FieldRenderOptions fieldOptions(const RenderRequest& request) {
    FieldRenderOptions options;
    options.view = request.view;
    options.camera = request.camera;
    options.width = request.width;
    options.height = request.height;
    options.samplesPerPixel = request.samplesPerPixel;
    options.nearRays = request.nearRays;
    options.gatherRays = request.gatherRays;
    return options;
}

Image toneMappedAs(const RenderRequest& request, const ImageF& linear) {
    const bool data = request.view == View::Albedo || request.view == View::Normals;
    return toneMappedImage(linear, data ? Tonemap::None : request.tonemap,
                           data ? 0 : request.exposureEv); // as the viewport shows data
}

RenderedImage renderOnCpu(const Scene& scene, const RenderRequest& request) {
    FieldRenderOptions options = fieldOptions(request);
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
        if (request.emitted && options.gatherRays > 0)
            options.emitted = request.emitted();
    }
    ReflectionCounts counts;
    options.reflections = &counts;
    result.linear =
        renderField(TraceScene(scene), *field, request.layout ? *request.layout : noLayout, options,
                    progressOnStderr());
    endProgressLine();
    result.reflections = counts.all;
    result.unknownReflections = counts.unknown;
    if (request.tonemapped)
        result.picture = toneMappedAs(request, result.linear);
    return result;
}

} // namespace limn
