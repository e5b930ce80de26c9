// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/regression_scene.h"

#include "app/bench/live_light.h"
#include "app/bench/moving_lights.h"
#include "app/bench/smooth_motion.h"
#include "app/commands/scene_options.h"

#include "engine/measure/reference_set.h"
#include "engine/measure/seams.h"
#include "engine/measure/seen_truth.h"
#include "engine/scene/dark_backs.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/illuminance.h"
#include "engine/techniques/illuminance/measure/baked_senders.h"
#include "engine/techniques/illuminance/measure/cache_error.h"
#include "engine/techniques/illuminance/measure/energy_chain.h"
#include "engine/techniques/illuminance/measure/link_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <glm/vec3.hpp>

namespace limn {

namespace {

constexpr std::array<RegressionScene, 4> kScenes = {{{"cornell", "cornell", false},
                                                     {"atrium", "court", false},
                                                     {"generated:1", "two rooms", true},
                                                     {"generated:19", "door ajar", false}}};

/// The figures of one trial by name, all in per cent, in the same order for each trial.
using Figures = std::vector<std::pair<std::string, double>>;

/// What all trials of a scene are measured against.
struct Truths {
    SeenTruth seen;
    MotionTruth motion;
    ReferenceOptions view; ///< of `motion`
    double outside = 0;    ///< mean irradiance that the camera sees [W m^-2]
};

/// A scene ready to be measured.
struct Opened {
    Scene scene;
    TraceScene trace;
    std::vector<Scene> lightings; ///< for the error of the cut
    Truths truths;

    explicit Opened(Scene opened) : scene(std::move(opened)), trace(scene) {}
};

BakeSettings trialSettings(const BakeSettings& settings, std::uint32_t trial) {
    BakeSettings s = settings;
    s.surfels = 8192 - 16 * trial;
    s.lightmapCaches = 4000 - 8 * trial;
    s.links = 32;
    s.rays = 128;
    return s;
}

/// The scene's own light, and then single lamps over its surfaces. Each lights the scene once, by
/// light of the first bounce.
std::vector<Scene> lightingsOf(const Scene& scene) {
    constexpr std::uint32_t kLamps = 12;
    std::vector<Scene> lightings = {scene};
    const SurfacePoints points = spreadPoints(scene, kLamps);
    for (const Light& lamp : pointsOver(scene, points.positions, points.normals, kLamps)) {
        Scene lit = scene;
        lit.lights = {lamp};
        lit.sky = {};
        lightings.push_back(std::move(lit));
    }
    for (Scene& lit : lightings)
        lit.relight.maxBounces = 1; // each begins without bounced light
    return lightings;
}

Result<std::unique_ptr<Opened>> openRegression(const RegressionScene& wanted) {
    SceneOptions options;
    options.scene = wanted.scene;
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    Scene scene = flatten(imported->document, imported->assets);
    leaveOutDarkBacks(scene); // as the bake does
    auto opened = std::make_unique<Opened>(std::move(scene));
    Truths& truths = opened->truths;
    const Camera& camera = opened->scene.cameras.front();              // each of the scenes has one
    truths.seen = *findSeenTruth(opened->trace, camera, {96, 54, 64}); // never cancelled
    truths.outside = meanOf(meanImage(truths.seen.first, truths.seen.second));
    truths.view = {.view = View::Irradiance,
                   .camera = camera,
                   .width = 64,
                   .height = 36,
                   .samplesPerPixel = 4};
    truths.motion = renderMotion(Motion::Lights, opened->trace, truths.view,
                                 *renderReferenceSet(opened->trace, truths.view));
    opened->lightings = lightingsOf(opened->scene);
    return opened;
}

/// Bakes of a trial, all from the same rays.
struct Trial {
    std::shared_ptr<const Bake> bake;
    std::shared_ptr<const Bake> uncut; ///< links every sender that a ray met
    std::shared_ptr<const Bake> paper; ///< cut by solid angle at the same number of links
    std::unique_ptr<BakedSenders> senders;
};

Result<Trial> bakeTrial(Opened& opened, std::uint32_t k, const Progress& progress) {
    StageStore store;
    const BakeSettings settings = trialSettings(opened.scene.bake, k);
    opened.scene.bake = settings; // BakedSenders reads them there
    BakeSettings uncut = settings, paper = settings;
    uncut.cut = paper.cut = CutCriterion::SolidAngle;
    uncut.links = 4096;
    Trial trial;
    for (const auto& [s, made] :
         {std::pair(&settings, &trial.bake), {&uncut, &trial.uncut}, {&paper, &trial.paper}}) {
        Result<Bake> b = bake(opened.trace, {{}, progress.cancel}, &store, s);
        if (!b)
            return tl::make_unexpected(b.error());
        *made = std::make_shared<const Bake>(std::move(*b));
    }
    trial.senders = std::make_unique<BakedSenders>(opened.trace, opened.scene, *trial.bake, store);
    return trial;
}

/// Irradiance of the texels without a cut, as the truth for the cut alone, and its mean.
std::pair<CacheReference, double> uncutIrradiance(const Relighter& uncut) {
    CacheReference reference;
    const Caches& caches = uncut.bake().caches;
    double sum = 0;
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c) {
        reference.cache.push_back(c);
        reference.irradiance.push_back(
            cacheIrradiance(caches, int(uncut.field().bands), uncut.cacheSh(), c));
        const glm::vec3 e = reference.irradiance.back();
        sum += double(e.x) + double(e.y) + double(e.z);
    }
    return {std::move(reference), sum / (3 * std::max(1., double(caches.lightmapCount)))};
}

/// Sums of errors [W m^-2] and of irradiances over lightings, so that one that brings little light
/// has little weight.
struct CutSums {
    double cut = 0, paper = 0, mean = 0;
};

/// Error of the cut alone, that of the bake, and that of the paper's: the rms over texels, without
/// the worst per cent, which lie beside lamps, over the mean. Half of it is that under the scene's
/// own light, half that under lamps.
std::pair<double, double> cutErrors(const Opened& opened, const Trial& trial) {
    Relighter cut(trial.bake), uncut(trial.uncut), paper(trial.paper);
    std::array<CutSums, 2> sums; // of the own light, of lamps
    for (std::size_t k = 0; k < opened.lightings.size(); ++k) {
        for (Relighter* relighter : {&cut, &uncut, &paper})
            relighter->relight(opened.lightings[k], opened.trace, 1);
        const auto [reference, mean] = uncutIrradiance(uncut);
        const auto errorOf = [&](const Relighter& relighter) {
            return mean * compareCaches(reference, relighter.bake().caches,
                                        int(relighter.field().bands), relighter.cacheSh())
                              .nrmseTrimmed;
        };
        CutSums& sum = sums[k > 0];
        sum.cut += errorOf(cut);
        sum.paper += errorOf(paper);
        sum.mean += mean;
    }
    return {(sums[0].cut / sums[0].mean + sums[1].cut / sums[1].mean) / 2,
            (sums[0].paper / sums[0].mean + sums[1].paper / sums[1].mean) / 2};
}

void addCut(const Opened& opened, const Trial& trial, Figures& figures) {
    const auto [cut, paper] = cutErrors(opened, trial);
    figures.emplace_back("cut", 100 * cut);
    figures.emplace_back("cut against the paper's", 100 * cut / paper);
}

void addLinks(const Opened& opened, const Trial& trial, Figures& figures) {
    constexpr std::uint32_t kCaches = 256, kMultiple = 16;
    Relighter relighter(trial.bake);
    relighter.relight(opened.scene, opened.trace, opened.scene.relight.maxBounces);
    const BakedSenders& s = *trial.senders;
    for (const bool grid : {false, true}) {
        const SightReference reference =
            traceSights(opened.trace, s.set, s.owners, *trial.bake,
                        grid ? CacheKind::Grid : CacheKind::Hemisphere, grid ? s.grid : s.lightmap,
                        grid ? trial.bake->caches.lightmapCount : 0, kCaches, kMultiple);
        if (reference.cache.empty())
            continue; // there is no grid
        figures.emplace_back(
            grid ? "links of the grid" : "links of texels",
            100 * measureLinks(*trial.bake, reference, relighter.radiosity()).irradiance[0]);
    }
}

/// What the surfels and the cut add to the energy of the light.
bool addEnergy(const Opened& opened, const Trial& trial, std::uint32_t k, Figures& figures,
               const Progress& progress) {
    EnergyOptions options{opened.scene.cameras.front(), 64, 36, 16, 100 * (k + 1)};
    const EnergyChain chain = measureEnergyChain(
        opened.trace, {trial.bake, trial.uncut, *trial.senders}, options, {{}, progress.cancel});
    if (!chain.complete)
        return false;
    const auto energyOf = [&](std::string_view name) {
        for (const EnergyStep& step : chain.steps)
            if (step.name == name)
                return step.energy;
        return std::nan("");
    };
    figures.emplace_back("energy of surfels", 100 * (energyOf("surfels") - energyOf("texels")));
    figures.emplace_back("energy of the cut", 100 * (energyOf("cut") - energyOf("surfels")));
    return true;
}

/// Light in a sealed room, as a share of that outside.
double leakInto(const Opened& opened, const Camera& dark, const Lighting& lighting,
                const LightmapLayout& layout) {
    const ImageF image = renderField(opened.trace, *lighting.field(), layout,
                                     {.view = View::Irradiance,
                                      .camera = dark,
                                      .width = 64,
                                      .height = 36,
                                      .samplesPerPixel = 4});
    return meanOf(image) / opened.truths.outside;
}

/// The figures of the light that is shown, converged.
bool addLight(const Opened& opened, const Trial& trial, bool sealed, Figures& figures,
              const Progress& progress) {
    const Scene& scene = opened.scene;
    const Truths& truths = opened.truths;
    const LightmapLayout& layout = trial.bake->lightmap;
    auto lighting =
        kIlluminanceTechnique.light({std::make_shared<const BakedIlluminance>(trial.bake),
                                     std::make_shared<const Scene>(scene)});
    lighting->update({.scene = scene, .trace = &opened.trace, .bounces = scene.relight.maxBounces},
                     {});
    const Comparison error =
        *compareWithTruth(opened.trace, *lighting, layout, truths.seen); // of the same points
    figures.emplace_back("error", 100 * error.nrmse);
    figures.emplace_back("bias", 100 * error.bias);
    const SeamError seams = measureSeams(scene, layout, *lighting->field());
    if (seams.length > 0)
        figures.emplace_back("seam", 100 * seams.relative());
    if (sealed)
        figures.emplace_back("leak", 100 * leakInto(opened, scene.cameras[1], *lighting, layout));
    FieldRenderOptions view;
    view.view = View::Irradiance;
    view.camera = truths.view.camera;
    view.width = truths.view.width;
    view.height = truths.view.height;
    const std::optional<double> flicker =
        LiveLight(std::move(lighting), scene, opened.trace, layout, view)
            .flicker(truths.motion, {{}, progress.cancel});
    if (flicker)
        figures.emplace_back("flicker", 100 * *flicker);
    return flicker.has_value();
}

Result<Figures> measureTrial(Opened& opened, bool sealed, std::uint32_t k,
                             const Progress& progress) {
    const Result<Trial> trial = bakeTrial(opened, k, progress);
    if (!trial)
        return tl::make_unexpected(trial.error());
    Figures figures;
    const bool done = addLight(opened, *trial, sealed, figures, progress) &&
                      addEnergy(opened, *trial, k, figures, progress);
    if (!done)
        return fail("cancelled");
    addCut(opened, *trial, figures);
    addLinks(opened, *trial, figures);
    return figures;
}

/// Mean and standard error of a figure over trials.
RegressionFigure figureOf(const std::string& scene, std::size_t index,
                          const std::vector<Figures>& trials) {
    const double n = double(trials.size());
    double mean = 0, squares = 0;
    for (const Figures& trial : trials)
        mean += trial[index].second / n;
    for (const Figures& trial : trials)
        squares += (trial[index].second - mean) * (trial[index].second - mean);
    return {scene, trials.front()[index].first, "%", mean, std::sqrt(squares / (n * (n - 1)))};
}

} // namespace

std::span<const RegressionScene> regressionScenes() {
    return kScenes;
}

Result<std::vector<RegressionFigure>> measureRegression(const RegressionScene& scene,
                                                        const Progress& progress) {
    progress.at(scene.name, 0);
    const Result<std::unique_ptr<Opened>> opened = openRegression(scene);
    if (!opened)
        return tl::make_unexpected(opened.error());
    std::vector<Figures> trials;
    for (std::uint32_t k = 0; k < kRegressionTrials; ++k) {
        progress.at(scene.name, float(k + 1) / float(kRegressionTrials + 1));
        Result<Figures> trial = measureTrial(**opened, scene.sealed, k, progress);
        if (!trial)
            return fail(fmt::format("{}: {}", scene.name, trial.error().message));
        trials.push_back(std::move(*trial));
    }
    std::vector<RegressionFigure> figures;
    for (std::size_t i = 0; i < trials.front().size(); ++i)
        figures.push_back(figureOf(scene.name, i, trials));
    return figures;
}

} // namespace limn
