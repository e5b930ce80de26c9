// SPDX-License-Identifier: MIT
#include "engine/picture/pixel_walk.h"

namespace limn {

PixelWalk pixelWalk(const TraceScene& trace, const IndirectField& field,
                    const LightmapLayout& layout, const FieldRenderOptions& options, PixelSum sum,
                    bool gathers) {
    PixelWalk walk{.trace = trace,
                   .field = field,
                   .layout = layout,
                   .sum = sum,
                   .windowedLobes = options.windowedLobes,
                   .bands = {},
                   .reflecting = reflectingPart(field),
                   .glossy = {},
                   .near = nearLight(trace, field, layout, gathers ? 0 : options.nearRays),
                   .gathers = gathers};
    walk.bands = options.allBands
                     ? std::vector<int>(trace.scene().materials.size(), int(field.bands))
                     : reflectedBands(trace.scene(), field);
    if (walk.reflecting)
        walk.glossy = glossyReceivers(trace.scene());
    return walk;
}

} // namespace limn
