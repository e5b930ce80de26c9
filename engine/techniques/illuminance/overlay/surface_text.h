// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/overlay_kind.h"
#include "engine/techniques/illuminance/overlay/overlay.h"
#include "engine/trace/trace_scene.h"

#include <vector>

namespace limn {

/// The numbers that an overlay shows in colours at a point of a surface: of the nearest surfel on
/// this side of the object, of the cache that is read there, or of the texel. `hit` as for
/// cacheAt(). Without `lit`, amounts of light are left out. O(surfels).
std::vector<OverlayLine> describeSurface(const Bake& bake, const Scene& scene,
                                         const OverlayOptions& options, const Hit& hit,
                                         const LitBake* lit);

} // namespace limn
