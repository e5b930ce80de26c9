// SPDX-License-Identifier: MIT
#include "engine/lint/lint.h"

#include "engine/lint/albedo_rules.h"
#include "engine/lint/back_rules.h"
#include "engine/lint/bake_forecast.h"
#include "engine/lint/light_rules.h"
#include "engine/lint/size_rules.h"
#include "engine/lint/uv_rules.h"
#include "engine/lint/wall_rules.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace limn {

std::span<const LintRule* const> lintRules() {
    static const LintRule* const kRules[] = {
        &kBakeMemoryRule,          &kManyTexelsRule,  &kMissingUvRule,   &kDegenerateUvRule,
        &kLightmapUvRule,          &kThinWallRule,    &kBackFacesRule,   &kBlackAlbedoRule,
        &kBrightAlbedoRule,        &kUnseenLightRule, &kDimLightRule,    &kStrongLightRule,
        &kZeroLightRule,           &kDarkSceneRule,   &kTinyMeshRule,    &kSceneSizeRule,
        &kDegenerateTrianglesRule, &kNonFiniteRule,   &kRepairedFileRule};
    return kRules;
}

static std::size_t orderOf(const LintRule* rule) {
    return std::size_t(std::ranges::find(lintRules(), rule) - lintRules().begin());
}

/// Leaves out thin walls that are inside out: these are solids, whose fronts look as if they had
/// nothing behind them.
static void mergeFindings(std::vector<Finding>& findings) {
    std::set<ObjectId> insideOut;
    for (const Finding& f : findings)
        if (f.rule == &kBackFacesRule)
            insideOut.insert(f.object);
    std::erase_if(findings, [&](const Finding& f) {
        return f.rule == &kThinWallRule && insideOut.contains(f.object);
    });
}

std::optional<std::vector<Finding>> lintScene(const LintScene& in, const Progress& progress) {
    std::vector<Finding> findings;
    const auto add = [&](std::vector<Finding> more) {
        std::ranges::move(more, std::back_inserter(findings));
    };
    progress.at("materials", 0);
    add(albedoFindings(in));
    add(sizeFindings(in));
    add(forecastFindings(in));
    add(uvFindings(in, progress));
    if (!progress.cancelled())
        add(backFindings(in, progress));
    if (!progress.cancelled())
        add(lightFindings(in, progress));
    if (!progress.cancelled())
        add(wallFindings(in, progress));
    if (progress.cancelled())
        return std::nullopt;
    mergeFindings(findings);
    std::ranges::stable_sort(findings, [](const Finding& a, const Finding& b) {
        if (a.severity != b.severity)
            return a.severity > b.severity;
        return orderOf(a.rule) < orderOf(b.rule);
    });
    return findings;
}

std::array<std::size_t, 3> countBySeverity(std::span<const Finding> findings) {
    std::array<std::size_t, 3> counts{};
    for (const Finding& finding : findings)
        ++counts[std::size_t(finding.severity)];
    return counts;
}

} // namespace limn
