// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/stress/oracle.h"

#include <cstdint>
#include <string>

namespace limn {

/// Oracle that checks that the Vulkan device relights as the CPU does. It judges one seed in
/// `share`, and none if `share` is 0 or there is no device. `device` is part of its name; empty
/// selects the best.
Oracle deviceOracle(const std::string& device, std::uint32_t share);

} // namespace limn
