// SPDX-License-Identifier: MIT
#include "app/bench/techniques_page.h"
#include "tests/app/command_line.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

using limn::Json;

Json row(const char* technique, const char* settings, double ms, double nrmse) {
    return {{"technique", technique}, {"settings", settings},    {"seconds", 0.5},
            {"bytes", 1 << 20},       {"light_ms", ms},          {"color_ms", 1.0},
            {"material_ms", 2.0},     {"object_ms", nullptr},    {"nrmse", nrmse},
            {"bias", -0.1},           {"one_bounce_nrmse", 1.0}, {"one_bounce_bias", 0.2}};
}

TEST(TechniquesPage, TheSmallestErrorWithinABudgetWins) {
    const std::vector<Json> rows = {row("A", "fast", 3, 0.5), row("A", "slow", 30, 0.1),
                                    row("B", "fast", 4, 0.4)};
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 2), nullptr);
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 3), &rows[0]);
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 5), &rows[2]);
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 33), &rows[1]);
}

TEST(TechniquesPage, NeedsNoOtherFileAndEscapesNames) {
    limn::Image image;
    image.width = image.height = 1;
    image.rgba = {255, 0, 0, 255};
    const auto html =
        limn::techniquesPage({{"a < b",
                               "note",
                               {row("A & Co", "fast", 3, 0.5), row("B", "dark", 0, 1)},
                               {{"red", image}}}});
    ASSERT_TRUE(html);
    EXPECT_NE(html->find("a &lt; b"), std::string::npos);
    EXPECT_NE(html->find("A &amp; Co"), std::string::npos);
    EXPECT_NE(html->find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    for (const char* outside : {"http:", "https:", "<script", "inf", "nan"})
        EXPECT_EQ(html->find(outside), std::string::npos) << outside;
}

TEST_F(CommandLine, BenchTechniquesMeasuresWhatIsAskedAndWritesAPage) {
    const nlohmann::json result =
        json("bench techniques generated:2 --technique ambient,probes --width 16 --height 12 "
             "--spp 8 --runs 1 --json -o " +
             path("rivals"));
    ASSERT_EQ(result["rows"].size(), 6U) << "ambient's default and five sizes of probes";
    EXPECT_EQ(result["rows"][0]["technique"], "Ambient");
    EXPECT_EQ(result["rows"][5]["settings"], "count 1024");
    EXPECT_GT(result["rows"][5]["bytes"], result["rows"][1]["bytes"]);
    for (const auto& r : result["rows"])
        EXPECT_GE(r["nrmse"].get<double>(), 0);
    for (const char* file : {"techniques.csv", "techniques.json", "techniques.html"})
        EXPECT_GT(std::filesystem::file_size(path("rivals/") + file), 100U) << file;
    EXPECT_EQ(limn("bench techniques generated:2 --technique magic -o " + path("none")).exit, 2);
    EXPECT_EQ(limn("bench techniques nothing.gltf -o " + path("none")).exit, 1);
}

} // namespace
