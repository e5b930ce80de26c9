// SPDX-License-Identifier: MIT
#include "app/bench/light_place.h"

#include "engine/lightmap/atlas.h"

namespace limn {

LightPlace placeOnCpu() {
    return {.device = "cpu",
            .lights = [](const Technique&) { return true; },
            .light = [](const Technique& technique, const Prepared& prepared, const Scene&,
                        const std::shared_ptr<const LightmapLayout>&)
                -> Result<std::unique_ptr<Lighting>> { return technique.light(prepared); }};
}

Result<PreparedScene> prepareScene(const Technique& technique, const TraceScene& trace,
                                   const Scene& scene, const BakeSettings& settings,
                                   const Progress& progress) {
    if (!technique.precomputation)
        return PreparedScene{{},
                             std::make_shared<const LightmapLayout>(layoutWithoutLightmap(scene))};
    const auto made = technique.precomputation->prepare(
        trace, {.settings = &settings, .choice = &scene.technique}, progress);
    if (!made)
        return tl::make_unexpected(made.error());
    return PreparedScene{{*made, std::make_shared<const Scene>(scene)},
                         {*made, &(*made)->layout()}};
}

ImageF renderLight(const TraceScene& trace, const Lighting& lighting, const LightmapLayout& layout,
                   const FieldRenderOptions& options) {
    if (const IndirectField* field = lighting.field())
        return renderField(trace, *field, layout, options);
    return renderField(trace, lighting.readField(), layout, options);
}

} // namespace limn
