// SPDX-License-Identifier: MIT
#include "engine/lint/lint_report.h"

#include "engine/core/percent_encoding.h"
#include "engine/lint/lint.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace limn {

static Json placeJson(const Finding& finding) {
    if (!finding.place)
        return nullptr;
    return Json::array({finding.place->x, finding.place->y, finding.place->z});
}

Json findingsJson(std::span<const Finding> findings) {
    Json all = Json::array();
    for (const Finding& f : findings)
        all.push_back({{"rule", f.rule->name},
                       {"severity", severityName(f.severity)},
                       {"object", f.object},
                       {"path", f.path},
                       {"problem", f.problem},
                       {"advice", f.advice},
                       {"place", placeJson(f)}});
    return all;
}

static Json ruleJson(const LintRule& rule) {
    return {{"id", rule.name},
            {"shortDescription", {{"text", rule.summary}}},
            {"defaultConfiguration", {{"level", severityName(rule.severity)}}}};
}

static Json resultJson(const Finding& f, const std::string& uri) {
    const auto rules = lintRules();
    Json location = {{"physicalLocation", {{"artifactLocation", {{"uri", uri}}}}}};
    if (!f.path.empty())
        location["logicalLocations"] =
            Json::array({Json{{"fullyQualifiedName", f.path}, {"kind", "object"}}});
    Json result = {{"ruleId", f.rule->name},
                   {"ruleIndex", std::ranges::find(rules, f.rule) - rules.begin()},
                   {"level", severityName(f.severity)},
                   {"message", {{"text", f.problem + " " + f.advice}}},
                   {"locations", Json::array({location})}};
    if (f.place)
        result["properties"] = {{"place", placeJson(f)}};
    return result;
}

Json sarifLog(std::span<const Finding> findings, const std::string& scene,
              const std::string& version) {
    Json rules = Json::array(), results = Json::array();
    for (const LintRule* rule : lintRules())
        rules.push_back(ruleJson(*rule));
    const std::string uri = percentEncoded(scene);
    for (const Finding& finding : findings)
        results.push_back(resultJson(finding, uri));
    Json driver = {{"name", "limn lint"}, {"version", version}};
    driver["rules"] = rules;
    Json run = {{"tool", {{"driver", driver}}}, {"columnKind", "utf16CodeUnits"}};
    run["results"] = results;
    return {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
            {"version", "2.1.0"},
            {"runs", Json::array({run})}};
}

} // namespace limn
