// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/transport/occluder_tree.h"
#include "engine/techniques/illuminance/transport/transport_file.h"

#include <string>

namespace limn {

/// The section META: JSON that says what the numbers of the other sections mean and where they
/// come from.
std::string transportMeta(const TransportInput& input, const OccluderTree& occluders,
                          std::uint32_t width, std::uint32_t height);

} // namespace limn
