// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/papers/composition.h"

#include "app/commands/progress_line.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/lighting/fastest_update.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_bytes.h"

#include <array>

namespace limn {

const PaperScene kPaperSigns = {
    .name = "signs", .file = nullptr, .light = nullptr, .referenceFactor = 4};

const PaperScene kPaperSpot = {.name = "cornell",
                               .file = nullptr,
                               .light = "spot pos=1.5,4,0 dir=-0.3,-1,0 cd=4000 inner=4 outer=6",
                               .referenceFactor = 16};

static BakeSettings settingsIn(LinkMode mode) {
    BakeSettings settings;
    settings.lightmapCaches = 10585;
    if (mode == LinkMode::Paper)
        settings.cut = CutCriterion::SolidAngle;
    return settings;
}

BakeSettings paperSettings1(LinkMode mode) {
    BakeSettings settings = settingsIn(mode);
    settings.bands = 4;
    settings.links = 254;
    settings.surfels = 1 << 17;
    return settings;
}

BakeSettings paperSettings2(LinkMode mode) {
    BakeSettings settings = settingsIn(mode);
    settings.bands = 3;
    settings.links = 128;
    settings.surfels = 1 << 15;
    if (mode == LinkMode::Paper)
        settings.linker = Linker::FormFactor;
    return settings;
}

const char* nameOf(LinkMode mode) {
    return mode == LinkMode::Paper ? "paper's links" : "Limn's links";
}

Result<std::shared_ptr<const Bake>> bakeFor(PaperRun& run, const FrontScene& front,
                                            const BakeSettings& settings) {
    Result<Bake> made = bake(*front.trace, progressOnStderr(), &run.stages(), &settings);
    if (!made)
        return tl::make_unexpected(made.error());
    return std::make_shared<const Bake>(std::move(*made));
}

std::vector<RelightStats> relightRuns(const FrontScene& front, std::shared_ptr<const Bake> bake,
                                      int runs) {
    Relighter relighter(std::move(bake), LitBands::All);
    std::vector<RelightStats> stats;
    for (int k = 0; k <= runs; ++k) {
        const Scene moved = withMovedLights(front.scene, k);
        const RelightStats once = relighter.relight(moved, *front.trace, 1);
        if (k > 0)
            stats.push_back(once);
    }
    return stats;
}

double mebibytesOf(const Bake& bake, const RelightStats& stats) {
    return double(bytesOf(bake).total() + stats.bytes) / (1 << 20);
}

std::span<const PaperExperiment> illuminanceExperiments() {
    static constexpr const char* kCards = "GTX 980, 1920 x 1080";
    static const std::array<PaperExperiment, 10> experiments = {
        {{"T2", "Table 2: time of each step", "i7-4790S, 4 cores, and GTX 980; SH links",
          "An update of one bounce of all bands, the sun moved. The paper's CPU lights surfels "
          "from "
          "a shadow map; ours traces a ray from four points of each surfel (direct), and reads the "
          "bounced light of surfels back from caches (read), which the paper does on the card.",
          &kPaperSponza, measureStepTimes},
         {"5.3.1", "Section 5.3.1: resolution of the picture", kCards,
          "Settings 1. Shading is direct and indirect light and tone mapping; drawing is the "
          "geometry. On a software rasteriser the pictures have a third of the printed widths and "
          "heights. All figures are of the device.",
          &kPaperSponza, measureResolutions},
         {"T3", "Table 3: bands of luminance and of chrominance", kCards,
          "Y:C are the bands of luminance and of chrominance, settings 1, RTP. Printed times are "
          "those of caches and shading together, ours of caches on the CPU. Errors are those of "
          "the lit picture, half of each surface a metal of roughness 0.5.",
          &kPaperSponza, measureChrominance},
         {"T4", "Table 4: memory of the parts", "",
          "Settings 1 unless the line says otherwise. Ours counts what a bake holds and all that "
          "the updates of the CPU read and write beside it.",
          &kPaperSponza, measureMemory},
         {"F3", "Figure 3: placements of 30 000 surfels", "",
          "Spread is the standard deviation of the distance to the nearest neighbour over its "
          "mean; random points have 0.52, a hexagonal lattice 0. Settings 2 but for the surfels.",
          &kPaperSponza, measurePlacements},
         {"F7", "Figure 7: an area light with a texture", "a GTX 980",
          "The sample `signs`, which has the paper's five signs and not its bunny and duck, with "
          "40 000 surfels, 13 785 caches and the links of settings 1. Printed is a frame of 195 a "
          "second; ours is an update of one bounce on the CPU.",
          &kPaperSigns, measureSigns},
         {"F8", "Figure 8: glossy surfaces", kCards,
          "Half of each surface is a metal of roughness 0.5, which is a Blinn-Phong exponent of "
          "30. Settings 1. Printed times are those of a frame, ours those of an update on the "
          "CPU. Pictures show all light at twice the exposure.",
          &kPaperSponza, measureGlossy},
         {"F9b", "Figure 9 (b): a small spot", "",
          "The sample `cornell` with a spot of six degrees. Settings 2 but for the links, which "
          "cut clusters differently from cache to cache: the paper shows the steps on the floor.",
          &kPaperSpot, measureSpot},
         {"F10", "Figure 10: number of surfels and of links", kCards,
          "Settings 1, RTP. Errors are those of the bounced irradiance.", &kPaperSponza,
          measureCounts},
         {"F11", "Figure 11: number of bands", kCards,
          "Settings 1. The paper prints RTP's times in its text.", &kPaperSponza, measureBands}}};
    return experiments;
}

} // namespace limn
