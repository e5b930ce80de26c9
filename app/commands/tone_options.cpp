// SPDX-License-Identifier: MIT
#include "app/commands/tone_options.h"

#include <algorithm>

namespace limn {

void addToneOptions(Command& command, ToneOptions& options) {
    command.option("--exposure", options.exposureEv, "Exposure before tone mapping [EV]")
        .within(-64.0, 64.0);
    command.option("--tonemap", options.tonemap, "Tone-mapping curve of a .png")
        .oneOf(namesIn(kTonemapNames));
}

Tonemap tonemapOf(const ToneOptions& options) {
    return Tonemap(std::ranges::find(kTonemapNames, options.tonemap) - kTonemapNames.begin());
}

} // namespace limn
