// SPDX-License-Identifier: MIT
// `limn bench front`: kept rows, the paper's sentences, the page and the command.
#include "app/bench/front_claims.h"
#include "app/bench/front_page.h"
#include "app/bench/kept_rows.h"
#include "tests/app/command_line.h"

#include <gtest/gtest.h>

namespace limn::front_test {
namespace {

using limn::Json;
using limn::PaperClaim;

/// A row of made-up figures.
Json row(int surfels, int links, double ms, double mib, double nrmse, int bands = 3,
         int chroma = 3) {
    return {{"scene", "room"},
            {"settings", "surfels " + std::to_string(surfels) + " & < links"},
            {"preset", ""},
            {"surfels", surfels},
            {"links", links},
            {"bands", bands},
            {"chroma_bands", chroma},
            {"bands_read", bands},
            {"seconds", 1.0},
            {"bytes", mib * (1 << 20)},
            {"update_ms", ms},
            {"median_ms", ms},
            {"p95_ms", ms},
            {"nrmse", nrmse},
            {"nrmse_noise", 0.001},
            {"bias", 0.01},
            {"gathered_nrmse", nrmse / 2},
            {"gathered_bias", nullptr}};
}

TEST(FrontClaims, CompareHalvingsOfOneSettingAlone) {
    // Half the surfels: 1.1 times the error; a quarter of the links: four times, so half: twice.
    const std::vector<Json> rows = {row(100, 64, 1, 1, 0.1), row(50, 64, 1, 1, 0.11),
                                    row(100, 16, 1, 1, 0.4)};
    const PaperClaim claim = limn::surfelsAreSaferToReduce(rows);
    EXPECT_EQ(claim.verdict, PaperClaim::Verdict::Holds);
    EXPECT_NE(claim.reason.find("1.100"), std::string::npos) << claim.reason;
    EXPECT_NE(claim.reason.find("2.000"), std::string::npos) << claim.reason;
    const std::vector<Json> other = {row(100, 64, 1, 1, 0.1), row(50, 64, 1, 1, 0.2),
                                     row(100, 32, 1, 1, 0.11)};
    EXPECT_EQ(limn::surfelsAreSaferToReduce(other).verdict, PaperClaim::Verdict::Fails);
    const std::vector<Json> none = {row(100, 64, 1, 1, 0.1), row(50, 32, 1, 1, 0.2)};
    EXPECT_EQ(limn::surfelsAreSaferToReduce(none).verdict, PaperClaim::Verdict::Unknown)
        << "both settings differ";
}

TEST(FrontClaims, AskForRowsWithSixBandsAndMore) {
    const auto verdict = [](double eight) {
        return limn::littleGainAboveSixBands({row(9, 9, 1, 1, 0.5, 4, 4),
                                              row(9, 9, 1, 1, 0.2, 6, 6),
                                              row(9, 9, 2, 1, eight, 8, 8)})
            .verdict;
    };
    EXPECT_EQ(verdict(0.196), PaperClaim::Verdict::Holds);
    EXPECT_EQ(verdict(0.15), PaperClaim::Verdict::Fails);
    EXPECT_EQ(limn::littleGainAboveSixBands({row(9, 9, 1, 1, 0.5)}).verdict,
              PaperClaim::Verdict::Unknown);
    Json diffuse = row(9, 9, 1, 1, 0.2, 8, 8);
    diffuse["bands_read"] = 3;
    EXPECT_EQ(limn::littleGainAboveSixBands({row(9, 9, 1, 1, 0.2, 6, 6), diffuse}).verdict,
              PaperClaim::Verdict::Unknown)
        << "nothing reads the two further bands";
    EXPECT_EQ(
        limn::littleGainAboveSixBands({row(9, 9, 1, 1, 0.2, 6, 6), row(9, 9, 2, 1, 0.2, 8, 8)})
            .verdict,
        PaperClaim::Verdict::Unknown)
        << "the picture shows none of them";
}

TEST(FrontClaims, CompressionPaysWhereItSavesMoreTimeThanItAddsError) {
    const auto verdict = [](double few, double many) {
        return limn::chrominancePaysFromSixBands(
                   {row(9, 9, 10, 1, 0.1, 3, 3), row(9, 9, 9, 1, few, 3, 2),
                    row(9, 9, 20, 1, 0.1, 6, 6), row(9, 9, 10, 1, many, 6, 3)})
            .verdict;
    };
    EXPECT_EQ(verdict(0.15, 0.11), PaperClaim::Verdict::Holds);
    EXPECT_EQ(verdict(0.101, 0.11), PaperClaim::Verdict::Fails) << "it pays with three, too";
    EXPECT_EQ(verdict(0.15, 0.3), PaperClaim::Verdict::Fails) << "it never pays";
    EXPECT_EQ(limn::chrominancePaysFromSixBands({row(9, 9, 1, 1, 0.1)}).verdict,
              PaperClaim::Verdict::Unknown);
}

TEST(FrontPage, NeedsNoOtherFileAndMarksTheLines) {
    std::vector<Json> rows = {row(100, 64, 4, 1, 0.1), row(50, 64, 2, 2, 0.2),
                              row(25, 64, 3, 3, 0.3)};
    rows[0]["preset"] = "draft";
    limn::markLines(rows);
    EXPECT_TRUE(rows[0]["time_front"].get<bool>() && rows[0]["memory_front"].get<bool>());
    EXPECT_TRUE(rows[1]["time_front"].get<bool>());
    EXPECT_FALSE(rows[1]["memory_front"].get<bool>());
    EXPECT_FALSE(rows[2]["time_front"].get<bool>());
    const std::string html = limn::frontPage({{"a < b", "note & more", rows}}, "limn 0");
    for (const char* part : {"a &lt; b", "note &amp; more", "&amp; &lt; links", "<polyline",
                             ">draft</text>", "Not decided"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    for (const char* outside : {"http:", "https:", "<script", ">inf", ">nan", "\"nan", " nan,"})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
}

TEST_F(CommandLine, KeptRowsAreReadByTheirKeys) {
    const std::string folder = path("kept");
    {
        auto kept = limn::KeptRows::open(folder, "table");
        ASSERT_TRUE(kept) << kept.error().message;
        EXPECT_EQ(kept->find("a"), nullptr);
        ASSERT_TRUE(kept->keep("a \"quoted\"\n", {{"x", 1}, {"y", nullptr}}));
        ASSERT_TRUE(kept->keep("b", {{"x", 0.1}}));
    }
    const auto again = limn::KeptRows::open(folder, "table");
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_NE(again->find("a \"quoted\"\n"), nullptr);
    EXPECT_EQ((*again->find("a \"quoted\"\n"))["x"], Json(1));
    EXPECT_EQ((*again->find("b"))["x"].get<double>(), 0.1) << "numbers keep all of their digits";
    EXPECT_EQ(again->find("c"), nullptr);
    for (const char* hostile :
         {"no json\n", "[1]\n", "3\n", "{\"key\": 1, \"row\": {}}\n", "{\"key\": \"a\"}\n", "\n"}) {
        write(folder + "/table.rows", hostile);
        const auto refused = limn::KeptRows::open(folder, "table");
        ASSERT_FALSE(refused) << hostile;
        EXPECT_NE(refused.error().message.find("table.rows: line 1"), std::string::npos);
    }
}

TEST_F(CommandLine, BenchFrontGoesOnFromTheRowsItKept) {
    const std::string folder = path("front"),
                      start = "bench front cornell --width 32 --height 18 --spp 8 --runs 3 "
                              "--rays 64 --lightmap 400 --presets none --json -o " +
                              folder + " --surfels ";
    const nlohmann::json first = json(start + "256 --links 8")["rows"];
    ASSERT_EQ(first.size(), 1u);
    for (const char* key : {"update_ms", "median_ms", "bytes", "nrmse", "bias", "gathered_nrmse"})
        EXPECT_TRUE(first[0][key].is_number()) << key;
    EXPECT_EQ(first[0]["time_front"], true);
    const nlohmann::json both = json(start + "256,512 --links 8")["rows"];
    ASSERT_EQ(both.size(), 2u);
    for (const char* timed : {"update_ms", "seconds", "nrmse"}) // a second bake takes another time
        EXPECT_EQ(both[0][timed], first[0][timed]) << timed;
    const nlohmann::json other = json(start + "256 --links 8 --live-spp 4")["rows"];
    EXPECT_NE(other[0]["seconds"], first[0]["seconds"]) << "another command";
    for (const char* file : {"front.html", "front.csv", "front.json"})
        EXPECT_TRUE(fs::exists(folder + "/" + file)) << file;
    write(folder + "/front.rows", "broken");
    expectRefusal(start + "256 --links 8", "front.rows");
}

TEST_F(CommandLine, BenchFrontRefusesHostileValuesByName) {
    const std::string start = "bench front cornell -o " + path("refused");
    for (const auto& [arguments, word] :
         {std::pair<std::string, std::string>{" --surfels 3", "--surfels"},
          {" --links 8,nan", "--links"},
          {" --bands 9", "--bands"},
          {" --storage zip", "--storage"},
          {" --lightmap ,", "--lightmap"},
          {" --glossy 2", "--glossy"},
          {" --glossy nan", "--glossy"},
          {" --presets best", "--presets"},
          {" --spp 0", "--spp"},
          {" --runs -1", "--runs"},
          {" --gathered-spp 1e9", "--gathered-spp"}}) {
        const Outcome run = limn(start + arguments);
        EXPECT_EQ(run.exit, 2) << arguments;
        EXPECT_NE(run.err.find(word), std::string::npos) << arguments << ": " << run.err;
    }
}

} // namespace
} // namespace limn::front_test
