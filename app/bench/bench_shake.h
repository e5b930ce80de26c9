// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/bench_bakes.h"

#include <cstdint>
#include <string>

namespace limn {

/// Baked scenes that change by chance under Vulkan validation.
struct ShakeBench {
    BenchBakes bakes;
    CameraOptions camera;
    std::string output, device;
    double seconds = 60, growthMiB = 64;
    std::uint64_t frames = 1; ///< at least
    std::uint32_t seed = 1;
    bool json = false;
};

/// With its defaults; but for scenes, the folder, the device and --json.
void addShakeOptions(CLI::App& command, ShakeBench& options);

Exit runShakeBench(const ShakeBench& options);

} // namespace limn
