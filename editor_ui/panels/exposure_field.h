// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

struct ViewState;

/// The exposure in EV, and an arrow that opens the rest: tone mapping, automatic exposure, EV100,
/// and the shutter time, aperture and sensitivity of a camera. `width` pixels wide. Draws into the
/// current window.
void exposureField(ViewState& view, float width);

/// "1/125 s", "2.5 s"
std::string shutterText(float seconds);

} // namespace limn
