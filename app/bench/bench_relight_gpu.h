// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// What a device took for the runs of a bench.
struct GpuRuns {
    std::string device;
    /// directMs: shadow rays on the CPU and the upload of their light. surfelReadMs is part of
    /// surfelLightMs.
    std::vector<RelightStats> runs;
};

/// Relights `wanted` bands `runs` times, the k-th time as sceneAt(k), whose lights and dynamic
/// objects may lie elsewhere than in the scene of `trace`.
/// `device`: part of the Vulkan device's name; empty: the best. Fails when there is none, or when
/// the bake is too large for it.
Result<GpuRuns> relightOnGpu(const std::string& device, const TraceScene& trace,
                             const std::shared_ptr<const Bake>& bake, LitBands wanted,
                             std::uint32_t bounces, int runs,
                             const std::function<Scene(int k)>& sceneAt);

} // namespace limn
