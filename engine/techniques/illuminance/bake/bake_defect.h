// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <string>

namespace limn {

/// What keeps a bake from being followed safely, "SURFELS: cache: out of range"; empty: nothing.
/// With its scene, which may be null, also from being lit there. O(bake).
std::string bakeDefect(const Bake& bake, const Scene* scene);

} // namespace limn
