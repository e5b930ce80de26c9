// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/techniques/illuminance/bake/bake.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace limn {

/// Where bounced light is worked out.
enum class RelightOn { Auto, Cpu, Gpu };
inline constexpr std::array<std::string_view, 3> kRelightOnNames = {"auto", "cpu", "gpu"};

/// What one update of one bounce took here, with every light moved [ms].
struct RelightTimes {
    double cpuMs = 0, gpuMs = 0; ///< finite, > 0
    bool operator==(const RelightTimes&) const = default;
};

/// Cpu or Gpu: what was asked for where there is a GPU that can light the bake, else Cpu. Auto is
/// the faster one; Cpu until it was measured, and where both take the same.
RelightOn chooseRelight(RelightOn wanted, bool gpuCan, const std::optional<RelightTimes>& times);

/// What times are remembered by: the Vulkan device, its driver, this machine's threads and the
/// power of four that the links' bytes reach. Times of another size say nothing.
std::string relightTimesKey(const std::string& device, std::uint32_t driverVersion,
                            const Bake& bake);

/// The times kept in the file under `key`. A file that is missing, damaged or of another version
/// holds none: they are measured again.
std::optional<RelightTimes> rememberedRelightTimes(const std::string& file, const std::string& key);

/// Keeps them there beside those of other keys; replaces a damaged file.
Result<void> rememberRelightTimes(const std::string& file, const std::string& key,
                                  const RelightTimes& times);

/// relight.json beside defaultStageFolder(); empty where that is.
std::string defaultRelightTimesFile();

} // namespace limn
