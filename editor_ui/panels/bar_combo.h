// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

/// ImGui::BeginCombo() for the bar above the picture: `shown` is elided where it does not fit
/// `width` [px], and the tooltip of the closed list then begins with all of it.
bool beginBarCombo(const char* id, const std::string& shown, const char* tooltip, float width);

} // namespace limn
