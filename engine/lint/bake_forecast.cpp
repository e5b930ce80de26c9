// SPDX-License-Identifier: MIT
#include "engine/lint/bake_forecast.h"

#include "engine/techniques/technique_table.h"

#include <fmt/format.h>

namespace limn {

const LintRule kBakeMemoryRule = {"bake-memory", Severity::Error,
                                  "A bake needs more memory than is allowed"};
const LintRule kManyTexelsRule = {"many-texels", Severity::Note,
                                  "The objects need more texels than the bake asks for"};

static const Precomputation& precomputationOf(const Scene& scene) {
    return *precomputingTechnique(scene.technique).precomputation;
}

Prediction forecastBake(const Scene& scene) {
    return precomputationOf(scene).predict(scene, false);
}

Result<StageSeconds> forecastSeconds(const TraceScene& trace, const MemoryBudget& memory,
                                     const Progress& progress) {
    const Scene& scene = trace.scene();
    const Precomputation& precomputation = precomputationOf(scene);
    const BakeSettings quick = precomputation.preview(scene.bake);
    const auto trial =
        precomputation.prepare(trace, {.settings = &quick, .memory = memory}, progress);
    if (!trial)
        return tl::make_unexpected(trial.error());
    const PrecomputedReport report = (*trial)->report();
    const PrecomputedCost measured{report.seconds, totalOf(report.bytes), {}, 0};
    return (*trial)->expectedCost(scene, scene.bake, measured).seconds;
}

std::vector<Finding> forecastFindings(const LintScene& in) {
    std::vector<Finding> findings;
    if (in.scene.instances.empty())
        return findings;
    const Prediction prediction = forecastBake(in.scene);
    if (prediction.working > in.memory.maxBytes)
        findings.push_back(
            findingAbout(in, kBakeMemoryRule, 0,
                         fmt::format("A bake needs about {} of memory, and {} are allowed.",
                                     bytesText(prediction.working), bytesText(in.memory.maxBytes)),
                         "Lower its texels, rays or links, or allow more by --memory."));
    if (prediction.minTexels > 0)
        findings.push_back(findingAbout(
            in, kManyTexelsRule, 0,
            fmt::format("Its objects need {} texels, more than the bake asks for.",
                        prediction.minTexels),
            "Join small objects, make some of them dynamic, or ask for that many texels."));
    return findings;
}

} // namespace limn
