// SPDX-License-Identifier: MIT
// `limn render`: where bounced light of techniques other than the paper's is computed, which caches
// are lit, and how many samples a pixel has.
#include "tests/app/command_line.h"
#include "tests/core/source_path.h"
#include "tests/core/sweep.h"

#include <string>
#include <vector>

namespace limn::relight_command_test {
namespace {

/// Writes a project of Cornell with few texels to `file` and returns `file`.
std::string coarseCornell(const std::string& file) {
    const std::string folder = sourcePath("projects/cornell");
    nlohmann::json project = nlohmann::json::parse(contents(folder + "/cornell.limn"));
    project["scene"] = folder + "/" + std::string(project["scene"]);
    for (nlohmann::json& object : project["objects"])
        if (object.contains("bakeSettings"))
            object["bakeSettings"].update({{"surfels", 256}, {"lightmapCaches", 1000}});
    write(file, project.dump());
    return file;
}

TEST_F(CommandLine, RenderLightsAnyTechniqueOnEitherDevice) {
    const std::string cpu = path("cpu.exr"), gpu = path("gpu.exr");
    const std::string start = "render " + coarseCornell(path("coarse.limn")) +
                              " --light 'point pos=0,1,0.5 cd=1' --width 48 --height "
                              "32 --spp 4 --view irradiance --json --technique ";
    for (const std::string technique : {"lpv", "probes --set probes.count=64 --set probes.side=24",
                                        "sparse-probes", "photon-lattices"}) {
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
    const Outcome drawn = limn(start + "-o " + many);
    EXPECT_EQ(nlohmann::json::parse(drawn.out)["samples_per_pixel"], 64);
    const std::string& told = drawn.err;
    EXPECT_NE(told.find("samples"), std::string::npos) << "how far it is: " << told;
    const auto error = [&](const std::string& image) {
        return json("compare " + image + " " + truth + " --json")["nrmse"].get<double>();
    };
    EXPECT_LT(error(many), 0.15 * error(one));
}

TEST_F(CommandLine, APictureIsTheSameByteByByteWithoutTheCachesItDoesNotLookUp) {
    if (kSanitized)
        GTEST_SKIP() << kSweepSkipped;
    struct View {
        const char *scene, *lens;
    };
    const std::string sponza = sourcePath("../shared/scenes/sponza-crytek/Sponza.gltf");
    std::vector<View> views = {{"cornell", " --eye 0,1,1 --target 0.8,0.4,-0.5 --fov 30"},
                               {"atrium", " --eye 0,1.7,0 --target -3,2,1 --fov 60"}};
    if (fs::exists(sponza))
        views.push_back({sponza.c_str(), " --eye 0,6,4.5 --target -10,6,4"});
    const std::string bake = path("some.limnbake"), few = path("few.exr"), all = path("all.exr");
    for (std::string baked; const View& view : views) {
        if (baked != view.scene)
            json(std::string("bake ") + view.scene + " -o " + bake +
                 " --surfels 3000 --links 32 --rays 64 --lightmap 3000 --bands 4 --json");
        baked = view.scene;
        for (const char* device :
             {"auto --relight cpu", "auto --relight gpu", "cpu --relight cpu"}) {
            if (baked == sponza && device != std::string("auto --relight cpu"))
                continue; // takes long
            const std::string render =
                std::string("render ") + view.scene + view.lens +
                " --light 'sun dir=-0.4,-1,-0.3 lux=20' --bake " + bake + " --device " + device +
                " --near-rays 0 --gather-rays 0 --spp 4 --width 96 --height 60 --json -o ";
            const nlohmann::json with = json(render + few),
                                 without = json(render + all + " --all-caches");
            EXPECT_EQ(without["relight"]["caches_unseen"], 0);
            EXPECT_EQ(with["relight"]["bounces"], without["relight"]["bounces"]);
            EXPECT_GT(with["relight"]["caches_unseen"], 300);
            EXPECT_TRUE(contents(few) == contents(all)) << view.scene << view.lens << device;
        }
    }
}

} // namespace
} // namespace limn::relight_command_test
