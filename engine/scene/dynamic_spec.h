// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/document.h"

#include <string_view>

namespace limn {

/// Parses `NAME` or `NAME@x,y,z`: makes all nodes of that name and their descendants dynamic, and
/// moves the nodes by x,y,z [m] in their parent's space. Fails if there is no such node.
Result<void> makeDynamic(Document& document, std::string_view spec);

} // namespace limn
