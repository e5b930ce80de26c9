// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/overlay/overlay.h"

namespace limn {

/// Builds the overlays of the kinds with OverlayKind::showsLight: light sent by surfels and
/// clusters, and light received by caches. Without `lit` it holds only a note that nothing is lit
/// yet.
OverlayData lightOverlay(const Bake& bake, const Scene& scene, const OverlayOptions& options,
                         const LitBake* lit);

} // namespace limn
