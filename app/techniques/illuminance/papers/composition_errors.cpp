// SPDX-License-Identifier: MIT
#include "app/papers/paper_view.h"
#include "app/techniques/illuminance/papers/composition.h"

#include "engine/measure/compare.h"
#include "engine/picture/field_render.h"
#include "engine/scene/bake_setting_names.h"
#include "engine/techniques/illuminance/format/surfel_spacing.h"

#include <array>
#include <functional>
#include <map>

#include <fmt/format.h>

namespace limn {

namespace {

const PaperView kSponzaView{.scene = &kPaperSponza};
const PaperView kGlossyView{.scene = &kPaperSponza, .roughness = 0.5f, .stops = 1};

/// A bake whose light has converged, its picture and the error of that.
struct LitBake {
    std::shared_ptr<const Bake> bake;
    std::vector<RelightStats> runs; ///< of single bounces
    ImageF picture;
    Comparison error;
};

Result<LitBake> lightBake(PaperRun& run, const PaperView& view, const BakeSettings& settings) {
    const Result<const FrontScene*> front = openView(run, view);
    if (!front)
        return tl::make_unexpected(front.error());
    const auto baked = bakeFor(run, **front, settings);
    if (!baked)
        return tl::make_unexpected(baked.error());
    LitBake lit{*baked, relightRuns(**front, *baked, run.options().runs), {}, {}};
    Relighter relighter(*baked, LitBands::All);
    relighter.relight((*front)->scene, *(*front)->trace, (*front)->scene.relight.maxBounces);
    const FieldRenderOptions options{.view = (*front)->view.view,
                                     .camera = (*front)->view.camera,
                                     .width = (*front)->view.width,
                                     .height = (*front)->view.height,
                                     .samplesPerPixel = kPaperPictureSamples,
                                     .allBands = true};
    lit.picture = renderField(*(*front)->trace, relighter.field(), (*baked)->lightmap, options);
    const Result<Comparison> error = compareImages(lit.picture, (*front)->truth);
    if (!error)
        return tl::make_unexpected(error.error());
    lit.error = *error;
    return lit;
}

using LitFigures = std::function<std::vector<PaperFigure>(const LitBake&)>;

/// Adds a line with figures of a bake with these settings, and its picture where `pictured`.
Result<void> litLine(PaperRun& run, const PaperView& view, const char* experiment,
                     const std::string& name, const BakeSettings& settings, bool pictured,
                     const LitFigures& figuresOf) {
    return run.line(experiment, name, [&]() -> Result<PaperLine> {
        const Result<LitBake> lit = lightBake(run, view, settings);
        if (!lit)
            return tl::make_unexpected(lit.error());
        if (!pictured)
            return PaperLine{{}, figuresOf(*lit), {}};
        return withPicture(run, view, experiment, name, lit->picture, figuresOf(*lit));
    });
}

/// A line of Figure 8 before it is measured: storage, bands of luminance and of chrominance, and
/// what is printed [ms, MiB]; 0: nothing.
struct GlossyLine {
    LinkStorage storage;
    std::uint32_t bands, chroma;
    double ms, mebibytes;
};
constexpr std::array<GlossyLine, 15> kGlossyLines = {{{LinkStorage::Sh, 2, 2, 0, 0},
                                                      {LinkStorage::Sh, 3, 3, 0, 0},
                                                      {LinkStorage::Sh, 4, 4, 7.3, 104.3},
                                                      {LinkStorage::Sh, 6, 6, 12.0, 209.7},
                                                      {LinkStorage::Sh, 8, 8, 0, 0},
                                                      {LinkStorage::Rtp, 2, 2, 5.2, 41.2},
                                                      {LinkStorage::Rtp, 3, 3, 6.0, 41.8},
                                                      {LinkStorage::Rtp, 4, 4, 6.2, 42.8},
                                                      {LinkStorage::Rtp, 5, 5, 0, 0},
                                                      {LinkStorage::Rtp, 6, 6, 8.9, 45.6},
                                                      {LinkStorage::Rtp, 8, 8, 13.4, 49.5},
                                                      {LinkStorage::Rtp, 8, 2, 8.3, 43.3},
                                                      {LinkStorage::Rtp, 8, 3, 8.8, 43.8},
                                                      {LinkStorage::Rtp, 8, 4, 9.3, 44.5},
                                                      {LinkStorage::Rtp, 8, 6, 10.8, 46.6}}};

std::optional<double> printedOf(double value) {
    return value > 0 ? std::optional(value) : std::nullopt;
}

BakeSettings glossySettings(LinkMode mode, LinkStorage storage, std::uint32_t bands,
                            std::uint32_t chroma) {
    BakeSettings settings = paperSettings1(mode);
    settings.storage = storage;
    settings.bands = bands;
    settings.chromaBands = chroma;
    return settings;
}

const PaperView kSignsView{.scene = &kPaperSigns};
const PaperView kSpotView{.scene = &kPaperSpot};

} // namespace

Result<void> measureGlossy(PaperRun& run) {
    if (const Result<void> added = addReference(run, kGlossyView, "F8"); !added)
        return added;
    for (const LinkMode mode : kLinkModes)
        for (const GlossyLine& line : kGlossyLines) {
            const std::string name =
                fmt::format("{} {}:{}, {}", line.storage == LinkStorage::Sh ? "SH" : "RTP",
                            line.bands, line.chroma, nameOf(mode));
            const auto figures = [&](const LitBake& lit) -> std::vector<PaperFigure> {
                return {
                    timeOf("update [ms]", lit.runs, {&RelightStats::totalMs}, printedOf(line.ms)),
                    {"MiB", mebibytesOf(*lit.bake, lit.runs.back()), 0, printedOf(line.mebibytes)},
                    errorFigure(lit.error),
                    biasFigure(lit.error)};
            };
            const BakeSettings settings =
                glossySettings(mode, line.storage, line.bands, line.chroma);
            if (const Result<void> added =
                    litLine(run, kGlossyView, "F8", name, settings, true, figures);
                !added)
                return added;
        }
    return {};
}

Result<void> measureChrominance(PaperRun& run) {
    // By luminance's bands from 2, then by chrominance's from 2.
    static const std::map<std::pair<std::uint32_t, std::uint32_t>, double> kPrinted = {
        {{2, 2}, 2.48}, {{3, 2}, 2.69},  {{4, 2}, 2.95}, {{5, 2}, 3.50}, {{6, 2}, 3.78},
        {{7, 2}, 4.50}, {{8, 2}, 5.35},  {{3, 3}, 3.21}, {{4, 3}, 3.41}, {{5, 3}, 4.01},
        {{6, 3}, 4.07}, {{7, 3}, 5.22},  {{8, 3}, 5.83}, {{4, 4}, 3.33}, {{5, 4}, 4.14},
        {{6, 4}, 4.39}, {{7, 4}, 5.35},  {{8, 4}, 6.31}, {{5, 5}, 4.69}, {{6, 5}, 5.67},
        {{7, 5}, 6.26}, {{8, 5}, 6.78},  {{6, 6}, 5.95}, {{7, 6}, 6.94}, {{8, 6}, 7.80},
        {{7, 7}, 7.61}, {{8, 7}, 11.89}, {{8, 8}, 10.35}};
    for (std::uint32_t bands = 2; bands <= 8; ++bands)
        for (std::uint32_t chroma = 2; chroma <= bands; ++chroma) {
            const auto figures = [&](const LitBake& lit) -> std::vector<PaperFigure> {
                return {timeOf("caches [ms]", lit.runs, {&RelightStats::cacheLightMs},
                               kPrinted.at({bands, chroma})),
                        {"MiB", mebibytesOf(*lit.bake, lit.runs.back()), 0, {}},
                        errorFigure(lit.error)};
            };
            if (const Result<void> added =
                    litLine(run, kGlossyView, "T3", fmt::format("{}:{}", bands, chroma),
                            glossySettings(LinkMode::Limn, LinkStorage::Rtp, bands, chroma), false,
                            figures);
                !added)
                return added;
        }
    return {};
}

Result<void> measurePlacements(PaperRun& run) {
    for (const SurfelPlacement placement :
         {SurfelPlacement::Random, SurfelPlacement::Halton, SurfelPlacement::Relaxed})
        for (const LinkMode mode : kLinkModes) {
            BakeSettings settings = paperSettings2(mode);
            settings.surfels = 30000;
            settings.placement = placement;
            const auto figures = [](const LitBake& lit) -> std::vector<PaperFigure> {
                const SurfelSpacing spacing = surfelSpacing(lit.bake->surfels);
                return {{"mean distance", spacing.mean, 0, {}},
                        {"spread", spacing.spread, 0, {}},
                        errorFigure(lit.error),
                        biasFigure(lit.error)};
            };
            const std::string name =
                fmt::format("{}, {}", kPlacementNames[std::size_t(placement)], nameOf(mode));
            if (const Result<void> added =
                    litLine(run, kSponzaView, "F3", name, settings, false, figures);
                !added)
                return added;
        }
    return {};
}

Result<void> measureCounts(PaperRun& run) {
    static const std::map<std::uint32_t, double> kPrinted = {// surfels and pull
                                                             {1U << 14, 0.23},
                                                             {1U << 15, 0.42},
                                                             {1U << 16, 0.82},
                                                             {1U << 17, 1.80}};
    if (const Result<void> added = addReference(run, kSponzaView, "F10"); !added)
        return added;
    for (const LinkMode mode : kLinkModes)
        for (const std::uint32_t surfels : {1U << 14, 1U << 15, 1U << 16, 1U << 17})
            for (const std::uint32_t links : {32U, 64U, 128U, 254U}) {
                const std::string name =
                    fmt::format("{}k surfels, {} links, {}", surfels >> 10, links, nameOf(mode));
                BakeSettings settings = paperSettings1(mode);
                settings.surfels = surfels;
                settings.links = links;
                const auto figures = [&](const LitBake& lit) -> std::vector<PaperFigure> {
                    return {timeOf("surfels, pull [ms]", lit.runs,
                                   {&RelightStats::surfelLightMs, &RelightStats::pullMs},
                                   kPrinted.at(surfels)),
                            timeOf("caches [ms]", lit.runs, {&RelightStats::cacheLightMs}),
                            timeOf("all [ms]", lit.runs, {&RelightStats::totalMs}),
                            errorFigure(lit.error), biasFigure(lit.error)};
                };
                if (const Result<void> added =
                        litLine(run, kSponzaView, "F10", name, settings, true, figures);
                    !added)
                    return added;
            }
    return {};
}

Result<void> measureSigns(PaperRun& run) {
    if (const Result<void> added = addReference(run, kSignsView, "F7"); !added)
        return added;
    for (const LinkMode mode : kLinkModes) {
        BakeSettings settings = paperSettings1(mode);
        settings.surfels = 40000;
        settings.lightmapCaches = 13785;
        const auto figures = [](const LitBake& lit) -> std::vector<PaperFigure> {
            return {timeOf("update [ms]", lit.runs, {&RelightStats::totalMs}, 1000. / 195),
                    errorFigure(lit.error), biasFigure(lit.error)};
        };
        if (const Result<void> added =
                litLine(run, kSignsView, "F7", nameOf(mode), settings, true, figures);
            !added)
            return added;
    }
    return {};
}

Result<void> measureSpot(PaperRun& run) {
    if (const Result<void> added = addReference(run, kSpotView, "F9b"); !added)
        return added;
    for (const LinkMode mode : kLinkModes)
        for (const std::uint32_t links : {32U, 128U}) {
            const std::string name = fmt::format("{} links, {}", links, nameOf(mode));
            BakeSettings settings = paperSettings2(mode);
            settings.links = links;
            const auto figures = [](const LitBake& lit) -> std::vector<PaperFigure> {
                return {errorFigure(lit.error),
                        {"nRMSE without the worst 1 %", lit.error.nrmseTrimmed, 0, {}},
                        biasFigure(lit.error)};
            };
            if (const Result<void> added =
                    litLine(run, kSpotView, "F9b", name, settings, true, figures);
                !added)
                return added;
        }
    return {};
}

} // namespace limn
