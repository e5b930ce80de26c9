// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace limn {

// Names of the values of the bake settings' enumerations, in their order: identifiers for files and
// the command line, labels for the user interface.

inline constexpr std::array<std::string_view, 3> kPlacementNames = {"relaxed", "halton", "random"};
inline constexpr std::array<const char*, 3> kPlacementLabels = {"Relaxed", "Halton", "Random"};
inline constexpr std::array<std::string_view, 2> kLinkerNames = {"gather", "form-factor"};
inline constexpr std::array<const char*, 2> kLinkerLabels = {"Gather", "Form factor"};
inline constexpr std::array<std::string_view, 2> kCutNames = {"detail", "solid-angle"};
inline constexpr std::array<const char*, 2> kCutLabels = {"Detail", "Solid angle"};
inline constexpr std::array<std::string_view, 2> kStorageNames = {"rtp", "sh"};
inline constexpr std::array<const char*, 2> kStorageLabels = {"Cones (RTP)", "SH"};
inline constexpr std::array<std::string_view, 2> kClusteringNames = {"agglomerative", "kd"};
inline constexpr std::array<const char*, 2> kClusteringLabels = {"Agglomerative", "Kd-tree"};

} // namespace limn
