// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace limn {

// Names of the values of the document's enumerations in files and flags, in their order.

inline constexpr std::array<std::string_view, 3> kWrapNames = {"repeat", "clamp", "mirror"};
inline constexpr std::array<std::string_view, 3> kAlphaNames = {"opaque", "mask", "blend"};
inline constexpr std::array<std::string_view, 4> kLightNames = {"directional", "point", "spot",
                                                                "rectangle"};
inline constexpr std::array<std::string_view, 3> kSkyNames = {"color", "gradient", "image"};

} // namespace limn
