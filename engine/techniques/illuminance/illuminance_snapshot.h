// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/illuminance/illuminance.h"
#include "engine/techniques/illuminance/overlay/overlay.h"

#include <utility>

namespace limn {

/// The light of a lit bake, copied for overlays.
class IlluminanceSnapshot : public LightSnapshot {
public:
    explicit IlluminanceSnapshot(LitBake litBake) : lit(std::move(litBake)) {}

    const Technique& technique() const override { return kIlluminanceTechnique; }

    const LitBake lit;
};

} // namespace limn
