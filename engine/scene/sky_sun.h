// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"
#include "engine/scene/sky.h"

#include <optional>
#include <string_view>

namespace limn {

/// Ends the name of a panorama without its sun, which stands for other pixels than its file's.
inline constexpr std::string_view kWithoutSun = "#without-sun";

/// Cuts the sun out of a panorama and returns it as a directional light: what is brighter within a
/// few degrees of the brightest direction than the ring around it, whose mean takes its place. The
/// light's irradiance on a plane that faces it is that of what was cut out. A bake's cells of the
/// sky are ten degrees wide and blur the shadows of such a sun; the light's are sharp. Returns
/// std::nullopt, and changes nothing, where the sky shows no panorama or no sun: nothing so small
/// that brings a twentieth of its light. The panorama's name then ends with kWithoutSun.
std::optional<Light> extractSun(Sky& sky);

} // namespace limn
