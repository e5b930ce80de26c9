// SPDX-License-Identifier: MIT
#pragma once

#include "app/techniques/illuminance/bench_bakes.h"

#include <cstdint>
#include <string>

namespace limn {

/// Options of the run that changes baked scenes at random under Vulkan validation.
struct ShakeBench {
    BenchBakes bakes;
    CameraOptions camera;
    std::string output, device;
    double seconds = 60, growthMiB = 64;
    std::uint64_t frames = 1; ///< at least
    std::uint32_t seed = 1;
    bool json = false;
};

/// Adds the options with their defaults, except for scenes, output folder, device and --json.
void addShakeOptions(Command& command, ShakeBench& options);

Exit runShakeBench(const ShakeBench& options);

} // namespace limn
