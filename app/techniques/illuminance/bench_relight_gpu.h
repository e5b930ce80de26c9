// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// Statistics of a device over the runs of a benchmark.
struct GpuRuns {
    std::string device;
    /// directMs: shadow rays on the CPU and the upload of their light. surfelReadMs is part of
    /// surfelLightMs.
    std::vector<RelightStats> runs;
};

/// Relights the bands `wanted` `runs` times. Run k lights sceneAt(k), whose lights and dynamic
/// objects may lie elsewhere than in the scene of `trace`. `device` is part of the Vulkan device's
/// name; empty selects the best. Fails if there is no such device or the bake is too large for it.
Result<GpuRuns> relightOnGpu(const std::string& device, const TraceScene& trace,
                             const std::shared_ptr<const Bake>& bake, LitBands wanted,
                             std::uint32_t bounces, int runs,
                             const std::function<Scene(int k)>& sceneAt);

} // namespace limn
