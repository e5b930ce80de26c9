// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/case_file.h"
#include "engine/techniques/illuminance/stress/stress_log.h"
#include "tests/core/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

namespace limn::stress_log_test {
namespace {

const std::vector<Oracle> kOracles = {{"first", "", nullptr}, {"second", "", nullptr}};

CaseResult result(std::uint64_t seed, Judgement first, Judgement second) {
    return {.seed = seed, .milliseconds = 1.5, .judgements = {first, second}, .note = "a, \"b\""};
}

TEST(StressLog, GoesOnBehindTheLastCaseThatEnded) {
    const TemporaryFolder folder;
    {
        StressLog log = *StressLog::open(folder.path.string(), kOracles);
        EXPECT_EQ(log.next(7), 7U);
        for (const std::uint64_t seed : {7U, 8U}) {
            ASSERT_TRUE(log.begin(seed));
            ASSERT_TRUE(log.end(result(seed, judged(0.5, 1), seed == 7 ? notJudged() : broken())));
        }
    }
    std::ofstream(folder.path.string() + "/stress.csv", std::ios::app) << "9,done,1.5,0.5/"; // torn
    const StressLog log = *StressLog::open(folder.path.string(), kOracles);
    EXPECT_EQ(log.next(7), 9U);
    ASSERT_EQ(log.cases().size(), 2U);
    EXPECT_EQ(log.cases()[0].note, "a, 'b'");
    EXPECT_EQ(log.cases()[0].judgements[0].value, 0.5);
    EXPECT_FALSE(log.cases()[0].judgements[1].judged);
    EXPECT_TRUE(log.cases()[1].judgements[1].failed());
}

TEST(StressLog, CountsACaseThatEndedTheProcessAndDoesNotRunItAgain) {
    const TemporaryFolder folder;
    ASSERT_TRUE(StressLog::open(folder.path.string(), kOracles)->begin(4));
    for (int times = 0; times < 2; ++times) {
        const StressLog log = *StressLog::open(folder.path.string(), kOracles);
        ASSERT_EQ(log.cases().size(), 1U);
        EXPECT_EQ(log.cases()[0].end, CaseEnd::Crashed);
        EXPECT_EQ(log.cases()[0].seed, 4U);
        EXPECT_EQ(log.next(0), 5U);
    }
}

TEST(StressLog, RefusesATableOfOtherOracles) {
    const TemporaryFolder folder;
    ASSERT_TRUE(StressLog::open(folder.path.string(), kOracles));
    EXPECT_FALSE(StressLog::open(folder.path.string(), {{"third", "", nullptr}}));
}

TEST(OracleCounts, KeepTheWorstAndTheFirstThatFailed) {
    const std::vector<OracleCount> counts =
        countOracles({result(3, judged(0.5, 1), notJudged()), result(4, judged(3, 2), judged(0, 0)),
                      result(5, judged(9, 10), judged(2, 0))},
                     2);
    EXPECT_EQ(counts[0].judged, 3U);
    EXPECT_EQ(counts[0].failed, 1U);
    EXPECT_EQ(counts[0].worst.value, 3);
    EXPECT_EQ(counts[0].worstSeed, 4U);
    EXPECT_EQ(counts[0].firstFailed, 4U);
    EXPECT_EQ(counts[1].skipped, 1U);
    EXPECT_EQ(counts[1].worst.value, 2);
    EXPECT_EQ(counts[1].firstFailed, 5U);
}

TEST(OracleCounts, NoNumberIsAFailure) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::vector<OracleCount> counts = countOracles(
        {result(1, judged(none, 1), judged(none, 0)), result(2, judged(0.5, 1), judged(0, 0))}, 2);
    for (const OracleCount& c : counts) {
        EXPECT_EQ(c.failed, 1U);
        EXPECT_EQ(c.worstSeed, 1U);
    }
    EXPECT_TRUE(judged(std::numeric_limits<double>::quiet_NaN(), 1).failed());
    EXPECT_FALSE(notJudged().failed());
    double worst = 1;
    raise(worst, std::numeric_limits<double>::quiet_NaN());
    raise(worst, 2);
    EXPECT_EQ(worst, std::numeric_limits<double>::infinity());
}

TEST(CaseFile, BringsTheSameSceneBack) {
    const TemporaryFolder folder;
    const std::string path = folder.path.string() + "/case.json";
    for (const std::uint64_t seed : {5U, 6U, 27U}) {
        const StressCase written = generatedCase(seed);
        ASSERT_TRUE(writeCase(path, written));
        const Result<StressCase> read = readCase(path);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->seed, seed);
        EXPECT_TRUE(read->document == written.document);
        ASSERT_EQ(read->assets->meshes.size(), written.assets->meshes.size());
        for (std::size_t m = 0; m < read->assets->meshes.size(); ++m)
            EXPECT_TRUE(read->assets->meshes[m] == written.assets->meshes[m]);
    }
}

TEST(CaseFile, IsRefusedInWordsWhereItIsDamaged) {
    const TemporaryFolder folder;
    const std::string path = folder.path.string() + "/case.json";
    EXPECT_FALSE(readCase(path));
    for (const char* text :
         {"", "{}", "{\"seed\":1,\"document\":{}}",
          "{\"seed\":1,\"document\":{\"version\":1,\"objects\":[]},\"meshes\":[{\"material\":0,"
          "\"positions\":[0,0,0],\"normals\":[0,1,0],\"indices\":[0,0,1]}]}"}) {
        std::ofstream(path) << text;
        EXPECT_FALSE(readCase(path)) << text;
    }
}

} // namespace
} // namespace limn::stress_log_test
