// SPDX-License-Identifier: MIT
// The contract that scripts rely on: exit codes, one line for a failure, one JSON object on stdout.
#include "engine/scene/bake_settings.h"
#include "tests/app/command_line.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

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
    expectRefusal("reference cornell --spp 1000000 -o " + path("x.png"), ".exr");
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

// A right triangle in the plane z = 0 whose node is at x = `at`.
std::string triangleAt(double at) {
    const nlohmann::json number = at;
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

TEST_F(CommandLine, BenchErrorMeasuresGeneratedScenes) {
    const std::string folder = path("generated");
    const nlohmann::json out =
        json("bench error --generated 2 --size 32x18 --spp 8 --surfels 256,512 --lightmap 400 "
             "--rays 64 --json -o " +
             folder);
    ASSERT_EQ(out["rows"].size(), 4u); // 2 scenes, 2 settings
    for (const nlohmann::json& row : out["rows"])
        for (const char* key : {"nrmse", "bias", "seconds", "bytes", "reference_noise"})
            EXPECT_TRUE(row[key].is_number()) << key;
    EXPECT_EQ(out["rows"][0]["kind"], "room");
    EXPECT_TRUE(out["rows"][0]["leak"].is_null());
    EXPECT_EQ(out["rows"][2]["kind"], "two_rooms");
    EXPECT_TRUE(out["rows"][2]["leak"].is_number());
    ASSERT_EQ(out["distribution"].size(), 10u); // all, tuned, untuned, two kinds; 2 settings
    EXPECT_EQ(out["distribution"][0]["scenes"], 2);
    EXPECT_EQ(out["distribution"][1]["group"], "tuned"); // of one even seed
    EXPECT_EQ(out["distribution"][1]["nrmse_worst"], out["rows"][0]["nrmse"]);
    EXPECT_EQ(out["distribution"][2]["nrmse_median"], out["rows"][2]["nrmse"]);
    for (const char* file : {"generated.csv", "generated.json", "generated-distribution.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder + "/" + file)) << file;
    EXPECT_EQ(limn("bench error -o " + folder).exit, 2); // neither scenes nor seeds
    EXPECT_EQ(limn("bench error cornell --generated 1 -o " + folder).exit, 2);
    expectRefusal("bake generated:x -o " + path("x.limnbake"), "generated:x");
}

#ifdef LIMN_HAS_VIEWPORT
TEST_F(CommandLine, RenderPrintsOneJsonObjectAndWritesThePicture) {
    const std::string bake = path("box.limnbake"), picture = path("box.png"),
                      linear = path("box.exr");
    ASSERT_EQ(limn("bake cornell" + kCoarse + "-o " + bake).exit, 0);
    for (const std::string& output : {picture, linear})
        for (const std::string device : {"auto", "cpu"}) {
            const nlohmann::json rendered =
                json("render cornell --bake " + bake + " --device " + device +
                     " --width 48 --height 32 --json -o " + output);
            expectKeys(rendered, {"seconds", "device", "width", "height", "invalid_pixels"});
            EXPECT_EQ(rendered["width"], 48);
            EXPECT_EQ(rendered["invalid_pixels"], 0);
            EXPECT_GT(fs::file_size(output), 0u);
            if (device == "cpu") {
                EXPECT_EQ(rendered["device"], "cpu");
            }
            fs::remove(output);
        }
    expectRefusal("render cornell --bake " + bake + " --device nowhere -o " + picture, "--device");
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

TEST_F(CommandLine, BenchFrameWritesARowPerNumberOfLightsAndDevice) {
    const std::string folder = path("frames");
    const std::string start = "bench frame cornell --surfels 256 --links 16 --rays 32 --lightmap "
                              "200 --width 32 --height 24 --runs 9 -o " +
                              folder;
    const nlohmann::json rows = json(start + " --lights 1,30 --relight gpu,cpu --json")["rows"];
    ASSERT_EQ(rows.size(), 4u);
    for (const nlohmann::json& row : rows) {
        expectKeys(row, {"name", "device", "relight", "width", "height", "surfels", "links",
                         "bands", "lights", "lights_left_out", "frames", "bytes", "median_ms",
                         "p95_ms", "per_light_median_ms"});
        EXPECT_EQ(row["frames"], 9);
        EXPECT_GE(row["p95_ms"], row["median_ms"]);
        double passes = 0;
        EXPECT_EQ(row["geometry_drawn"], 0) << "only lights move";
        for (const char* pass : {"shadow_maps", "lights_on_surfels", "surfels", "pull", "caches",
                                 "field", "indirect", "direct", "tonemap"}) {
            const double ms = row[pass + std::string("_median_ms")];
            EXPECT_GT(ms, 0) << pass;
            passes += ms;
        }
        EXPECT_LT(passes, 1.5 * row["p95_ms"].get<double>()) << "they are parts of the frame";
        EXPECT_EQ(row["lights_left_out"], 0);
    }
    EXPECT_EQ(rows[0]["relight"], "gpu");
    EXPECT_EQ(rows[1]["relight"], "cpu");
    EXPECT_NE(contents(folder + "/frame.csv").find("shadow_maps_median_ms"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(contents(folder + "/frame.json")).size(), 4u);
    const nlohmann::json moving = json(start + " --moving-camera --json")["rows"][0];
    EXPECT_EQ(moving["geometry_drawn"], 9);
    EXPECT_GT(moving["geometry_median_ms"], 0);
    expectRefusal(start + " --device nowhere", "--device");
    EXPECT_EQ(limn(start + " --runs 8").exit, 2);
}

TEST_F(CommandLine, BenchRelightMovesDynamicObjectsAndTimesTheirOcclusion) {
    const std::string folder = path("occlusion");
    const std::string start = "bench relight cornell --surfels 256 --links 16 --rays 32 --lightmap "
                              "200 --storage rtp --runs 9 --json -o " +
                              folder;
    const nlohmann::json moving = json(start + " --dynamic 'Short block@0,0.6,0'")["rows"][0];
    EXPECT_GT(moving["occlusion_median_ms"], 0);
    EXPECT_GE(moving["occlusion_p95_ms"], moving["occlusion_median_ms"]);
    EXPECT_LT(moving["occlusion_median_ms"], moving["p95_ms"]) << "it is a part of all";
    EXPECT_GT(moving["caches_occluded"], 0);
    EXPECT_GT(moving["links_occluded"], moving["caches_occluded"]);
    EXPECT_NE(contents(folder + "/relight.csv").find("occlusion_median_ms"), std::string::npos);
    const nlohmann::json still = json(start)["rows"][0];
    EXPECT_EQ(still["occlusion_median_ms"], 0);
    EXPECT_EQ(still["links_occluded"], 0);
    EXPECT_EQ(limn(start + " --dynamic Nothing").exit, 1);
    const nlohmann::json both =
        json(start + " --dynamic 'Short block@0,0.6,0' --device cpu,gpu")["rows"];
    EXPECT_EQ(both[1]["links_occluded"], both[0]["links_occluded"]);
    EXPECT_EQ(both[1]["caches_occluded"], both[0]["caches_occluded"]);
    EXPECT_GT(both[1]["occlusion_median_ms"], 0);
}

TEST_F(CommandLine, BenchLinksMeasuresBothStorages) {
    const std::string folder = path("links");
    const std::string start = "bench links cornell --surfels 256 --links 16 --rays 32 --lightmap "
                              "200 --grid 2x2x2 --caches 20 --reference-rays 4 --json -o " +
                              folder;
    const nlohmann::json rows = json(start + " --bands 4")["rows"];
    ASSERT_EQ(rows.size(), 4u); // lightmap and grid
    for (const nlohmann::json& row : rows)
        for (const char* key : {"link_band_0", "link_band_3", "lit_band_3", "irradiance_60"})
            EXPECT_GT(row[key], 0) << key;
    EXPECT_EQ(rows[0]["storage"], "rtp");
    EXPECT_EQ(rows[1]["storage"], "sh");
    EXPECT_EQ(rows[0]["links"], rows[1]["links"]);
    EXPECT_EQ(rows[2]["caches"], "grid");
    EXPECT_NE(contents(folder + "/links.csv").find("irradiance_30"), std::string::npos);
    const nlohmann::json few = json(start + " --bands 2 --storage sh")["rows"];
    ASSERT_EQ(few.size(), 2u);
    EXPECT_TRUE(few[0]["lit_band_2"].is_null());
    EXPECT_EQ(limn("bench links -o " + folder).exit, 2);
}

TEST_F(CommandLine, BenchRelightCountsLinksThatAreSkipped) {
    const std::string start = "bench relight cornell --surfels 2048 --links 64 --rays 64 "
                              "--lightmap 400 --storage rtp --runs 9 --json -o " +
                              path("over") + " --light 'spot pos=0,1.5,0 dir=0,-1,0 cd=9 outer=9'";
    const nlohmann::json on = json(start)["rows"][0], anew = json(start + " --anew")["rows"][0];
    EXPECT_GT(on["links_of_run"], on["caches"]);
    EXPECT_EQ(anew["links_of_run"], on["links_of_run"]);
    EXPECT_GT(anew["links_skipped"], on["links_skipped"]) << "no light has bounced yet";
    EXPECT_DOUBLE_EQ(double(anew["skipped_percent"]),
                     100 * double(anew["links_skipped"]) / double(anew["links_of_run"]));
    EXPECT_EQ(limn(start + " --anew --bounces 9").exit, 1);
}

TEST_F(CommandLine, BenchStressFindsNothingWrongButWhatIs) {
    const std::string start = "bench stress cornell --surfels 256 --links 16 --rays 32 --lightmap "
                              "200 --width 32 --height 24 --json -o " +
                              path("stress");
    const Outcome none = limn(start + " --seconds 0.1");
    if (none.err.find("validation layer is missing") != std::string::npos)
        GTEST_SKIP() << none.err;
    const nlohmann::json rows = json(start + " --seconds 0.1 --frames 20")["rows"];
    ASSERT_EQ(rows.size(), 1u);
    const nlohmann::json& row = rows[0];
    expectKeys(row, {"name", "device", "seed", "frames", "resident_start", "resident_warm",
                     "resident_end", "growth_mib", "bytes", "median_ms", "p95_ms"});
    for (const char* count : {"messages", "invalid_pixels", "invalid_field"})
        EXPECT_EQ(row[count], 0);
    EXPECT_GE(row["frames"], 20);
    EXPECT_GT(row["field_looks"], 0);
    EXPECT_GT(row["links_occluded"], 0);
    std::uint64_t shakes = 0;
    for (const char* shake : {"move_light", "change_light", "switch_light", "add_light",
                              "remove_light", "change_material", "change_sky", "move_object"})
        shakes += row[shake].get<std::uint64_t>();
    EXPECT_GT(shakes, 0u);
    EXPECT_EQ(nlohmann::json::parse(contents(path("stress/stress.json"))), rows);
    // The strongest light there may be fits into floats on the device, too.
    const std::string strong = " --light 'point pos=0,1,0 cd=1e10 color=1e10,1e10,1e10'";
    EXPECT_EQ(json(start + " --seconds 0.1 --frames 21" + strong)["rows"][0]["invalid_field"], 0);
}

TEST_F(CommandLine, RenderRelightsOnEitherDeviceAndSaysOnWhich) {
    const std::string bake = path("box.limnbake"), cpu = path("cpu.exr"), gpu = path("gpu.exr");
    ASSERT_EQ(limn("bake cornell" + kCoarse + "-o " + bake).exit, 0);
    const std::string start = "render cornell --bake " + bake +
                              " --light 'point pos=0,1,0.5 cd=1' --width 48 --height 32 --json ";
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
#endif

} // namespace limn::command_line_test
