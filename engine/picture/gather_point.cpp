// SPDX-License-Identifier: MIT
#include "engine/picture/gather_point.h"

#include "engine/lightmap/near_reach.h"

namespace limn {

GatherScene gatherScene(const TraceScene& trace, const IndirectField& field,
                        const IndirectField& emitted, const LightmapLayout& layout,
                        std::uint32_t raysPerSample) {
    std::vector<float> widths = nearReaches(trace.scene(), layout);
    for (float& width : widths)
        width *= 2;
    return {trace,        field, emitted, layout, findEmittedLightSources(trace), std::move(widths),
            raysPerSample};
}

} // namespace limn
