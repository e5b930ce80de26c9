// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/lighting/technique.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/picture/field_render.h"

#include <functional>
#include <memory>
#include <string>

namespace limn {

/// Where bounced light is computed: on the CPU or on a Vulkan device.
struct LightPlace {
    std::string device; ///< "cpu", or the name of the Vulkan device
    /// A Vulkan device. Memory of precomputed data is among the counters of its LightingReport.
    bool onDevice = false;
    bool (*lights)(const Technique& technique);
    /// Creates light of a scene with `layout`, by a technique that lights here. The light is used
    /// like that of the CPU: what a device draws for it follows the scene of each update, outside
    /// of LightingReport::totalMs. It keeps what it needs of the place. Fails if the prepared data
    /// is too large for the device.
    std::function<Result<std::unique_ptr<Lighting>>(const Technique& technique,
                                                    const Prepared& prepared, const Scene& scene,
                                                    std::shared_ptr<const LightmapLayout> layout)>
        light;
};

/// Lights every technique on the CPU.
LightPlace placeOnCpu();

/// What a technique precomputed for a scene, and the layout of its light.
struct PreparedScene {
    Prepared prepared; ///< empty where the technique precomputes nothing
    std::shared_ptr<const LightmapLayout> layout;
};

/// Precomputes what the technique of scene.technique needs. `trace` is of the scene. Fails as
/// Precomputation::prepare().
Result<PreparedScene> prepareScene(const Technique& technique, const TraceScene& trace,
                                   const Scene& scene, const BakeSettings& settings,
                                   const Progress& progress);

/// renderField() of light wherever it exists.
ImageF renderLight(const TraceScene& trace, const Lighting& lighting, const LightmapLayout& layout,
                   const FieldRenderOptions& options);

} // namespace limn
