// SPDX-License-Identifier: MIT
#include "tests/app/command_line.h"

namespace limn::bench_stress_test {
namespace {

TEST_F(CommandLine, BenchStressAsksOraclesAndGoesOnWhereItEnded) {
    const std::string start = "bench stress --device-share 0 -o " + path("oracles") + " --json ";
    const nlohmann::json two = json(start + "--generated 2 --first-seed 190");
    EXPECT_EQ(two["ends"]["cases"], 2);
    std::ofstream(path("oracles/stress.running")) << 192; // as after a crash
    const Outcome more = limn(start + "--generated 4 --first-seed 190");
    EXPECT_EQ(more.exit, 1) << "one crashed";
    const nlohmann::json four = nlohmann::json::parse(more.out);
    EXPECT_EQ(four["ends"]["cases"], 4);
    EXPECT_EQ(four["ends"]["crashed_seeds"], nlohmann::json({192}));
    for (const nlohmann::json& row : four["rows"]) {
        expectKeys(row, {"oracle", "judged", "skipped", "failed", "worst", "limit", "what"});
        EXPECT_EQ(row["judged"].get<int>() + row["skipped"].get<int>(), 4);
        EXPECT_EQ(row["failed"], 0) << row;
    }
    EXPECT_EQ(limn("bench stress -o " + path("none")).exit, 2);
    EXPECT_EQ(limn("bench stress cornell --generated 1 -o " + path("none")).exit, 2);
    EXPECT_EQ(limn("bench stress --case nothing.json -o " + path("none")).exit, 1);
}

} // namespace
} // namespace limn::bench_stress_test
