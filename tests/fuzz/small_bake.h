// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_settings.h"

namespace limn {

/// Nearly the least counts a bake can have, so that the fuzzer tries many.
inline BakeSettings smallBake() {
    BakeSettings settings;
    settings.surfels = 64;
    settings.links = 4;
    settings.rays = 16;
    settings.lightmapCaches = 16;
    settings.grid = {1, 1, 1};
    return settings;
}

} // namespace limn
