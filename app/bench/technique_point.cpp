// SPDX-License-Identifier: MIT
#include "app/bench/technique_point.h"

#include "app/bench/live_light.h"
#include "app/bench/time_limit.h"
#include "app/commands/progress_line.h"

#include "engine/lightmap/atlas.h"
#include "engine/measure/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

/// Columns of the flicker of each Motion.
constexpr std::array<const char*, 3> kFlickerKeys = {"flicker", "camera_flicker", "object_flicker"};

double bytesOf(const std::vector<LightingCounter>& counters) {
    double sum = 0;
    for (const LightingCounter& c : counters)
        sum += c.unit == CounterUnit::Bytes ? c.value : 0;
    return sum;
}

/// A number for JSON, which has no infinities; null: none.
Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Adds leak, flicker and lag to a row, or null for those that the limit left no time for.
Result<void> addLiveColumns(const MeasuredScene& m, const LeakRoom& room, const LightPlace& place,
                            const Configuration& c, LiveLight live, const TimeLimit& limit,
                            Json& row) {
    const Result<double> leak =
        room.leak(place, *c.technique, c.variant.choice, c.variant.bake, limit.progress());
    if (!leak && !limit.over())
        return fail(fmt::format("leak, {}: {}", c.variant.name, leak.error().message));
    row["leak"] = leak ? finite(*leak) : Json(nullptr);
    for (const char* key : kFlickerKeys)
        row[key] = nullptr;
    for (const MotionTruth& truth : m.motions)
        if (const std::optional<double> flicker = live.flicker(truth, limit.progress()))
            row[kFlickerKeys[std::size_t(truth.motion)]] = finite(*flicker);
    const std::optional<std::uint32_t> lag = live.lag(limit.progress());
    row["lag"] = lag ? Json(*lag) : Json(nullptr);
    return {};
}

void addTimes(const UpdateTimes& times, Json& row) {
    row["light_ms"] = times.light;
    row["color_ms"] = times.color ? Json(*times.color) : Json(nullptr);
    row["material_ms"] = times.material;
    row["object_ms"] = times.object ? Json(*times.object) : Json(nullptr);
    row["camera_ms"] = times.camera;
}

void addErrors(const MeasuredScene& m, const ImageF& picture, const ImageF& lit, Json& row) {
    const Comparison all = *compareImages(picture, m.all), one = *compareImages(picture, m.one);
    const Comparison seen = *compareImages(lit, m.lit);
    row["nrmse"] = all.nrmse;
    row["nrmse_without_worst_percent"] = all.nrmseTrimmed;
    row["bias"] = all.bias;
    row["one_bounce_nrmse"] = one.nrmse;
    row["one_bounce_bias"] = one.bias;
    row["nrmse_noise"] = all.nrmseNoise;
    row["ssim"] = seen.ssim;
    row["flip"] = seen.flip;
}

} // namespace

Result<Configuration> configure(const MeasuredScene& m, const Technique& technique, Variant variant,
                                const Progress& progress) {
    Configuration c{.technique = &technique, .variant = std::move(variant), .scene = m.scene};
    c.scene.technique = c.variant.choice;
    Result<PreparedScene> made =
        prepareScene(technique, *m.trace, c.scene, c.variant.bake, progress);
    endProgressLine();
    if (!made)
        return tl::make_unexpected(made.error());
    c.prepared = std::move(made->prepared);
    c.layout = std::move(made->layout);
    if (c.prepared.data) {
        const PrecomputedReport report = c.prepared.data->report();
        c.seconds = totalOf(report.seconds);
        c.bytes = totalOf(report.bytes);
    }
    return c;
}

Result<Point> measurePoint(const MeasuredScene& m, const LeakRoom& room, const LightPlace& place,
                           const Configuration& c, const PointLimits& limits) {
    auto lighting = place.light(*c.technique, c.prepared, c.scene, c.layout);
    if (!lighting)
        return tl::make_unexpected(lighting.error());
    const Viewpoint view = viewpointOf(m.view.camera, {m.view.width, m.view.height});
    const LightingReport first = (*lighting)->update({.scene = c.scene,
                                                      .trace = m.trace.get(),
                                                      .bounces = c.scene.relight.maxBounces,
                                                      .view = viewForAll(**lighting, view),
                                                      .reflections = true},
                                                     {});
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera = m.view.camera;
    options.width = m.view.width;
    options.height = m.view.height;
    FieldRenderOptions whole = options;
    whole.view = View::Lit;
    Point point{{{"scene", m.name},
                 {"width", m.view.width},
                 {"height", m.view.height},
                 {"lights", m.scene.lights.size()},
                 {"technique", c.technique->label},
                 {"settings", c.variant.name},
                 {"device", place.device},
                 {"seconds", c.seconds},
                 {"bytes", (place.onDevice ? 0 : c.bytes) + bytesOf(first.counters)},
                 {"first_ms", first.totalMs}},
                renderLight(*m.trace, **lighting, *c.layout, options)};
    const ImageF lit = renderLight(*m.trace, **lighting, *c.layout, whole);
    addTimes(timeUpdates(**lighting, c.scene, *m.trace, view, limits.runs), point.row);
    addErrors(m, point.picture, lit, point.row);
    const TimeLimit limit(limits.liveSeconds);
    if (const Result<void> added = addLiveColumns(
            m, room, place, c, {std::move(*lighting), c.scene, *m.trace, *c.layout, options}, limit,
            point.row);
        !added)
        return tl::make_unexpected(added.error());
    return point;
}

void addDifference(const ImageF& picture, const ImageF* onCpu, Json& row) {
    row["cpu_difference_rms"] = onCpu ? finite(distanceOf(picture, *onCpu)) : Json(nullptr);
    row["cpu_difference_max"] = onCpu ? finite(largestDifference(picture, *onCpu)) : Json(nullptr);
}

} // namespace limn
