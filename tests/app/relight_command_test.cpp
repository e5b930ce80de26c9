// SPDX-License-Identifier: MIT
// `limn render`: where bounced light of techniques other than the paper's is computed, and how many
// samples a pixel has.
#include "tests/app/command_line.h"

namespace limn::relight_command_test {
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

TEST_F(CommandLine, RenderTakesSeveralSamplesOfAPixelOnEitherDevice) {
    const std::string start = "render cornell --view albedo --width 64 --height 64 --json ";
    const std::string truth = path("truth.exr"), one = path("one.exr"), many = path("many.exr");
    EXPECT_EQ(json(start + "--device cpu --spp 256 -o " + truth)["samples_per_pixel"], 256);
    EXPECT_EQ(json(start + "--spp 1 -o " + one)["samples_per_pixel"], 1);
    EXPECT_EQ(json(start + "-o " + many)["samples_per_pixel"], 16);
    const auto error = [&](const std::string& image) {
        return json("compare " + image + " " + truth + " --json")["nrmse"].get<double>();
    };
    EXPECT_LT(error(many), 0.3 * error(one));
}

} // namespace
} // namespace limn::relight_command_test
