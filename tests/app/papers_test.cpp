// SPDX-License-Identifier: MIT
// `limn bench papers`: kept lines, the tables, and scenes that are missing.
#include "app/papers/papers_page.h"
#include "tests/app/command_line.h"

#include <gtest/gtest.h>

namespace limn::papers_test {
namespace {

using limn::PaperExperiment;
using limn::PaperLine;
using limn::PaperTable;

const PaperExperiment kExperiment{.key = "T9",
                                  .title = "Table 9: times < errors",
                                  .printedOn = "a card",
                                  .note = "A note.",
                                  .scene = &limn::kPaperSponza,
                                  .measure = nullptr};

PaperLine madeUp(const std::string& name, double ms) {
    return {name,
            {{"caches [ms]", ms, 0.25, 116},
             {"nRMSE", 0.0512, 0.001, {}},
             {"frame [ms]", std::nullopt, 0, 7.17}},
            {}};
}

TEST(PapersPage, SetsPrintedFiguresBesideMeasuredOnes) {
    const std::vector<PaperTable> tables = {
        {&kExperiment, {madeUp("ours & one", 3.456), madeUp("paper's links", 5)}, {}},
        {&kExperiment, {}, "there is no x.gltf"}};
    const auto html = limn::papersPage(tables, "limn 0", "nowhere");
    ASSERT_TRUE(html) << html.error().message;
    for (const char* part :
         {"times &lt; errors", "ours &amp; one", "3.46 \u00b1 0.2 (116)", "0.0512 \u00b1 0.001",
          "<td>(7.17)</td>", "<svg", "Not measured: there is no x.gltf", "those of a card"})
        EXPECT_NE(html->find(part), std::string::npos) << part;
    for (const char* outside : {"http:", "https:", "<script", ">nan"})
        EXPECT_EQ(html->find(outside), std::string::npos) << outside;
    const std::string text = limn::papersMarkdown(tables, "limn 0");
    EXPECT_NE(text.find("| | caches [ms] | nRMSE | frame [ms] |\n|---|---|---|---|\n"
                        "| ours & one | 3.46 \u00b1 0.2 (116) |"),
              std::string::npos)
        << text;
    EXPECT_EQ(limn::papersRows(tables).size(), 6u);
    PaperLine pictured = madeUp("pictured", 1);
    pictured.picture = "missing.png";
    EXPECT_FALSE(limn::papersPage({{&kExperiment, {pictured}, {}}}, "", "nowhere"));
}

TEST_F(CommandLine, BenchPapersMeasuresNoLineTwice) {
    limn::PaperOptions options{.scenes = "none", .output = path("papers")};
    int measured = 0;
    const auto measure = [&]() -> limn::Result<PaperLine> {
        ++measured;
        return madeUp("", 2);
    };
    for (const int runs : {21, 21, 9}) { // figures of fewer runs are others
        options.runs = runs;
        auto run = limn::PaperRun::open(options);
        ASSERT_TRUE(run) << run.error().message;
        ASSERT_TRUE(run->line("T9", "first", measure));
        ASSERT_TRUE(run->line("T9", "second", measure));
        const std::vector<PaperLine>& lines = run->linesOf("T9");
        ASSERT_EQ(lines.size(), 2u);
        EXPECT_EQ(lines[1].name, "second");
        ASSERT_EQ(lines[1].figures.size(), 3u);
        EXPECT_EQ(lines[1].figures[0].printed, 116);
        EXPECT_EQ(lines[1].figures[2].measured, std::nullopt);
        const auto failing = run->line("T9", "third", [] { return limn::fail("broken"); });
        ASSERT_FALSE(failing);
        EXPECT_EQ(failing.error().message, "T9, third: broken");
    }
    EXPECT_EQ(measured, 4);
}

TEST_F(CommandLine, BenchPapersSkipsScenesThatAreMissingByName) {
    const std::string folder = path("report");
    const Outcome run =
        limn("bench papers --cpu --only T2,web-T4 --scenes " + path("none") + " -o " + folder);
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_NE(run.err.find("T2: there is no " + path("none") + "/sponza-crytek/Sponza.gltf"),
              std::string::npos)
        << run.err;
    for (const char* file : {"papers.html", "papers.md", "papers.csv", "papers.json"})
        EXPECT_TRUE(fs::exists(folder + "/" + file)) << file;
}

TEST_F(CommandLine, BenchPapersRefusesHostileValuesByName) {
    const std::string start = "bench papers --scenes x -o " + path("refused");
    for (const auto& [arguments, word] :
         {std::pair<std::string, std::string>{" --only T99", "--only"},
          {" --only ,", "--only"},
          {" --spp 0", "--spp"},
          {" --runs nan", "--runs"},
          {" --width 1e9", "--width"}}) {
        const Outcome run = limn(start + arguments);
        EXPECT_EQ(run.exit, 2) << arguments;
        EXPECT_NE(run.err.find(word), std::string::npos) << arguments << ": " << run.err;
    }
}

} // namespace
} // namespace limn::papers_test
