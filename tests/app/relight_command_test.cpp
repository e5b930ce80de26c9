// SPDX-License-Identifier: MIT
// `limn render --relight`: where bounced light of techniques other than the paper's is worked out.
#include "tests/app/command_line.h"

namespace {

TEST_F(CommandLine, RenderLightsAnyTechniqueOnEitherDevice) {
    const std::string cpu = path("cpu.exr"), gpu = path("gpu.exr");
    const std::string start = "render cornell --light 'point pos=0,1,0.5 cd=1' --width 48 --height "
                              "32 --view irradiance --json --technique ";
    for (const std::string technique :
         {"lpv", "probes --set probes.count=64 --set probes.side=24", "sparse-probes"}) {
        const nlohmann::json onCpu = json(start + technique + " --relight cpu -o " + cpu),
                             onGpu = json(start + technique + " --relight gpu -o " + gpu);
        EXPECT_EQ(onCpu["relight"]["device"], "cpu") << technique;
        EXPECT_EQ(onGpu["relight"]["device"], onGpu["device"]) << technique;
        EXPECT_GT(onGpu["relight"]["dispatches"], 0) << technique;
        // Nothing but rays and rasterised maps differs, at the edges of triangles.
        EXPECT_LT(json("compare " + gpu + " " + cpu + " --json")["nrmse"], 0.01) << technique;
    }
    EXPECT_EQ(json(start + "lpv --relight auto -o " + gpu)["relight"]["device"], "cpu");
    expectRefusal(start + "ambient --relight gpu -o " + gpu, "on the CPU only");
}

} // namespace
