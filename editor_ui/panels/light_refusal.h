// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

struct BakeStatus;

/// Why the light cannot be exported, explained or solved for now; empty: it can.
std::string lightRefusal(const BakeStatus& bake);

} // namespace limn
