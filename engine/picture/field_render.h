// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/view.h"
#include "engine/trace/trace_scene.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace limn {

/// Numbers of reflections that a part of the field was asked for (FieldPart::reflects()), and of
/// those that it does not know.
struct ReflectionCounts {
    std::atomic<std::uint64_t> all = 0, unknown = 0;
};

struct FieldRenderOptions {
    View view = View::Lit;
    Camera camera;
    std::uint32_t width = 1280, height = 720;
    std::uint32_t samplesPerPixel =
        kScreenSamples.perPixel; ///< box filter; Owen-scrambled Sobol points
    std::uint32_t seed = 1;
    /// Number of rays of each sample that look for near surfaces (near_light.h), unless the picture
    /// gathers; 0: light is the field's.
    std::uint32_t nearRays = 0;
    /// The part of the field's light that arrives from the sky and emissive surfaces without a
    /// bounce (Lighting::emittedField()). With it, `gatherRays` rays of each sample gather what is
    /// better than the field's light (final_gather.h); null or 0: light is the field's.
    std::shared_ptr<const IndirectField> emitted;
    std::uint32_t gatherRays = 0;
    ReflectionCounts* reflections = nullptr; ///< counts are added to it; null: nothing is counted
    // Only benchmarks and tests change the following two.
    bool windowedLobes = true; ///< else lobes are cut off after the field's bands, and ring
    bool allBands = false;     ///< reflections use all of the field's bands, needed or not
};

/// Renders on the CPU what real-time lighting shows: direct light with ray-traced shadows, and
/// bounced light from `field`. Surfaces, normals and sides are those of renderReference(), so that
/// the two differ by the field's error only. View::Normals is n / 2 + 1/2. Without a field (no
/// lightmap, no grid) there is no indirect light. Glossy receivers reflect what a part of the
/// field that reflects() finds. `layout` belongs to the field. The result is identical for any
/// number of threads; empty when cancelled.
ImageF renderField(const TraceScene& trace, const IndirectField& field,
                   const LightmapLayout& layout, const FieldRenderOptions& options,
                   const Progress& progress = {});

} // namespace limn
