// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/lighting/technique.h"

#include <cstdint>
#include <memory>

namespace limn {

/// A scene lit to convergence on the CPU.
struct ConvergedLight {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const TraceScene> trace; ///< of `scene`
    Prepared prepared;                       ///< by the technique, where it precomputes
    std::shared_ptr<const LightmapLayout> layout;
    std::unique_ptr<Lighting> lighting;
    LightingReport report;

    const IndirectField& field() const { return *lighting->field(); }
};

/// Who reads converged light.
enum class LitFor : std::uint8_t {
    Pictures, ///< what renderField() draws: with reflections
    Export    ///< a field of harmonics
};

/// Lights `scene` until bounces change next to nothing, at most its maxBounces, and the grid too
/// where nothing in the scene reads it. `prepared` holds what `technique` precomputed for it, and
/// nothing where it precomputes nothing. `view`: where light of a view is to hold; null: it lights
/// everything. Fails when cancelled.
Result<ConvergedLight> convergeLight(std::shared_ptr<const Scene> scene,
                                     std::shared_ptr<const TraceScene> trace,
                                     const Technique& technique, Prepared prepared, LitFor reader,
                                     const Progress& progress, const Viewpoint* view = nullptr);

} // namespace limn
