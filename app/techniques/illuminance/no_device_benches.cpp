// SPDX-License-Identifier: MIT
// What a program that is linked without Vulkan has in place of the benchmarks of the device.
#include "app/techniques/illuminance/bench_relight_gpu.h"
#include "app/techniques/illuminance/bench_shake.h"
#include "app/techniques/illuminance/device_oracle.h"
#include "app/techniques/illuminance/frame_times.h"
#include "app/techniques/illuminance/illuminance_program.h"

namespace limn {

static constexpr const char* kNoVulkan = "this program was built without Vulkan";

void addFrameBench(Command& /*bench*/) {}
void addShakeOptions(Command& /*command*/, ShakeBench& /*options*/) {}

Exit runShakeBench(const ShakeBench& /*options*/) {
    return failed(kNoVulkan);
}

Oracle deviceOracle(const std::string& /*device*/, std::uint32_t /*share*/) {
    return {"device", "The device relights as the CPU does.",
            [](const Subject&) { return notJudged(); }};
}

Result<GpuRuns> relightOnGpu(const std::string& /*device*/, const TraceScene& /*trace*/,
                             const std::shared_ptr<const Bake>& /*bake*/, LitBands /*wanted*/,
                             std::uint32_t /*bounces*/, int /*runs*/,
                             const std::function<Scene(int k)>& /*sceneAt*/) {
    return fail(kNoVulkan);
}

Result<DrawnFrames> drawFrames(const FrameOptions& /*options*/, const TraceScene& /*trace*/,
                               const std::shared_ptr<const Bake>& /*bake*/, int /*runs*/,
                               const std::function<FrameScene(int k)>& /*sceneAt*/) {
    return fail(kNoVulkan);
}

} // namespace limn
