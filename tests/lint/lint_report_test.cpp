// SPDX-License-Identifier: MIT
#include "engine/lint/lint.h"
#include "engine/lint/lint_report.h"

#include <set>

#include <gtest/gtest.h>

namespace limn::lint_test {
namespace {

std::vector<Finding> someFindings() {
    return {{lintRules()[0], Severity::Warning, 3, "House/Wall", "It is wrong.", "Mend it.",
             glm::dvec3(1, 2, 3)},
            {lintRules()[1], Severity::Note, 0, "", "All is wrong.", "Mend all."}};
}

TEST(LintRules, HaveNamesOfTheirOwnInKebabCase) {
    std::set<std::string_view> names;
    for (const LintRule* rule : lintRules()) {
        EXPECT_TRUE(names.insert(rule->name).second) << rule->name;
        EXPECT_EQ(rule->name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"),
                  std::string_view::npos)
            << rule->name;
        EXPECT_FALSE(rule->summary.empty()) << rule->name;
    }
}

TEST(LintReport, NamesPlacesAndObjects) {
    const Json all = findingsJson(someFindings());
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0]["rule"].get<std::string>(), lintRules()[0]->name);
    EXPECT_EQ(all[0]["path"].get<std::string>(), "House/Wall");
    EXPECT_EQ(all[0]["place"], Json::array({1., 2., 3.}));
    EXPECT_TRUE(all[1]["place"].isNull());
}

// The schema of SARIF 2.1.0 requires a version and runs of a log, a tool of a run, a driver of a
// tool, a name of a driver, an id of a rule, and a message of a result. Its text asks for levels by
// name, indices of rules, and URIs without blanks.
TEST(LintReport, HasWhatTheSchemaOfSarifRequires) {
    const Json log = sarifLog(someFindings(), "my scenes/a:b.gltf", "limn 1");
    EXPECT_EQ(log["version"].get<std::string>(), "2.1.0");
    ASSERT_EQ(log["runs"].size(), 1U);
    const Json& run = log["runs"][0];
    const Json& driver = run["tool"]["driver"];
    EXPECT_FALSE(driver["name"].get<std::string>().empty());
    ASSERT_EQ(driver["rules"].size(), lintRules().size());
    ASSERT_EQ(run["results"].size(), 2U);
    const std::set<std::string> levels = {"none", "note", "warning", "error"};
    for (const Json& result : run["results"]) {
        EXPECT_FALSE(result["message"]["text"].get<std::string>().empty());
        EXPECT_TRUE(levels.contains(result["level"].get<std::string>()));
        const auto index = result["ruleIndex"].get<std::size_t>();
        EXPECT_EQ(driver["rules"][index]["id"], result["ruleId"]);
        const Json& location = result["locations"][0];
        EXPECT_EQ(location["physicalLocation"]["artifactLocation"]["uri"].get<std::string>(),
                  "my%20scenes/a%3Ab.gltf");
    }
    EXPECT_EQ(run["results"][0]["locations"][0]["logicalLocations"][0]["fullyQualifiedName"]
                  .get<std::string>(),
              "House/Wall");
}

} // namespace
} // namespace limn::lint_test
