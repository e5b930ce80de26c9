// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/setting_options.h"
#include "engine/scene/relight_settings.h"

namespace limn {

/// Adds flags that replace the document's relight settings. `given` must outlive the command.
void addRelightOptions(Command& command, GivenSettings& given);

/// Applies the options, which were checked by the command line, to `settings`.
void applyRelightOptions(const GivenSettings& given, RelightSettings& settings);

} // namespace limn
