// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_settings.h"

#include <string>

namespace limn {

/// Which of the settings is out of its range, in words; empty: none.
std::string settingsDefect(const BakeSettings& settings);

} // namespace limn
