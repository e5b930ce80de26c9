// SPDX-License-Identifier: MIT
#include "engine/measure/bake_to_error.h"

#include "engine/core/process_memory.h"
#include "engine/measure/seen_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::uint32_t kMaxTexels = 1U << 22, kMaxSurfels = 1U << 20, kMaxLinks = 1024,
                        kMaxRays = 4096;
std::uint32_t times(std::uint32_t count, double factor, std::uint32_t maximum) {
    return std::max(count, std::uint32_t(std::min(std::round(count * factor), double(maximum))));
}

Result<Comparison> measure(const TraceScene& trace, const Prepared& prepared,
                           const SeenTruth& truth, const Progress& progress) {
    const Scene& scene = trace.scene();
    const auto lighting = prepared.data->technique().light(prepared);
    lighting->update({.scene = scene, .trace = &trace, .bounces = scene.relight.maxBounces},
                     progress);
    if (progress.cancelled())
        return fail("cancelled");
    return compareWithTruth(trace, *lighting, prepared.data->layout(), truth);
}

bool fits(const Technique& technique, const Scene& scene, const BakeSettings& settings, bool stored,
          const MemoryBudget& memory) {
    Scene finer = scene;
    finer.bake = settings;
    return residentMemory() + technique.precomputation->predict(finer, stored).working <=
           memory.maxBytes;
}

} // namespace

std::string shortfall(const MeasuredBake& made, double error) {
    const char* why = "";
    switch (made.end) {
    case MeasuredBake::End::Held:
        return {};
    case MeasuredBake::End::NoBetter:
        why = "more texels hardly reduce it";
        break;
    case MeasuredBake::End::Memory:
        why = "a finer bake would need more memory than is allowed";
        break;
    case MeasuredBake::End::Finest:
        why = "no settings are finer";
        break;
    }
    return fmt::format("the error is {:.3f}, not {:g}: {}", made.error.nrmse, error, why);
}

BakeSettings finerSettings(const BakeSettings& settings) {
    BakeSettings s = settings;
    s.lightmapCaches = times(s.lightmapCaches, 2, kMaxTexels);
    if (s.lightmapCaches == settings.lightmapCaches)
        return settings;
    s.surfels = times(s.surfels, std::exp2(0.75), kMaxSurfels);
    s.links = times(s.links, std::exp2(0.25), kMaxLinks);
    s.rays = times(s.rays, std::exp2(0.75), kMaxRays);
    return s;
}

Result<MeasuredBake> bakeToError(const Technique& technique, const TraceScene& trace,
                                 const ErrorGoal& goal, const Progress& progress, StageStore* store,
                                 const MemoryBudget& memory,
                                 const std::function<void(const MeasuredBake&)>& baked) {
    using End = MeasuredBake::End;
    BakeSettings settings = trace.scene().bake;
    const auto scene = std::make_shared<const Scene>(trace.scene());
    std::optional<SeenTruth> truth;
    MeasuredBake best;
    for (int inVain = 0;;) {
        const auto made = technique.precomputation->prepare(
            trace, {.settings = &settings, .store = store, .memory = memory}, progress);
        if (!made)
            return tl::make_unexpected(made.error());
        MeasuredBake next{*made, {}, End::Held};
        if (!truth)
            truth = findSeenTruth(trace, goal.camera, TruthSize{}, progress);
        if (!truth)
            return fail("cancelled");
        if (truth->isDark())
            return fail("the camera sees no light, so no error is known");
        Result<Comparison> error = measure(trace, {next.bake, scene}, *truth, progress);
        if (!error)
            return tl::make_unexpected(error.error());
        next.error = *error;
        if (baked)
            baked(next);
        const double before = best.bake ? best.error.nrmse : std::numeric_limits<double>::max();
        inVain = next.error.nrmse > 0.9 * before ? inVain + 1 : 0;
        if (next.error.nrmse < before)
            best = std::move(next);
        if (best.error.nrmse <= goal.nrmse)
            return best;
        const BakeSettings finer = finerSettings(settings);
        if (inVain == 2)
            best.end = End::NoBetter;
        else if (finer == settings)
            best.end = End::Finest;
        else if (!fits(technique, trace.scene(), finer, store != nullptr, memory))
            best.end = End::Memory;
        if (best.end != End::Held)
            return best;
        settings = finer;
    }
}

} // namespace limn
