// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/field/indirect_field.h"
#include "engine/lighting/lighting_report.h"
#include "engine/scene/camera.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>

namespace limn {

/// What an update of bounced light may read.
struct LightingInput {
    const Scene& scene;
    const TraceScene* trace = nullptr; ///< of `scene`, for shadow rays; null where a device lights
    std::uint32_t bounces = 2;         ///< that this update adds at most
    /// Light is needed where this view shows it, and may be older elsewhere; null: everywhere.
    const Viewpoint* view = nullptr;
};

/// The bounced light of a scene by one technique, on one device. One thread uses it.
class Lighting {
public:
    virtual ~Lighting() = default;

    /// Brings the light up to date with the lights, materials, sky and dynamic objects of
    /// input.scene. Cancelled updates leave valid light. With 0 bounces it only completes what
    /// earlier updates left out.
    virtual LightingReport update(const LightingInput& input, const Progress& progress) = 0;

    /// The light on the CPU, valid until the next update; null: it is on the device alone.
    virtual const IndirectField* field() const = 0;
};

} // namespace limn
