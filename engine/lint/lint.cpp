// SPDX-License-Identifier: MIT
#include "engine/lint/lint.h"

#include "engine/lint/albedo_rules.h"

#include <algorithm>
#include <iterator>

namespace limn {

std::span<const LintRule* const> lintRules() {
    static const LintRule* const kRules[] = {&kBlackAlbedoRule, &kBrightAlbedoRule};
    return kRules;
}

static std::size_t orderOf(const LintRule* rule) {
    return std::size_t(std::ranges::find(lintRules(), rule) - lintRules().begin());
}

std::optional<std::vector<Finding>> lintScene(const LintScene& in, const Progress& progress) {
    std::vector<Finding> findings;
    const auto add = [&](std::vector<Finding> more) {
        std::ranges::move(more, std::back_inserter(findings));
    };
    progress.at("materials", 0);
    add(albedoFindings(in));
    if (progress.cancelled())
        return std::nullopt;
    std::ranges::stable_sort(findings, [](const Finding& a, const Finding& b) {
        if (a.rule->severity != b.rule->severity)
            return a.rule->severity > b.rule->severity;
        return orderOf(a.rule) < orderOf(b.rule);
    });
    return findings;
}

std::array<std::size_t, 3> countBySeverity(std::span<const Finding> findings) {
    std::array<std::size_t, 3> counts{};
    for (const Finding& finding : findings)
        ++counts[std::size_t(finding.rule->severity)];
    return counts;
}

} // namespace limn
