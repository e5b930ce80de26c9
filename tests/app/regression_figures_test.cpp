// SPDX-License-Identifier: MIT
// What figures of quality are compared by, and how `limn bench regression` reads and writes them.
#include "app/bench/regression_figures.h"
#include "tests/app/command_line.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace limn::regression_figures_test {
namespace {

const RegressionFigure kError{"cornell", "error", "%", 5, 0.1}; // tolerance 0.4

RegressionFigure valued(double value) {
    RegressionFigure figure = kError;
    figure.value = value;
    return figure;
}

FigureVerdict verdictOf(const RegressionFigure& committed, const RegressionFigure& measured) {
    return judgeFigures(std::vector{committed}, std::vector{measured}).front();
}

TEST(RegressionFigures, AFigureFailsOnceItIsWorseByMoreThanFourTimesItsNoise) {
    EXPECT_EQ(verdictOf(kError, valued(5.39)).change, FigureChange::Same);
    const FigureVerdict worse = verdictOf(kError, valued(5.41));
    EXPECT_EQ(worse.change, FigureChange::Worse);
    EXPECT_TRUE(worse.fails());
    for (const char* word : {"cornell", "error", "worse", "5.41", "committed 5 "})
        EXPECT_NE(describe(worse).find(word), std::string::npos) << word << describe(worse);
}

TEST(RegressionFigures, AFigureThatIsBetterIsNamedAndPasses) {
    EXPECT_EQ(verdictOf(kError, valued(4.61)).change, FigureChange::Same);
    const FigureVerdict better = verdictOf(kError, valued(4.59));
    EXPECT_EQ(better.change, FigureChange::Better);
    EXPECT_FALSE(better.fails());
    EXPECT_NE(describe(better).find("error is better: 4.59"), std::string::npos);
}

TEST(RegressionFigures, ErrorsOfEitherSignAreJudgedByTheirDistanceFromNone) {
    EXPECT_EQ(verdictOf(valued(-5), valued(-5.5)).change, FigureChange::Worse);
    EXPECT_EQ(verdictOf(valued(-5), valued(-4.5)).change, FigureChange::Better);
    EXPECT_EQ(verdictOf(valued(-5), valued(5.1)).change, FigureChange::Same);
}

TEST(RegressionFigures, WhatIsNotANumberIsWorse) {
    EXPECT_EQ(verdictOf(kError, valued(std::nan(""))).change, FigureChange::Worse);
    EXPECT_EQ(verdictOf(kError, valued(std::numeric_limits<double>::infinity())).change,
              FigureChange::Worse);
}

TEST(RegressionFigures, AFigureWithoutNoiseMayDifferByRounding) {
    RegressionFigure exact = kError;
    exact.noise = 0;
    EXPECT_EQ(verdictOf(exact, valued(5.02)).change, FigureChange::Same);
    EXPECT_EQ(verdictOf(exact, valued(5.03)).change, FigureChange::Worse);
}

TEST(RegressionFigures, AFigureFailsWhereEitherSideLacksIt) {
    RegressionFigure leak = kError, seam = kError, elsewhere = kError;
    leak.name = "leak";
    seam.name = "seam";
    elsewhere.scene = "court";
    const std::vector<FigureVerdict> verdicts =
        judgeFigures(std::vector{leak, kError, elsewhere}, std::vector{kError, seam});
    ASSERT_EQ(verdicts.size(), 4u);
    EXPECT_EQ(verdicts[0].change, FigureChange::Unmeasured);
    EXPECT_NE(describe(verdicts[0]).find("leak"), std::string::npos);
    EXPECT_EQ(verdicts[1].change, FigureChange::Same);
    EXPECT_EQ(verdicts[2].change, FigureChange::Unmeasured) << "of another scene";
    EXPECT_EQ(verdicts[3].change, FigureChange::Uncommitted);
    EXPECT_NE(describe(verdicts[3]).find("seam"), std::string::npos);
    for (const std::size_t k : {0, 2, 3})
        EXPECT_TRUE(verdicts[k].fails());
}

class RegressionFile : public CommandLine {
protected:
    std::string messageOf(const std::string& text) const {
        write(path("figures.json"), text);
        const auto figures = readFigures(path("figures.json"));
        return figures ? "" : figures.error().message;
    }
};

TEST_F(RegressionFile, FiguresSurviveTheFile) {
    RegressionFigure bias{"two rooms", "bias", "%", -0.12345678, 0.00123};
    ASSERT_TRUE(writeFigures(path("figures.json"), std::vector{kError, bias}));
    const auto read = readFigures(path("figures.json"));
    ASSERT_TRUE(read) << read.error().message;
    bias.value = -0.1235; // rounded to four digits, the noise to two
    bias.noise = 0.0012;
    EXPECT_EQ(*read, (std::vector{kError, bias}));
    const auto refused = writeFigures(path("figures.json"), std::vector{valued(std::nan(""))});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("cornell: error"), std::string::npos);
    EXPECT_TRUE(readFigures(path("figures.json"))) << "the old file is still there";
}

TEST_F(RegressionFile, AHostileFileIsRefusedByTheNameOfItsField) {
    const auto figure = [](const std::string& fields) {
        return R"({"figures": [{"scene": "a", "name": "b", "unit": "%", )" + fields + "}]}";
    };
    EXPECT_EQ(messageOf(figure(R"("value": 1, "noise": 0)")), "");
    for (const auto& [text, field] :
         {std::pair<std::string, std::string>{"", "figures.json"},
          {"[", "figures.json"},
          {"[]", "figures must be an array"},
          {R"({"figures": {}})", "figures must be an array"},
          {R"({"figures": [3]})", "figures[0]: must be an object"},
          {R"({"figures": [{"scene": 3}]})", "figures[0]: scene must be a string"},
          {figure(R"("value": "1", "noise": 0)"), "figures[0]: value must be"},
          {figure(R"("value": 1e999, "noise": 0)"), "figures.json"},
          {figure(R"("value": 1)"), "figures[0]: noise must be"},
          {figure(R"("value": 1, "noise": -1)"), "figures[0]: noise must not be negative"}}) {
        const std::string message = messageOf(text);
        EXPECT_NE(message.find(field), std::string::npos) << text << ": " << message;
        EXPECT_EQ(message.rfind(path("figures.json"), 0), 0u) << message;
    }
    const std::string once = R"({"scene": "a", "name": "b", "unit": "%", "value": 1, "noise": 0})";
    EXPECT_NE(messageOf(R"({"figures": [)" + once + "," + once + "]}").find("figures[1]: name"),
              std::string::npos);
}

TEST_F(RegressionFile, TheCommandReadsTheFileBeforeItMeasures) {
    write(path("figures.json"), R"({"figures": 3})");
    expectRefusal("bench regression --figures " + path("figures.json"), "figures must be an array");
    expectRefusal("bench regression --figures " + path("none.json"), "none.json: no such file");
    EXPECT_EQ(limn("bench regression --update").exit, 2) << "into which file?";
}

} // namespace
} // namespace limn::regression_figures_test
