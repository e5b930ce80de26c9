// SPDX-License-Identifier: MIT
// Rooms with one fault each: it is found, and nothing else.
#include "tests/lint/lint_room.h"

#include <gtest/gtest.h>

namespace limn::lint_test {
namespace {

std::string textOf(const std::vector<Finding>& findings) {
    std::string text;
    for (const Finding& f : findings)
        text += std::string(f.rule->name) + " " + f.path + ": " + f.problem + "\n";
    return text;
}

/// Expects one finding, of that rule about that object.
void expectOnly(const LintRoom& room, std::string_view rule, ObjectId object) {
    const std::vector<Finding> findings = room.lint();
    ASSERT_EQ(findings.size(), 1U) << textOf(findings);
    EXPECT_EQ(findings[0].rule->name, rule) << textOf(findings);
    EXPECT_EQ(findings[0].object, object) << textOf(findings);
    EXPECT_TRUE(findings[0].problem.ends_with('.')) << findings[0].problem;
    EXPECT_TRUE(findings[0].advice.ends_with('.')) << findings[0].advice;
}

TEST(PlantedFaults, NoneAreFoundInACleanRoom) {
    EXPECT_EQ(textOf(CleanRoom().lint()), "");
}

TEST(PlantedFaults, BlackAlbedo) {
    CleanRoom room;
    room.material(2).baseColor = {0, 0, 0, 1};
    expectOnly(room, "black-albedo", room.table);
}

TEST(PlantedFaults, BrightAlbedo) {
    CleanRoom room;
    room.material(2).baseColor = {1, 1, 1, 1};
    expectOnly(room, "bright-albedo", room.table);
}

} // namespace
} // namespace limn::lint_test
