// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/bench.h"
#include "engine/scene/bake_settings.h"

#include <cstdint>
#include <string>
#include <vector>

namespace limn {

/// Options of the comparison of generated scenes with references.
struct GeneratedBench {
    std::uint32_t scenes = 0;
    std::uint64_t firstSeed = 0;
    std::uint32_t samplesPerPixel = 512; ///< maximum for a reference
    std::string size = "160x90";
    bool viewport = false; ///< also draw in Vulkan
    std::string device;    ///< for `viewport`; empty: the best
    std::string output;    ///< folder
    bool json = false;
};
void addGeneratedOptions(Command& command, GeneratedBench& options);

/// Writes a row per scene and settings, and the distribution per settings: over all seeds, over
/// even and odd ones, and over each kind of scene.
Exit runGeneratedBench(const GeneratedBench& options, const std::vector<BakeSettings>& settings);

} // namespace limn
