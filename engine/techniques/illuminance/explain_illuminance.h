// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_reading.h"
#include "engine/lighting/explanation.h"
#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/relight/relight.h"

namespace limn {

/// Splits a reading of a relit field. The last bounce goes backwards through the links of the
/// caches that are read, earlier ones through BounceAdjoint. `scene` is that of the last relight(),
/// `reading` of caches that it lit.
Explanation explainIlluminance(const Relighter& relighter, const Scene& scene,
                               const FieldReading& reading, const ExplainOptions& options);

} // namespace limn
