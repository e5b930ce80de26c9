// SPDX-License-Identifier: MIT
#include "app/bench/scene_bench.h"

#include "app/bench/technique_point.h"
#include "app/bench/time_limit.h"
#include "app/commands/progress_line.h"

#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/measure/compare.h"
#include "engine/scene/tone_map.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

/// Shares of a scene's time. One configuration is a technique with some settings in one place.
constexpr double kPreparingShare = 0.3; ///< of what is left, for one precomputation
constexpr double kKindShare = 1. / 300; ///< for updates of one kind of one configuration
constexpr double kLiveShare = 1. / 60;  ///< for flicker and lag of one configuration

/// The time that the techniques of a scene may take.
class SceneTime {
public:
    /// std::nullopt: no limit.
    explicit SceneTime(std::optional<double> seconds) : m_seconds(seconds) {}

    double passed() { return m_passed += m_clock.lap() / 1000; } ///< [s]
    bool over() { return m_seconds && passed() >= *m_seconds; }
    /// A share of all the time, or of what is left of it [s].
    std::optional<double> share(double fraction) const {
        return m_seconds ? std::optional(fraction * *m_seconds) : std::nullopt;
    }
    std::optional<double> shareOfRest(double fraction) {
        return m_seconds ? std::optional(fraction * std::max(*m_seconds - passed(), 0.))
                         : std::nullopt;
    }

private:
    std::optional<double> m_seconds;
    Stopwatch m_clock;
    double m_passed = 0;
};

/// Exposure at which a picture's mean is middle grey [stops].
float exposureOf(const ImageF& image) {
    const double mean = meanOf(image);
    return mean > 0 ? float(std::log2(double(kMiddleGrey) / mean)) : 0;
}

bool isWanted(const SceneBenchOptions& o, const Technique& technique) {
    return o.techniques.empty() || std::ranges::count(o.techniques, technique.name) > 0;
}

/// What benchScene() measures and what it leaves out.
struct Plan {
    struct Entry {
        const Technique* technique;
        Variant variant;
    };
    std::vector<Entry> entries;     ///< the first settings of each technique, then the second, …
    std::size_t configurations = 0; ///< in all places
    std::vector<std::string> notHere; ///< "TECHNIQUE does not light on DEVICE"
};

Plan planOf(const SceneBenchOptions& o, const std::vector<LightPlace>& places,
            const BakeSettings& bake) {
    Plan plan;
    std::vector<std::pair<const Technique*, std::vector<Variant>>> variants;
    std::size_t maxVariants = 0;
    for (const Technique* technique : techniques()) {
        if (!isWanted(o, *technique))
            continue;
        variants.emplace_back(technique, variantsOf(*technique, bake, o.varied));
        maxVariants = std::max(maxVariants, variants.back().second.size());
        for (const LightPlace& place : places)
            if (place.lights(*technique))
                plan.configurations += variants.back().second.size();
            else
                plan.notHere.push_back(
                    fmt::format("{} does not light on {}", technique->label, place.device));
    }
    for (std::size_t k = 0; k < maxVariants; ++k)
        for (const auto& [technique, all] : variants)
            if (k < all.size())
                plan.entries.push_back({technique, all[k]});
    return plan;
}

/// Measures all techniques of one scene.
class SceneBench {
public:
    SceneBench(const SceneBenchOptions& o, const LeakRoom& room,
               const std::vector<LightPlace>& places, const MeasuredScene& m)
        : m_options(o), m_room(room), m_places(places), m_measured(m), m_time(o.seconds) {}

    Result<PageScene> run();

private:
    void skip(const std::string& what, const std::string& why);
    void measureEverywhere(const Configuration& configuration);
    std::size_t placesOf(const Technique& technique) const;
    PageScene page(const Plan& plan);

    const SceneBenchOptions& m_options;
    const LeakRoom& m_room;
    const std::vector<LightPlace>& m_places;
    const MeasuredScene& m_measured;
    SceneTime m_time;
    std::size_t m_begun = 0, m_all = 0; ///< configurations
    std::vector<std::string> m_skipped;
    std::vector<std::pair<const Technique*, Point>> m_points;
};

/// Number of places that can light by the technique.
std::size_t SceneBench::placesOf(const Technique& technique) const {
    return std::size_t(std::ranges::count_if(
        m_places, [&](const LightPlace& place) { return place.lights(technique); }));
}

void SceneBench::skip(const std::string& what, const std::string& why) {
    m_skipped.push_back(fmt::format("{}: {}", what, why));
    logWarning(fmt::format("{}: skipped {}", m_measured.name, m_skipped.back()));
}

void SceneBench::measureEverywhere(const Configuration& c) {
    PointLimits limits{{.maxRuns = m_options.runs}, m_time.share(kLiveShare)};
    if (const auto seconds = m_time.share(kKindShare))
        limits.runs.enoughMs = std::min(1000 * *seconds, limits.runs.enoughMs);
    std::optional<ImageF> onCpu;
    for (const LightPlace& place : m_places) {
        if (!place.lights(*c.technique))
            continue;
        const std::string what =
            fmt::format("{}, {}, on {}", c.technique->label, c.variant.name, place.device);
        logInfo(fmt::format("{}, {} of {}, after {:.0f} s: {}", m_measured.name, m_begun++ + 1,
                            m_all, m_time.passed(), what));
        Result<Point> point = measurePoint(m_measured, m_room, place, c, limits);
        if (!point) { // the device is too small
            skip(what, point.error().message);
            continue;
        }
        addDifference(point->picture, place.onDevice && onCpu ? &*onCpu : nullptr, point->row);
        if (!place.onDevice)
            onCpu = point->picture;
        m_options.show(point->row);
        m_points.emplace_back(c.technique, std::move(*point));
    }
}

Result<PageScene> SceneBench::run() {
    const Plan plan = planOf(m_options, m_places, m_measured.scene.bake);
    m_all = plan.configurations;
    for (const std::string& text : plan.notHere)
        logInfo(text);
    std::vector<const Technique*> tooSlow; // whose precomputation was given up
    for (const auto& [technique, variant] : plan.entries) {
        const std::string what = fmt::format("{}, {}", technique->label, variant.name);
        const std::size_t before = m_begun;
        if (m_time.over()) {
            skip(what, "the time was over");
        } else if (std::ranges::count(tooSlow, technique) > 0) {
            skip(what, "coarser settings took too long to precompute already");
        } else {
            const TimeLimit limit(m_time.shareOfRest(kPreparingShare));
            const Result<Configuration> made =
                configure(m_measured, *technique, variant, limit.progress(progressOnStderr()));
            if (made) {
                measureEverywhere(*made);
            } else if (limit.over()) {
                skip(what, "takes too long to precompute");
                tooSlow.push_back(technique);
            } else {
                return fail(fmt::format("{}, {}: {}", m_measured.name, what, made.error().message));
            }
        }
        m_begun = before + placesOf(*technique);
    }
    return page(plan);
}

PageScene SceneBench::page(const Plan& plan) {
    const MeasuredScene& m = m_measured;
    const ImageF truth = meanImage(m.all.first(), m.all.second());
    const float exposure = exposureOf(truth);
    PageScene page{m.name,
                   fmt::format("{} x {} pixels; standard error of a reference's pixel {:.3f} of "
                               "the mean, {:.3f} with one bounce.",
                               m.view.width, m.view.height, noiseOf(m.all), noiseOf(m.one)),
                   {},
                   {{"Reference", toneMappedImage(truth, Tonemap::Aces, exposure)}}};
    for (const std::string& text : plan.notHere)
        page.note += " " + text + ".";
    if (m_options.seconds)
        page.note += fmt::format(" The techniques had {:g} s, so that fewer updates count.",
                                 *m_options.seconds);
    for (const std::string& text : m_skipped)
        page.note += " Skipped: " + text + ".";
    for (const Technique* technique : techniques()) {
        const Point* best = nullptr;
        for (const auto& [pointTechnique, point] : m_points) {
            if (pointTechnique != technique)
                continue;
            page.rows.push_back(point.row);
            if (!best || point.row["nrmse"].get<double>() < best->row["nrmse"].get<double>())
                best = &point;
        }
        if (!best)
            continue;
        const std::string what =
            fmt::format("{}, {}", technique->label, best->row["settings"].get<std::string>());
        page.pictures.push_back({what, toneMappedImage(best->picture, Tonemap::Aces, exposure)});
        page.pictures.push_back(
            {what + ": blue is too dark, orange too bright", errorHeatmap(best->picture, truth)});
    }
    return page;
}

} // namespace

Result<PageScene> benchScene(const SceneBenchOptions& options, const LeakRoom& room,
                             const std::vector<LightPlace>& places, const MeasuredScene& scene) {
    return SceneBench(options, room, places, scene).run();
}

} // namespace limn
