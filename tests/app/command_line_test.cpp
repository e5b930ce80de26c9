// SPDX-License-Identifier: MIT
// The contract that scripts rely on: exit codes, one line for a failure, one JSON object on stdout.
#include "engine/files/image_file.h"
#include "engine/scene/bake_settings.h"
#include "engine/scene/tone_map.h"
#include "tests/app/command_line.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace limn::command_line_test {

const std::string kCoarse = " --surfels 256 --links 32 --rays 64 --lightmap 300 --grid 3x3x3 ";

TEST_F(CommandLine, ExitsWith2OnBadUsage) {
    for (const char* arguments : {"",
                                  "nonsense",
                                  "bake",
                                  "bake cornell",
                                  "bake cornell -o x --frobnicate",
                                  "bake cornell -o x --surfels many",
                                  "bake cornell -o x --surfels -5",
                                  "bake cornell -o x --grid 3x3",
                                  "bake cornell -o x --grid -1x3x3",
                                  "bake cornell -o x --bands 9",
                                  "bake cornell -o x --storage zip",
                                  "bake cornell -o x --chroma-bands 9",
                                  "bake cornell -o x --preset finest",
                                  "bake cornell -o x --error 0",
                                  "bake cornell -o x --eye 0,1,2 --target 0,0,0",
                                  "bake cornell -o x --error 0.1 --texels-per-metre 3",
                                  "export cornell --format gltf -o x.gltf --texels 9 "
                                  "--lightmap-texels-per-metre 3",
                                  "reference cornell",
                                  "reference cornell -o x.exr --spp none",
                                  "reference cornell -o x.exr --view nonsense",
                                  "compare one.exr",
                                  "info"}) {
        const Outcome run = limn(arguments);
        EXPECT_EQ(run.exit, 2) << "limn " << arguments << "\n" << run.err;
        EXPECT_EQ(run.out, "") << "limn " << arguments;
        EXPECT_NE(run.err, "") << "limn " << arguments;
    }
}

TEST_F(CommandLine, ExplainsItselfOnStdout) {
    for (const char* arguments : {"--help", "reference --help", "compare --help", "info --help"}) {
        const Outcome run = limn(arguments);
        EXPECT_EQ(run.exit, 0) << arguments;
        EXPECT_NE(run.out, "") << arguments;
        EXPECT_EQ(run.err, "") << arguments;
    }
}

TEST_F(CommandLine, NamesTheSceneThatItCannotOpen) {
    expectRefusal("info nowhere.gltf", "nowhere.gltf");
    expectRefusal("info nowhere.limnbake", "nowhere.limnbake");
    expectRefusal("reference nowhere.limn -o " + path("x.exr"), "nowhere.limn");
    expectRefusal("compare nowhere.exr nowhere.exr", "nowhere.exr");
    write(path("broken.gltf"), "{\"asset\": ");
    expectRefusal("info " + path("broken.gltf"), "broken.gltf");
    write(path("broken.limn"), "{\"version\": 1, ");
    expectRefusal("info " + path("broken.limn"), "broken.limn");
    write(path("broken.limnbake"), "no bake at all");
    expectRefusal("info " + path("broken.limnbake"), "broken.limnbake");
    write(path("empty.exr"), "");
    expectRefusal("compare " + path("empty.exr") + " " + path("empty.exr"), "empty.exr");
}

TEST_F(CommandLine, RefusesAnOutputBeforeTheWork) {
    expectRefusal("reference cornell --spp 1000000 -o " + path("no/such/folder/x.exr"), "x.exr");
    expectRefusal("reference cornell --spp 1000000 -o " + path("x.jpg"), ".exr");
    expectRefusal("reference cornell --light-tracing --view albedo -o " + path("x.exr"),
                  "--light-tracing");
    expectRefusal("reference cornell --spp 1000000 -o " + path(""), "folder");
    expectRefusal("compare one.exr two.exr --heatmap " + path("no/such/folder/x.png"), "x.png");
}

TEST_F(CommandLine, NeverWritesOverItsInputOrFilesOfAnotherKind) {
    const std::string scene = path("s.limnbake"), text = path("notes.png");
    write(scene, "a scene");
    fs::create_symlink("s.limnbake", path("link.limnbake"));
    expectRefusal("bake " + scene + " -o " + scene, "is the input");
    expectRefusal("bake " + scene + " -o " + path("link.limnbake"), "is the input");
    expectRefusal("bake cornell -o " + path("cornell"), "must end in .limnbake");
    write(text, "my notes");
    expectRefusal("render cornell -o " + text, "holds something else");
    EXPECT_EQ(contents(scene), "a scene");
    EXPECT_EQ(contents(text), "my notes");
    fs::create_symlink("/dev/null", path("null.exr"));
    expectRefusal("reference cornell -o " + path("null.exr"), "is not a regular file");
}

TEST_F(CommandLine, NumbersThatAreNoneOrTooLargeAreRefused) {
    for (const char* arguments :
         {"render cornell -o x.png --fov nan", "render cornell -o x.png --exposure nan",
          "reference cornell -o x.exr --sky-strength nan",
          "reference cornell -o x.exr --sky-rotation inf",
          "bake cornell -o x.limnbake --texels-per-metre nan",
          "bake cornell -o x.limnbake --cache-size nan", "bake cornell -o x.limnbake --memory nan"})
        EXPECT_EQ(limn(arguments).exit, 2) << arguments;
    const std::string out = " --spp 1 --width 8 --height 8 -o " + path("x.exr");
    for (const char* arguments : {"reference cornell --eye 1e20,0,0 --target 0,0,0",
                                  "reference cornell --eye nan,0,0 --target 0,0,0",
                                  "reference cornell --light 'point pos=1e20,0,0 cd=5'"})
        expectRefusal(arguments + out, "beyond 1e+12 m of the origin");
}

TEST_F(CommandLine, AFullStandardOutputIsAFailure) {
    const std::string command =
        "'" LIMN_EXECUTABLE "' info cornell > /dev/full 2> '" + path("err") + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    EXPECT_NE(contents(path("err")).find("cannot write to standard output"), std::string::npos);
}

TEST_F(CommandLine, WhatWouldNeedTooMuchMemoryIsRefusedBeforeItIsAllocated) {
    expectRefusal("bake cornell --json --no-cache --texels-per-metre 3000 -o " + path("c.limnbake"),
                  "lower rays, lightmap or grid");
    expectRefusal("bake cornell --json --no-cache --memory 0.125 -o " + path("c.limnbake"),
                  "128 MiB are allowed (--memory)");
}

TEST_F(CommandLine, BakesUntilAnErrorIsHeldAndSaysWhereItIsNot) {
    const std::string start =
        "bake cornell --no-cache --surfels 256 --links 32 --rays 64 --lightmap 100 -o " +
        path("c.limnbake");
    const Outcome held = limn(start + " --error 0.1 --json");
    ASSERT_EQ(held.exit, 0) << held.err;
    const auto json = nlohmann::json::parse(held.out);
    EXPECT_LE(json["error"]["nrmse"].get<double>(), 0.1);
    EXPECT_GT(json["settings"]["lightmap"].get<int>(), 100);
    expectRefusal(start + " --error 0.1 --camera Nobody", "Nobody");
    fs::remove(path("c.limnbake"));
    const Outcome dark = limn(start + " --error 0.1 --eye=0,50,0 --target=0,60,0");
    EXPECT_EQ(dark.exit, 1);
    EXPECT_NE(dark.err.find("the camera sees no light"), std::string::npos) << dark.err;
    EXPECT_FALSE(fs::exists(path("c.limnbake")));
}

TEST_F(CommandLine, RefusesLightsSkiesAndCamerasThatMakeNoSense) {
    const std::string start = "reference cornell --spp 1 --width 8 --height 8 -o " + path("x.exr");
    EXPECT_NE(limn(start + " --light 'sun dir=0,-1,0 lux=abc'").exit, 0);
    EXPECT_NE(limn(start + " --light 'sun dir=0,-1,0 lux=nan'").exit, 0);
    EXPECT_NE(limn(start + " --light 'sun dir=0,0,0 lux=1'").exit, 0);
    EXPECT_NE(limn(start + " --light 'torch cd=1'").exit, 0);
    EXPECT_NE(limn(start + " --sky 1,2").exit, 0);
    EXPECT_NE(limn(start + " --sky 1,2,-3").exit, 0);
    expectRefusal(start + " --camera Nobody", "Nobody");
    EXPECT_FALSE(fs::exists(path("x.exr")));
}

// A right triangle in the plane z = 0 whose node stands at x [m].
std::string triangleAt(double x) {
    const nlohmann::json number = x;
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [)" +
           number.dump() + R"(, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
           "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
}

TEST_F(CommandLine, PlacesAreGivenAndPrintedInTheFilesCoordinates) {
    write(path("near.gltf"), triangleAt(0));
    write(path("far.gltf"), triangleAt(1e6));
    const auto picture = [&](const std::string& name, const char* light, const char* camera) {
        const Outcome out = limn("reference " + path(name + ".gltf") + " --spp 4 --width 32 " +
                                 "--height 24 --view direct --light 'point cd=3 pos=" + light +
                                 "' " + camera + " -o " + path(name + ".exr"));
        EXPECT_EQ(out.exit, 0) << out.err;
        return contents(path(name + ".exr"));
    };
    const std::string near = picture("near", "0.3,0.2,1", "--eye 0.3,0.3,2 --target 0.3,0.3,0");
    EXPECT_GT(json("info --json " + path("near.exr"))["maximum"], 0.1);
    EXPECT_EQ(
        picture("far", "1000000.3,0.2,1", "--eye 1000000.3,0.3,2 --target 1000000.3,0.3,0").size(),
        near.size());
    const nlohmann::json compared =
        json("compare --json " + path("far.exr") + " " + path("near.exr"));
    EXPECT_LT(compared["nrmse"], 1e-4);
    const nlohmann::json bounds = json("info --json " + path("far.gltf"))["bounds"];
    EXPECT_EQ(bounds["lower"], nlohmann::json({1e6, 0, 0}));
    EXPECT_EQ(bounds["upper"], nlohmann::json({1e6 + 1, 1, 0}));
}

TEST_F(CommandLine, BakeRefusesWhatItCannotReadOrWrite) {
    expectRefusal("bake nowhere.gltf -o " + path("x.limnbake"), "nowhere.gltf");
    expectRefusal("bake nowhere -o " + path("x.limnbake"), "nowhere");
    expectRefusal("bake cornell -o " + path("no/such/folder/x.limnbake"), "x.limnbake");
}

TEST_F(CommandLine, BakePrintsOneJsonObjectAndInfoReadsTheFile) {
    const std::string bake = path("box.limnbake");
    const nlohmann::json baked = json("bake cornell" + kCoarse + "--json -o " + bake);
    expectKeys(baked, {"seconds", "counts", "bytes", "predicted_bytes", "predicted", "file_bytes",
                       "peak_bytes", "hash"});
    EXPECT_EQ(baked["file_bytes"], std::filesystem::file_size(bake));
    expectKeys(baked["predicted"], {"caches", "least_texels", "file_bytes", "peak_bytes"});
    EXPECT_NEAR(baked["predicted"]["file_bytes"], baked["file_bytes"],
                0.25 * baked["file_bytes"].get<double>());
    EXPECT_GT(baked["predicted"]["peak_bytes"], baked["predicted_bytes"]["total"]);
    EXPECT_GT(baked["peak_bytes"], baked["bytes"]["total"]);
    for (const char* part : {"surfels", "clusters", "links", "caches", "total"})
        EXPECT_NEAR(baked["predicted_bytes"][part], baked["bytes"][part],
                    0.25 * baked["bytes"][part].get<double>())
            << part;
    expectKeys(baked["seconds"], {"total"});
    expectKeys(baked["counts"],
               {"triangles", "surfels", "clusters", "caches", "invalid_caches", "links", "rays"});
    expectKeys(baked["bytes"], {"surfels", "clusters", "links", "caches", "total"});
    EXPECT_EQ(baked["counts"]["triangles"], 38);
    EXPECT_EQ(json("bake cornell" + kCoarse + "--threads 1 --json -o " + bake)["hash"],
              baked["hash"]);

    const nlohmann::json info = json("info --json " + bake);
    EXPECT_EQ(info["settings"]["storage"], "rtp");
    ASSERT_EQ(info["storage_bytes"].size(), 7u);
    EXPECT_EQ(info["storage_bytes"][1]["bands"], 3);
    EXPECT_EQ(info["storage_bytes"][1]["rtp_links"], baked["bytes"]["links"]);
    EXPECT_EQ(info["storage_bytes"][1]["rtp_total"], baked["bytes"]["total"]);
    EXPECT_NE(limn("info " + bake).out.find("SH links [MiB]"), std::string::npos);

    const std::string harmonics = path("sh.limnbake");
    const nlohmann::json sh =
        json("bake cornell" + kCoarse + "--storage sh --chroma-bands 2 --json -o " + harmonics);
    EXPECT_EQ(info["storage_bytes"][1]["sh_total"], sh["bytes"]["total"]);
    EXPECT_EQ(json("info --json " + harmonics)["settings"]["storage"], "sh");
    EXPECT_EQ(json("info --json " + harmonics)["settings"]["chroma_bands"], 2);
    const std::string whole = contents(bake);
    write(bake, whole.substr(0, whole.size() / 2));
    expectRefusal("info " + bake, "box.limnbake");
    std::string flipped = whole;
    flipped[whole.size() / 2] = char(flipped[whole.size() / 2] ^ 0x10);
    write(bake, flipped);
    expectRefusal("info " + bake, "box.limnbake");
}

TEST_F(CommandLine, ReferenceAndComparePrintOneJsonObject) {
    const std::string a = path("a.exr"), b = path("b.exr");
    const std::string start = "reference cornell --view irradiance --width 32 --height 24 --json ";
    const nlohmann::json first = json(start + "--spp 4 -o " + a);
    expectKeys(first, {"seconds", "device", "width", "height", "invalid_pixels"});
    EXPECT_EQ(first["width"], 32);
    EXPECT_EQ(first["height"], 24);
    EXPECT_EQ(first["invalid_pixels"], 0);
    json(start + "--spp 16 -o " + b);
    const nlohmann::json same = json("compare " + a + " " + a + " --json");
    expectKeys(same, {"nrmse", "nrmse_without_worst_percent", "relmse", "bias", "ssim", "flip",
                      "invalid_pixels"});
    EXPECT_EQ(same["nrmse"], 0);
    EXPECT_GT(json("compare " + a + " " + b + " --json")["nrmse"], 0);
    const std::string c = path("c.exr"), d = path("d.exr");
    json(start + "--spp 16 --seed 2 -o " + c);
    json(start + "--spp 16 --seed 3 -o " + d);
    const nlohmann::json two = json("compare " + b + " " + c + " --reference2 " + d + " --json");
    expectKeys(two, {"nrmse", "nrmse_without_worst_percent", "bias", "reference_noise"});
    // All three are equally noisy: without the references' part half of the variance is left.
    const double one = json("compare " + b + " " + c + " --json")["nrmse"];
    EXPECT_NEAR(two["nrmse"].get<double>() / one, std::sqrt(0.5), 0.1);
    EXPECT_NEAR(two["reference_noise"].get<double>() / one, 0.5, 0.1);
    expectRefusal("compare " + b + " " + c + " --reference2 nowhere.exr", "nowhere.exr");
    const std::string e = path("e.png");
    json(start + "--spp 4 --exposure 1 --tonemap agx -o " + e);
    EXPECT_EQ(readPng(e)->rgba, toneMappedImage(*readFloatImage(a), Tonemap::Agx, 1).rgba);
}

TEST_F(CommandLine, APresetSetsCountsAndOtherOptionsReplaceSingleOnes) {
    const std::string bake = path("draft.limnbake");
    json("bake cornell --preset draft --surfels 512 --json -o " + bake);
    const nlohmann::json settings = json("info --json " + bake)["settings"];
    EXPECT_EQ(settings["surfels"], 512);
    EXPECT_EQ(settings["links"], limn::kBakePresets[0].links);
    EXPECT_EQ(settings["rays"], limn::kBakePresets[0].rays);
    EXPECT_TRUE(limn::kBakePresets[1].describes(limn::BakeSettings{})); // medium is the default
}

} // namespace limn::command_line_test
