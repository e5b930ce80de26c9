// SPDX-License-Identifier: MIT
#include "engine/measure/bake_to_error.h"

#include "engine/core/parallel.h"
#include "engine/core/process_memory.h"
#include "engine/measure/seen_points.h"
#include "engine/shading/direct_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::uint32_t kMaxTexels = 1U << 22, kMaxSurfels = 1U << 20, kMaxLinks = 1024,
                        kMaxRays = 4096;
constexpr std::uint32_t kWidth = 96, kHeight = 54; ///< numbers of points across and down
constexpr std::uint32_t kPaths = 64;               ///< number for a point, in each reference

std::uint32_t times(std::uint32_t count, double factor, std::uint32_t maximum) {
    return std::max(count, std::uint32_t(std::min(std::round(count * factor), double(maximum))));
}

/// Reference at the visible points: direct irradiance, and irradiance with all bounces, estimated
/// twice by independent paths. The images have one row.
struct Truth {
    std::vector<SeenPoint> points;
    ImageF direct, first, second;
};

ImageF row(std::vector<glm::vec3> rgb) {
    const auto width = std::uint32_t(rgb.size());
    return {width, 1, std::move(rgb)};
}

ImageF sum(ImageF image, const std::vector<glm::vec3>& more) {
    for (std::size_t i = 0; i < more.size(); ++i)
        image.rgb[i] += more[i];
    return image;
}

/// Computes the reference; std::nullopt when cancelled.
std::optional<Truth> findTruth(const TraceScene& trace, const Camera& camera,
                               const Progress& progress) {
    Truth truth;
    truth.points = findSeenPoints(trace, camera, kWidth, kHeight, 1);
    std::vector<glm::vec3> direct(truth.points.size());
    parallelRanges(direct.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::uint64_t rays = 0;
        for (std::size_t i = begin; i < end; ++i)
            direct[i] = directIrradiance(trace, truth.points[i].surface, rays);
    });
    truth.direct = row(std::move(direct));
    const Emitters emitters = findEmitters(trace);
    const SkyLight sky = findSkyLight(trace.scene().sky);
    const PathContext context{trace, emitters, sky};
    const auto first = traceIrradiance(context, truth.points, kPaths, 2, progress),
               second = traceIrradiance(context, truth.points, kPaths, 3, progress);
    if (!first || !second)
        return {};
    truth.first = sum(truth.direct, *first);
    truth.second = sum(truth.direct, *second);
    return truth;
}

bool isDark(const Truth& truth) {
    return std::ranges::all_of(truth.first.rgb, [](glm::vec3 e) { return e == glm::vec3(0); });
}

Result<Comparison> measure(const TraceScene& trace, const Prepared& prepared, const Truth& truth,
                           const Progress& progress) {
    const Scene& scene = trace.scene();
    const auto lighting = prepared.data->technique().light(prepared);
    lighting->update({.scene = scene, .trace = &trace, .bounces = scene.relight.maxBounces},
                     progress);
    if (progress.cancelled())
        return fail("cancelled");
    const Result<Comparison> error = compareImages(
        sum(truth.direct,
            lookUpIrradiance(*lighting->field(), prepared.data->layout(), scene, truth.points)),
        truth.first, truth.second);
    return error;
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
    std::optional<Truth> truth;
    MeasuredBake best;
    for (int inVain = 0;;) {
        const auto made = technique.precomputation->prepare(
            trace, {.settings = &settings, .store = store, .memory = memory}, progress);
        if (!made)
            return tl::make_unexpected(made.error());
        MeasuredBake next{*made, {}, End::Held};
        if (!truth)
            truth = findTruth(trace, goal.camera, progress);
        if (!truth)
            return fail("cancelled");
        if (isDark(*truth))
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
