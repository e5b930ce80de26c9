// SPDX-License-Identifier: MIT
#include "app/papers/paper_experiments.h"
#include "app/papers/paper_view.h"

#include "app/bench/light_place.h"
#include "app/bench/moving_lights.h"
#include "app/bench/place_on_device.h"
#include "app/commands/progress_line.h"

#include "engine/lighting/fastest_update.h"
#include "engine/techniques/technique_table.h"

#include <array>
#include <functional>

#include <fmt/format.h>

namespace limn {

namespace {

const PaperScene kPaperLivingRoom = {.name = "living-room",
                                     .file = "living-room/living-room.gltf",
                                     .light = "sun dir=0.5,-0.6,-1 lux=50000"};

/// A technique with its settings, as a line of Tables 3 and 4 has it.
struct BrowserTechnique {
    const char* name; ///< for people
    const char* technique;
    std::vector<std::pair<std::string, double>> settings;
    std::optional<double> idle, change; ///< printed [ms]
    std::optional<double> seconds;      ///< printed, of what is computed in advance
};

/// Light of a scene in a place, ready for updates.
struct BrowserLight {
    PreparedScene prepared;
    std::unique_ptr<Lighting> lighting;
    double seconds = 0; ///< of what was computed in advance
};

Result<BrowserLight> lightWith(const LightPlace& place, const TraceScene& trace,
                               const Scene& scene) {
    const Technique& technique = *findTechnique(scene.technique.technique);
    Result<PreparedScene> prepared =
        prepareScene(technique, trace, scene, scene.bake, progressOnStderr());
    if (!prepared)
        return tl::make_unexpected(prepared.error());
    BrowserLight light{std::move(*prepared), nullptr, 0};
    if (light.prepared.prepared.data)
        light.seconds = totalOf(light.prepared.prepared.data->report().seconds);
    Result<std::unique_ptr<Lighting>> made =
        place.light(technique, light.prepared.prepared, scene, light.prepared.layout);
    if (!made)
        return tl::make_unexpected(made.error());
    light.lighting = std::move(*made);
    return light;
}

/// Median of updates to the scene of each run, the first of which does not count, with its 95th
/// percentile over the median as the noise.
PaperFigure timeUpdatesOf(const char* column, Lighting& lighting, const TraceScene& trace, int runs,
                          const Viewpoint& view, const std::function<Scene(int)>& sceneOf,
                          std::optional<double> printed) {
    std::vector<double> ms;
    for (int k = 0; k <= runs; ++k) {
        const Scene scene = sceneOf(k);
        const LightingReport report = lighting.update(
            {.scene = scene, .trace = &trace, .bounces = 1, .view = viewForAll(lighting, view)},
            {});
        if (k > 0)
            ms.push_back(report.totalMs);
    }
    return timeFigure(column, ms, printed);
}

/// Sponza's sun and `count` spots that shine from points over its surfaces onto these.
Scene withSpots(const Scene& scene, std::uint32_t count) {
    Scene lit = scene;
    const SurfacePoints points = spreadPoints(scene, 512);
    for (Light& spot : pointsOver(scene, points.positions, points.normals, count)) {
        spot.kind = LightKind::Spot;
        spot.direction = {0, -1, 0};
        spot.innerAngle = 0.3f;
        spot.outerAngle = 0.5f; // one view of a reflective shadow map
        lit.lights.push_back(spot);
    }
    return lit;
}

Scene withColors(const Scene& scene, int k) {
    Scene changed = scene;
    for (Light& light : changed.lights)
        light.strength *= 1 + 0.1f * float(k % 2);
    return changed;
}

Result<std::vector<LightPlace>> placesOf(const PaperRun& run) {
    std::vector<LightPlace> places = {placeOnCpu()};
    if (run.options().onDevice) {
        Result<LightPlace> device = placeOnDevice(run.options().device);
        if (!device)
            return tl::make_unexpected(device.error());
        places.push_back(std::move(*device));
    }
    return places;
}

const char* nameOf(const LightPlace& place) {
    return place.onDevice ? "device" : "CPU";
}

/// Tables 1 and 2: `moving` tells them apart.
Result<void> measureSpots(PaperRun& run, const char* experiment, bool moving,
                          std::span<const std::pair<std::uint32_t, double>> printed) {
    const Result<std::vector<LightPlace>> places = placesOf(run);
    if (!places)
        return tl::make_unexpected(places.error());
    const int runs = std::min(run.options().runs, 5);
    for (const LightPlace& place : *places)
        for (const auto& [count, ms] : printed) {
            const auto measure = [&]() -> Result<PaperLine> {
                const Result<const FrontScene*> front = run.scene(kPaperSponza);
                if (!front)
                    return tl::make_unexpected(front.error());
                Scene scene = withSpots((*front)->scene, count);
                scene.technique = {.technique = "lpv",
                                   .settings = {{"lpv.resolution", 32},
                                                {"lpv.rounds", 16},
                                                {"lpv.map_size", moving ? 512 : 128}}};
                const Result<BrowserLight> light = lightWith(place, *(*front)->trace, scene);
                if (!light)
                    return tl::make_unexpected(light.error());
                const Viewpoint view = viewpointOf((*front)->view.camera,
                                                   {(*front)->view.width, (*front)->view.height});
                return PaperLine{{},
                                 {timeUpdatesOf(
                                     "update [ms]", *light->lighting, *(*front)->trace, runs, view,
                                     [&](int k) {
                                         return moving ? withMovedLights(scene, k)
                                                       : withColors(scene, k);
                                     },
                                     ms)},
                                 {}};
            };
            const std::string name = fmt::format("{} spots, {}", count, nameOf(place));
            if (const Result<void> added = run.line(experiment, name, measure); !added)
                return added;
        }
    return {};
}

Result<void> measureMovingSpots(PaperRun& run) {
    constexpr std::array<std::pair<std::uint32_t, double>, 6> kPrinted = {
        {{0, 6.13}, {5, 18.18}, {10, 71.43}, {15, 71.43}, {20, 90.90}, {25, 111.11}}};
    return measureSpots(run, "web-T1", true, kPrinted);
}

Result<void> measureStillSpots(PaperRun& run) {
    constexpr std::array<std::pair<std::uint32_t, double>, 6> kPrinted = {
        {{0, 2.44}, {50, 7.14}, {100, 20.}, {150, 29.41}, {200, 41.66}, {250, 50.}}};
    return measureSpots(run, "web-T2", false, kPrinted);
}

/// Figures of a technique in a place: times of updates, seconds in advance, and errors.
Result<PaperLine> measureTechnique(PaperRun& run, const PaperView& view, const char* experiment,
                                   const std::string& name, const BrowserTechnique& wanted,
                                   const LightPlace& place) {
    const Result<const FrontScene*> front = openView(run, view);
    if (!front)
        return tl::make_unexpected(front.error());
    const ReferenceOptions& shown = (*front)->view;
    const TraceScene& trace = *(*front)->trace;
    Scene scene = (*front)->scene;
    scene.technique.technique = wanted.technique;
    for (const auto& [key, value] : wanted.settings)
        scene.technique.settings[key] = value;
    const Result<BrowserLight> light = lightWith(place, trace, scene);
    if (!light)
        return tl::make_unexpected(light.error());
    Lighting& lighting = *light->lighting;
    const Viewpoint seen = viewpointOf(shown.camera, {shown.width, shown.height});
    const int runs = std::min(run.options().runs, 5);
    std::vector<PaperFigure> figures;
    figures.push_back(timeUpdatesOf(
        "on change [ms]", lighting, trace, runs, seen,
        [&](int k) { return withMovedLights(scene, k); }, wanted.change));
    lighting.update({.scene = scene,
                     .trace = &trace,
                     .bounces = scene.relight.maxBounces,
                     .view = viewForAll(lighting, seen)},
                    progressOnStderr());
    figures.push_back(
        timeUpdatesOf("idle [ms]", lighting, trace, runs, seen, [&](int) { return scene; }, {}));
    if (wanted.idle)
        figures.push_back({"frame, idle [ms]", std::nullopt, 0, wanted.idle});
    if (light->seconds > 0)
        figures.push_back({"in advance [s]", light->seconds, 0, wanted.seconds});
    const ImageF picture = renderLight(trace, lighting, *light->prepared.layout,
                                       {.view = shown.view,
                                        .camera = shown.camera,
                                        .width = shown.width,
                                        .height = shown.height,
                                        .samplesPerPixel = kPaperPictureSamples});
    const Result<Comparison> error = compareImages(picture, (*front)->truth);
    if (!error)
        return tl::make_unexpected(error.error());
    figures.push_back(errorFigure(*error));
    figures.push_back(biasFigure(*error));
    return withPicture(run, view, experiment, name, picture, std::move(figures));
}

/// Techniques in a view, wherever they can light, after the reference.
Result<void> measureTechniques(PaperRun& run, const char* experiment, const PaperView& view,
                               std::span<const BrowserTechnique> techniques) {
    const Result<std::vector<LightPlace>> places = placesOf(run);
    if (!places)
        return tl::make_unexpected(places.error());
    if (const Result<void> added = addReference(run, view, experiment); !added)
        return added;
    for (const BrowserTechnique& wanted : techniques)
        for (const LightPlace& place : *places) {
            if (!place.lights(*findTechnique(wanted.technique)))
                continue;
            const std::string name = fmt::format("{}, {}", wanted.name, nameOf(place));
            if (const Result<void> added = run.line(
                    experiment, name,
                    [&] { return measureTechnique(run, view, experiment, name, wanted, place); });
                !added)
                return added;
        }
    return {};
}

const PaperView kSponza{.scene = &kPaperSponza}, kLivingRoom{.scene = &kPaperLivingRoom};

const std::vector<std::pair<std::string, double>> kLpv = {
    {"lpv.resolution", 32}, {"lpv.rounds", 16}, {"lpv.map_size", 512}};

Result<void> measureSponzaTechniques(PaperRun& run) {
    const std::vector<BrowserTechnique> techniques = {
        {"1, light field probes, 256", "probes", {{"probes.count", 256}}, 4.78, 13.70, {}},
        {"2, sparse probes", "sparse-probes", {}, 2.47, 4.57, 58. * 60},
        {"3, light propagation volumes", "lpv", kLpv, 2.44, 6.13, {}},
        {"ambient light", "ambient", {}, {}, {}, {}},
        {"illuminance composition", "illuminance", {}, {}, {}, {}}};
    return measureTechniques(run, "web-T3", kSponza, techniques);
}

Result<void> measureLivingRoomTechniques(PaperRun& run) {
    const std::vector<BrowserTechnique> techniques = {
        {"1, light field probes, 36", "probes", {{"probes.count", 36}}, 5.81, 21.28, {}},
        {"2, sparse probes", "sparse-probes", {}, 1.86, 4.17, 58. * 60},
        {"3, light propagation volumes", "lpv", kLpv, 3.50, 6.71, {}},
        {"ambient light", "ambient", {}, {}, {}, {}},
        {"illuminance composition", "illuminance", {}, {}, {}, {}}};
    return measureTechniques(run, "web-T4", kLivingRoom, techniques);
}

/// Figure 17.
Result<void> measureProbeBands(PaperRun& run) {
    std::vector<std::string> names;
    std::vector<BrowserTechnique> techniques;
    for (const int bands : {1, 2, 3, 4, 8})
        names.push_back(fmt::format("{} coefficients", bands * bands));
    for (std::size_t k = 0; const double bands : {1., 2., 3., 4., 8.})
        techniques.push_back({names[k++].c_str(),
                              "sparse-probes",
                              {{"sparse-probes.bands", bands}},
                              {},
                              {},
                              bands == 8 ? std::optional(58. * 60) : std::nullopt});
    return measureTechniques(run, "web-F17", kLivingRoom, techniques);
}

/// Figure 19.
Result<void> measureRounds(PaperRun& run) {
    std::vector<BrowserTechnique> techniques;
    for (const auto& [name, rounds] :
         {std::pair{"8 rounds", 8.}, {"16 rounds", 16.}, {"64 rounds", 64.}})
        techniques.push_back(
            {name,
             "lpv",
             {{"lpv.resolution", 32}, {"lpv.rounds", rounds}, {"lpv.map_size", 512}},
             {},
             {},
             {}});
    return measureTechniques(run, "web-F19", kSponza, techniques);
}

} // namespace

std::span<const PaperExperiment> browserExperiments() {
    static constexpr const char* kCard = "GTX 780, i7-6700K, 1920 x 1080, Firefox 59";
    static const std::array<PaperExperiment, 6> experiments = {
        {{"web-T1", "Table 1: a sun and moving spots, light propagation volumes", kCard,
          "32 cells along the longest side, 16 rounds, maps of 512 x 512 texels. Printed times are "
          "those of frames, ours those of an update after all lights moved.",
          &kPaperSponza, measureMovingSpots},
         {"web-T2", "Table 2: a sun and still spots, light propagation volumes", kCard,
          "As in Table 1 with maps of 128 x 128 texels. A still light costs nothing here, so that "
          "ours is an update after the strength of all lights changed, which draws no map.",
          &kPaperSponza, measureStillSpots},
         {"web-T3", "Table 3: the techniques in Sponza", kCard,
          "Printed times are those of frames; an update of ours that finds nothing changed is "
          "idle. Updates of probes light all of them, where the paper's light two a frame.",
          &kPaperSponza, measureSponzaTechniques},
         {"web-T4", "Table 4: the techniques in a living room", kCard,
          "As in Table 3. The room is another one, lit by a sun through its windows.",
          &kPaperLivingRoom, measureLivingRoomTechniques},
         {"web-F17", "Figure 17: coefficients of sparse probes", "a laptop of 2014, 4 x 2.6 GHz",
          "In the living room. The paper takes 58 minutes in advance for 64 coefficients.",
          &kPaperLivingRoom, measureProbeBands},
         {"web-F19", "Figure 19: rounds of light propagation volumes", "",
          "In Sponza, 32 cells along the longest side. The paper finds 16 rounds enough.",
          &kPaperSponza, measureRounds}}};
    return experiments;
}

} // namespace limn
