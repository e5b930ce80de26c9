// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace limn {

/// Device on which bounced light is computed.
enum class RelightOn { Auto, Cpu, Gpu };
inline constexpr std::array<std::string_view, 3> kRelightOnNames = {"auto", "cpu", "gpu"};

/// Measured time of one update of one bounce on this machine, with every light moved [ms].
struct RelightTimes {
    double cpuMs = 0, gpuMs = 0; ///< finite, > 0
    bool operator==(const RelightTimes&) const = default;
};

/// Returns Cpu or Gpu: the one asked for where a GPU can light the scene, else Cpu. Auto gives the
/// faster one, and Cpu where both take the same or neither was measured.
RelightOn chooseRelight(RelightOn wanted, bool gpuCan, const std::optional<RelightTimes>& times);

/// Key under which times are stored: the Vulkan device, its driver, this machine's threads and
/// sizeClassOf() of what is lit, since times do not carry over to other sizes.
std::string relightTimesKey(const std::string& device, std::uint32_t driverVersion,
                            std::string_view sizeClass);

/// The times stored in the file under `key`; std::nullopt where there are none, or where the file
/// is missing, damaged or of another version.
std::optional<RelightTimes> rememberedRelightTimes(const std::string& file, const std::string& key);

/// Stores times in the file under `key` beside those of other keys. Replaces a damaged file.
Result<void> rememberRelightTimes(const std::string& file, const std::string& key,
                                  const RelightTimes& times);

/// Path of relight.json beside defaultStageFolder(); empty where that is empty.
std::string defaultRelightTimesFile();

} // namespace limn
