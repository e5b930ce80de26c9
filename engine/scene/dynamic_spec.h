// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/document.h"

#include <string_view>

namespace limn {

/// `NAME` or `NAME@x,y,z`: makes the nodes of that name dynamic, with all below them, and moves
/// them by x,y,z [m] in their parent's space. Fails where there is no such node.
Result<void> makeDynamic(Document& document, std::string_view spec);

} // namespace limn
