// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <string>

namespace limn {

/// Describes the first defect that makes a bake unsafe to use, "SURFELS: cache: out of range";
/// empty where there is none. With `scene`, which may be null, also checks that the bake fits it.
/// O(bake).
std::string bakeDefect(const Bake& bake, const Scene* scene);

} // namespace limn
