// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/light_place.h"

namespace limn {

/// Lights on the Vulkan device whose name contains `name`, which is the best one where that is
/// empty, each light with a viewport of its own. Reports of its light count the memory that the
/// device has allocated for that light, and none of the viewport's geometry, textures and shadow
/// maps. Times include shadow maps, but not those of the first update. Fails if there is no such
/// device.
Result<LightPlace> placeOnDevice(const std::string& name);

} // namespace limn
