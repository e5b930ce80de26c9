// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace limn {

// Names of the values of the export settings' enumerations, in their order: identifiers for files
// and the command line, labels for the user interface.

inline constexpr std::array<std::string_view, 2> kLightmapQualityNames = {"final", "draft"};
inline constexpr std::array<const char*, 2> kLightmapQualityLabels = {"Final", "Draft"};
inline constexpr std::array<std::string_view, 4> kTextureEncodingNames = {
    "exr", "ktx2-half", "ktx2-rgb9e5", "ktx2-bc6h"};
inline constexpr std::array<const char*, 4> kTextureEncodingLabels = {
    "EXR", "KTX2, half float", "KTX2, shared exponent", "KTX2, BC6H blocks"};
inline constexpr std::array<std::string_view, 3> kLightmapQuantityNames = {
    "irradiance", "irradiance-over-pi", "radiance"};
inline constexpr std::array<const char*, 3> kLightmapQuantityLabels = {
    "Irradiance E", "Irradiance E / \u03c0", "Radiance \u03c1 E / \u03c0"};
inline constexpr std::array<std::string_view, 2> kShLayersNames = {"array", "volume"};
inline constexpr std::array<const char*, 2> kShLayersLabels = {"Texture array", "3D texture"};

} // namespace limn
