// SPDX-License-Identifier: MIT
// `limn bench skip`: what an update saves where a scene lacks something.
#include "tests/app/command_line.h"

#include <algorithm>
#include <map>
#include <string>

namespace limn::bench_skip_test {
namespace {

const std::string kSmall = "--surfels 512 --links 16 --rays 64 --lightmap 400 --runs 2 "
                           "--width 48 --height 27";

TEST_F(CommandLine, BenchSkipFindsTheSamePicturesWithLessWork) {
    const std::string folder = path("skip");
    const nlohmann::json rows =
        json("bench skip cornell " + kSmall + " --json -o " + folder)["rows"];
    std::map<std::string, nlohmann::json> lacking;
    for (const nlohmann::json& row : rows)
        lacking[row["lacks"]] = row;
    ASSERT_EQ(lacking.size(), 8u);
    for (const auto& [lacks, row] : lacking) {
        EXPECT_GT(row["mean"], 0) << lacks << ": black pictures would prove nothing";
        if (lacks != "nine tenths of the view") { // which lags behind while lights move
            EXPECT_LT(row["difference_max"], 1e-12) << lacks;
        }
        if (!row["difference_max_at_rest"].is_null()) {
            EXPECT_EQ(row["difference_max_at_rest"], 0) << lacks;
        }
        EXPECT_LE(row["difference_rms"], row["difference_max"]) << lacks;
        if (lacks != "emissive surfaces") { // they cost no work of their own
            EXPECT_GT(row["count"], 0) << lacks;
        }
        EXPECT_LE(row["bytes"], row["whole_bytes"]) << lacks;
        EXPECT_LE(row["link_bytes"], row["whole_link_bytes"]) << lacks;
    }
    EXPECT_EQ(lacking["gloss"]["count"], 2) << "of 5 bands, diffuse surfaces need 3";
    EXPECT_EQ(lacking["light from 8 lamps"]["count"], 8);
    EXPECT_EQ(lacking["motion"]["count"], 1);
    EXPECT_EQ(lacking["motion"]["link_bytes"], 0);
    for (const char* same : {"gloss", "dynamic objects", "motion"})
        EXPECT_EQ(lacking[same]["same_bits"], true) << same;
    EXPECT_TRUE(lacking["nine tenths of the view"]["difference_max_at_rest"].is_number());
    for (const char* kept : {"gloss", "dynamic objects"})
        EXPECT_GT(lacking[kept]["saved_bytes"], 0) << kept;
    for (const char* read : {"sky", "nine tenths of the view"})
        EXPECT_GT(lacking[read]["saved_link_bytes"], 0) << read;
    for (const char* file : {"/skip.csv", "/skip.json"})
        EXPECT_NE(contents(folder + file).find("saved_link_bytes"), std::string::npos) << file;
}

// Harmonics of dark links are summed like all others, so what is left out there are the sky's.
TEST_F(CommandLine, BenchSkipCountsLinksToABlackSkyWithoutReadingThem) {
    const nlohmann::json rows =
        json("bench skip cornell --storage sh " + kSmall + " --json -o " + path("skip"))["rows"];
    const auto row =
        std::ranges::find_if(rows, [](const nlohmann::json& r) { return r["lacks"] == "sky"; });
    ASSERT_NE(row, rows.end());
    EXPECT_GT((*row)["count"], 0);
    EXPECT_EQ((*row)["same_bits"], true);
    EXPECT_EQ((*row)["saved_link_bytes"], (*row)["count"].get<double>() * (4 + 2 * 9))
        << "a node and 3 x 3 halfs for each";
}

TEST_F(CommandLine, BenchSkipRefusesWhatItCannotMeasure) {
    const std::string start = "bench skip cornell -o " + path("skip") + " ";
    EXPECT_EQ(limn(start + "--runs 0").exit, 2);
    EXPECT_NE(limn(start + "--runs 0").err.find("--runs"), std::string::npos);
    EXPECT_NE(limn(start + "--bands 9").err.find("--bands"), std::string::npos);
    EXPECT_NE(limn(start + "--storage zip").err.find("--storage"), std::string::npos);
    EXPECT_EQ(limn("bench skip cornell").exit, 2) << "no folder";
    expectRefusal("bench skip " + path("none.gltf") + " -o " + path("skip"), "none.gltf");
    const Outcome nobody = limn(start + kSmall + " --camera nobody");
    EXPECT_EQ(nobody.exit, 1);
    EXPECT_NE(nobody.err.find("nobody"), std::string::npos) << nobody.err;
}

} // namespace
} // namespace limn::bench_skip_test
