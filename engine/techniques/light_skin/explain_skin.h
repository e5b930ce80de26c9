// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/explanation.h"
#include "engine/techniques/light_skin/skin_state.h"

namespace limn {

struct FieldReading;

/// Says where a reading of a SkinPart comes from: by light, and by the objects of the virtual
/// lights. Both tables sum to the reading. Proxy lights stay where they are: an object that
/// reflects nothing gives no light, but still draws proxies towards it.
Explanation explainSkin(const SkinState& state, const SkinInputs& inputs, const Scene& scene,
                        const FieldReading& reading, const ExplainOptions& options);

} // namespace limn
