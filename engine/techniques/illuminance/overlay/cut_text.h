// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/overlay_kind.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <vector>

namespace limn {

/// Describes a cache and its strongest senders, or, of an invalid cache, those that it is filled
/// from. `scene` is the one that was baked. Precondition: `cache` < the bake's number of caches.
std::vector<OverlayLine> describeCut(const Bake& bake, const Scene& scene, std::uint32_t cache);

} // namespace limn
