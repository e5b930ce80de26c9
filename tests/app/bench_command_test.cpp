// SPDX-License-Identifier: MIT
// `limn bench`: rows, files and numbers.
#include "tests/app/command_line.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace limn::bench_command_test {
namespace {

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

TEST_F(CommandLine, BenchPhotonsMeasuresEachBlurBesideItsRivals) {
    const std::string folder = path("photons");
    const nlohmann::json rows =
        json("bench photons cornell --photons 500 --runs 1 --json -o " + folder)["rows"];
    ASSERT_EQ(rows.size(), 15u);
    for (const nlohmann::json& row : rows) {
        for (const char* key : {"update_ms", "lookup_ns", "jump", "mean"})
            EXPECT_GT(row[key], 0) << key;
        EXPECT_EQ(row["photons_ms"].is_null(), row["technique"] == "lpv");
    }
    EXPECT_GT(rows[0]["jump"], rows[3]["jump"]) << "a blur smooths";
    EXPECT_TRUE(std::filesystem::exists(folder + "/photons.csv"));
}

#ifdef LIMN_HAS_VIEWPORT
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
#endif

} // namespace
} // namespace limn::bench_command_test
