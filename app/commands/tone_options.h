// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "engine/scene/view.h"

#include <string>

namespace limn {

/// --exposure and --tonemap, for pictures of files that cannot hold linear light.
struct ToneOptions {
    float exposureEv = 0; ///< [EV]
    std::string tonemap = "aces";
};
void addToneOptions(Command& command, ToneOptions& options);

/// The curve that the options name.
Tonemap tonemapOf(const ToneOptions& options);

} // namespace limn
