// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/overlay_source.h"

namespace limn {

/// Copy of a technique's light for its overlays. Each technique that has overlays of light derives
/// its own and is the only one to look inside. Where a technique precomputes nothing, its overlays
/// are made of this alone.
class LightSnapshot : public OverlaySource {};

} // namespace limn
