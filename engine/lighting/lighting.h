// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/field/field_reading.h"
#include "engine/field/indirect_field.h"
#include "engine/lighting/explanation.h"
#include "engine/lighting/light_snapshot.h"
#include "engine/lighting/lighting_report.h"
#include "engine/scene/camera.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <memory>

namespace limn {

/// Inputs of an update of bounced light.
struct LightingInput {
    const Scene& scene;
    const TraceScene* trace = nullptr; ///< of `scene`, for shadow rays; null on a device
    std::uint32_t bounces = 2;         ///< maximum number of bounces this update adds
    /// Light must be up to date where this view shows it and may be older elsewhere; null:
    /// everywhere.
    const Viewpoint* view = nullptr;
    /// Light also what nothing in the scene looks up, such as a grid without dynamic objects.
    bool unread = false;
    /// Also provide the part of the field that FieldPart::reflects(), if the technique has one and
    /// the scene has a glossy receiver: for pictures of renderField() or the viewport. A device
    /// decides by itself.
    bool reflections = false;
};

/// Bounced light of a scene by one technique on one device. Not thread-safe.
class Lighting {
public:
    virtual ~Lighting() = default;

    /// Updates the light to the lights, materials, sky and dynamic objects of input.scene. A
    /// cancelled update leaves valid light. With 0 bounces, it only completes what earlier updates
    /// left out.
    virtual LightingReport update(const LightingInput& input, const Progress& progress) = 0;

    /// Uses idle time, once the light of `input` is converged everywhere: finds the light of one of
    /// the scene's sources alone, or a part of it, so that changes of its colour and strength need
    /// no bounce. Leaves the light as it is. Returns false when nothing is left to find.
    virtual bool solveSources(const LightingInput& /*input*/, const Progress& /*progress*/) {
        return false;
    }

    /// The light on the CPU, valid until the next update; null if it exists on the device only.
    virtual const IndirectField* field() const = 0;

    /// A copy of the light from wherever it exists. Waits for a device. Precondition: there has
    /// been an update.
    virtual IndirectField readField() const { return *field(); }

    /// The emitted light in field(): the part that arrives from the sky and emissive surfaces of
    /// `scene`, the scene of the last update, without a bounce. It is on the CPU wherever the light
    /// exists. Final gathering treats it apart from the rest. Null if the technique cannot tell it
    /// from that.
    virtual std::shared_ptr<const IndirectField> emittedField(const Scene& /*scene*/) const {
        return nullptr;
    }

    /// Whether light holds only where the view of the last update shows it, such as light kept for
    /// pixels. Another view is then a change of the light, and nothing is lit beyond it. An update
    /// without a view lights everything.
    virtual bool isOfView() const { return false; }

    /// A copy of the light for the technique's overlays of light; null if it has none.
    virtual std::shared_ptr<const LightSnapshot> snapshot() const { return nullptr; }

    /// Says where a reading of field() comes from. `scene` is that of the last update, which lit
    /// everything that is read. Returns no rows where field() is null.
    virtual Explanation explain(const Scene& /*scene*/, const FieldReading& /*reading*/,
                                const ExplainOptions& /*options*/) const {
        return {};
    }
};

/// LightingInput::view for light that is to be up to date everywhere, which light of a view is for
/// that view alone.
inline const Viewpoint* viewForAll(const Lighting& lighting, const Viewpoint& view) {
    return lighting.isOfView() ? &view : nullptr;
}

} // namespace limn
