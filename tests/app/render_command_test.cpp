// SPDX-License-Identifier: MIT
// `limn render`: pictures, frames, overlays, and what is occluded.
#include "tests/app/command_line.h"

#include <string>

namespace limn::render_command_test {
namespace {

const std::string kCoarse = " --surfels 256 --links 32 --rays 64 --lightmap 300 --grid 3x3x3 ";

TEST_F(CommandLine, RenderPrintsOneJsonObjectAndWritesThePicture) {
    const std::string bake = path("box.limnbake"), picture = path("box.png"),
                      linear = path("box.exr");
    ASSERT_EQ(limn("bake cornell" + kCoarse + "-o " + bake).exit, 0);
    for (const std::string& output : {picture, linear})
        for (const std::string device : {"auto", "cpu"}) {
            const nlohmann::json rendered =
                json("render cornell --bake " + bake + " --device " + device +
                     " --width 48 --height 32 --spp 4 --json -o " + output);
            expectKeys(rendered, {"seconds", "device", "width", "height", "invalid_pixels"});
            EXPECT_EQ(rendered["width"], 48);
            EXPECT_EQ(rendered["invalid_pixels"], 0);
            EXPECT_GT(fs::file_size(output), 0u);
            if (device == "cpu") {
                EXPECT_EQ(rendered["device"], "cpu");
            }
            fs::remove(output);
        }
    expectRefusal("render cornell --device nowhere -o " + picture, "--device"); // before it bakes
    expectRefusal("render cornell --bake nowhere.limnbake -o " + picture, "nowhere.limnbake");
    expectRefusal("render cornell --bake " + bake + " -o " + path("no/such/box.png"), "box.png");
    expectRefusal("render cornell --bake " + bake + " -o " + path("box.bmp"), "box.bmp");
    EXPECT_EQ(limn("render cornell --width 0 -o " + picture).exit, 2);
    EXPECT_EQ(limn("render cornell --view nonsense -o " + picture).exit, 2);
    EXPECT_EQ(limn("render cornell").exit, 2);
}

TEST_F(CommandLine, RenderWritesTheFramesOfAnAnimationEachAsAPictureOfItsTime) {
    const std::string bake = path("signs.limnbake");
    ASSERT_EQ(limn("bake signs" + kCoarse + "-o " + bake).exit, 0);
    const std::string start = "render signs --bake " + bake + " --width 48 --height 48 --json " +
                              "--near-rays 0 --gather-rays 0 --spp 4 ";
    for (const std::string relight : {"cpu", "gpu"}) {
        const std::string where = "--relight " + relight + " ";
        const nlohmann::json frames = json(start + where + "--time 0.25 --frames 11 --fps 4 -o " +
                                           path("walk.exr"))["frames"];
        ASSERT_EQ(frames.size(), 11u);
        EXPECT_EQ(frames[2]["file"], path("walk-02.exr"));
        EXPECT_DOUBLE_EQ(frames[2]["time"], 0.75);
        EXPECT_EQ(frames[10]["file"], path("walk-10.exr"));
        json(start + where + "--time 0.75 -o " + path("one.exr"));
        const auto error = [&](const std::string& file) {
            return double(
                json("compare " + path(file) + " " + path("one.exr") + " --json")["nrmse"]);
        };
        EXPECT_LT(error("walk-02.exr"), 1e-3); // what bounces leave undone
        EXPECT_GT(error("walk-01.exr"), 0.05);
        EXPECT_GT(error("walk-03.exr"), 0.05);
    }
    expectRefusal("render signs --frames 2 --overlay surfels -o " + path("walk.png"), "--frames");
    EXPECT_EQ(limn("render signs --frames 0 -o " + path("walk.png")).exit, 2);
    EXPECT_EQ(limn("render signs --frames 2 --fps 0 -o " + path("walk.png")).exit, 2);
}

TEST_F(CommandLine, RenderRelightsOnEitherDeviceAndSaysOnWhich) {
    const std::string bake = path("box.limnbake"), cpu = path("cpu.exr"), gpu = path("gpu.exr");
    ASSERT_EQ(limn("bake cornell" + kCoarse + "-o " + bake).exit, 0);
    const std::string start = "render cornell --bake " + bake +
                              " --light 'point pos=0,1,0.5 cd=1' --width 48 --height 32 --spp 4 " +
                              "--near-rays 0 --gather-rays 0 --json ";
    const std::string light = start + "--view irradiance --relight ";
    const nlohmann::json onCpu = json(light + "cpu -o " + cpu),
                         onGpu = json(light + "gpu -o " + gpu);
    for (const nlohmann::json& run : {onCpu, onGpu}) {
        expectKeys(run["relight"], {"device", "ms", "bounces", "converged"});
        EXPECT_GT(run["relight"]["ms"], 0);
        EXPECT_GT(run["relight"]["bounces"], 1);
    }
    EXPECT_EQ(onCpu["relight"]["device"], "cpu");
    EXPECT_EQ(onGpu["relight"]["device"], onGpu["device"]);
    // Nothing but rays and shadow maps differs, at the edges of shadows.
    EXPECT_LT(json("compare " + gpu + " " + cpu + " --json")["nrmse"], 0.02);
    EXPECT_NE(contents(cpu), contents(gpu)) << "both by the same device";
    EXPECT_EQ(json(light + "auto -o " + gpu)["relight"]["device"], "cpu") << "nothing is measured";
    EXPECT_FALSE(json(start + "--view direct --relight gpu -o " + gpu).contains("relight"));
    expectRefusal(start + "--relight gpu --device cpu -o " + gpu, "Vulkan");
    EXPECT_EQ(limn(start + "--relight nonsense -o " + gpu).exit, 2);
}

TEST_F(CommandLine, ADynamicObjectIsBakedOnceAndOccludesTheLightWhereverItIs) {
    const std::string bake = path("box.limnbake"), a = path("a.exr"), b = path("b.exr");
    ASSERT_EQ(limn("bake cornell --dynamic 'Short block'" + kCoarse + "-o " + bake).exit, 0);
    const std::string start = "render cornell --bake " + bake + // rays would see it in any case
                              " --device cpu --view irradiance --gather-rays 0 --width 48 "
                              "--height 32 ";
    ASSERT_EQ(limn(start + "--dynamic 'Short block@0.3,0.7,0.3' -o " + a).exit, 0);
    const std::string moved = start + "--dynamic 'Short block@0.3,0.7,0.3' ";
    ASSERT_EQ(limn(moved + "--dynamic-occlusion false -o " + b).exit, 0);
    EXPECT_GT(json("compare " + a + " " + b + " --json")["nrmse"], 0.05);
    EXPECT_LT(json("compare " + a + " " + b + " --json")["bias"], -0.01);
    ASSERT_EQ(limn(start + "--dynamic 'Short block' -o " + b).exit, 0);
    EXPECT_GT(json("compare " + a + " " + b + " --json")["nrmse"], 0.05);
    expectRefusal(start + "-o " + b, "another scene"); // the block is static here
    const std::string once = path("once.exr"), former = path("former.exr");
    ASSERT_EQ(limn(moved + "--no-dimming -o " + former).exit, 0);
    ASSERT_EQ(limn(moved + "--dynamic-occlusion false -o " + b).exit, 0);
    EXPECT_EQ(contents(former), contents(b)) << "the older flag means the same";
    ASSERT_EQ(limn(moved + "--dynamic-occlusion false --max-bounces 1 -o " + once).exit, 0);
    EXPECT_LT(json("compare " + once + " " + b + " --json")["bias"], -0.05);
    EXPECT_EQ(limn(moved + "--max-bounces 0 -o " + once).exit, 2);
    const auto bouncesAt = [&](const char* tolerance) {
        return double(
            json(moved + "--tolerance " + tolerance + " --json -o " + once)["relight"]["bounces"]);
    };
    EXPECT_LT(bouncesAt("5"), bouncesAt("0.01"));
    expectRefusal(start + "--dynamic Ball -o " + b, "Ball");
    expectRefusal(start + "--dynamic 'Short block@1,2' -o " + b, "x,y,z");
    const std::string onDevice = "render cornell --bake " + bake +
                                 " --view irradiance --near-rays 0 --gather-rays 0 --width 48 "
                                 "--height 32 "
                                 "--dynamic 'Short block@0.3,0.7,0.3' -o ";
    ASSERT_EQ(limn(onDevice + a + " --relight cpu").exit, 0);
    ASSERT_EQ(limn(onDevice + b + " --relight gpu").exit, 0);
    // The room's light is an emitter: nothing but rounding can differ. Four larger bakes differ by
    // 1e-6 to 8e-6.
    EXPECT_LT(json("compare " + b + " " + a + " --json")["nrmse"], 4e-5);
    ASSERT_EQ(limn(onDevice + b + " --relight gpu --no-dimming").exit, 0);
    EXPECT_GT(json("compare " + b + " " + a + " --json")["nrmse"], 0.05);
}

TEST_F(CommandLine, RenderDrawsAnOverlayAndSaysWhatItsColoursMean) {
    const std::string bake = path("box.limnbake"), picture = path("box.png");
    ASSERT_EQ(limn("bake cornell" + kCoarse + "-o " + bake).exit, 0);
    const std::string start =
        "render cornell --bake " + bake + " --view albedo --width 48 --height 32 -o " + picture;
    ASSERT_EQ(limn(start).exit, 0);
    const std::string without = contents(picture);
    for (const std::string overlay :
         {"surfels", "surfel-normals", "surfel-owners", "clusters --overlay-depth 3",
          "links --pick 24,28", "links --cache 5", "caches", "charts", "density", "overlap"}) {
        const nlohmann::json drawn = json(start + " --json --overlay " + overlay);
        expectKeys(drawn["overlay"], {"title", "colors", "notes"});
        EXPECT_NE(contents(picture), without) << overlay;
    }
    EXPECT_FALSE(json(start + " --json").contains("overlay"));
    EXPECT_EQ(contents(picture), without);
    expectRefusal(start + " --overlay links", "--pick");
    expectRefusal(start + " --overlay links --pick 48,0", "48 x 32");
    expectRefusal(start + " --overlay links --cache 999999", "--cache");
    expectRefusal(start + " --overlay caches --cache 1", "--overlay links");
    expectRefusal(start + " --overlay caches --overlay-depth 1", "--overlay clusters");
    expectRefusal(start + " --overlay caches --device cpu", "Vulkan");
    expectRefusal("render cornell --overlay caches -o " + path("box.exr"), ".png");
    EXPECT_EQ(limn(start + " --overlay nonsense").exit, 2);
    EXPECT_EQ(limn(start + " --overlay links --cache 1 --pick 1,1").exit, 2);
}

} // namespace
} // namespace limn::render_command_test
