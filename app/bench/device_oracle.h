// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/stress/oracle.h"

#include <cstdint>
#include <string>

namespace limn {

/// The Vulkan device relights as the CPU does. Judges one seed in `share`, none where that is 0 or
/// there is no device. `device`: part of its name; empty: the best.
Oracle deviceOracle(const std::string& device, std::uint32_t share);

} // namespace limn
