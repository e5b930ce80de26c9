// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/overlay/overlay.h"

namespace limn {

/// The overlays of kinds that showsLight(): what surfels and clusters send, what caches receive.
/// Without `lit`, a note that nothing is lit yet.
OverlayData lightOverlay(const Bake& bake, const OverlayOptions& options, const LitBake* lit);

} // namespace limn
