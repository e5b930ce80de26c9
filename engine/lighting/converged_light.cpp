// SPDX-License-Identifier: MIT
#include "engine/lighting/converged_light.h"

#include "engine/lightmap/atlas.h"

#include <utility>

namespace limn {

Result<ConvergedLight> convergeLight(std::shared_ptr<const Scene> scene,
                                     std::shared_ptr<const TraceScene> trace,
                                     const Technique& technique, Prepared prepared, LitFor reader,
                                     const Progress& progress, const Viewpoint* view) {
    ConvergedLight lit{.scene = std::move(scene),
                       .trace = std::move(trace),
                       .prepared = std::move(prepared),
                       .lighting = nullptr};
    const auto& data = lit.prepared.data;
    if (data)
        lit.layout = {data, &data->layout()}; // lives as long as the data
    else
        lit.layout = std::make_shared<const LightmapLayout>(layoutWithoutLightmap(*lit.scene));
    lit.lighting = technique.light(lit.prepared);
    lit.report = lit.lighting->update({.scene = *lit.scene,
                                       .trace = lit.trace.get(),
                                       .bounces = lit.scene->relight.maxBounces,
                                       .view = view ? viewForAll(*lit.lighting, *view) : nullptr,
                                       .unread = true,
                                       .reflections = reader == LitFor::Pictures},
                                      progress);
    if (progress.cancelled())
        return fail("cancelled");
    return lit;
}

} // namespace limn
