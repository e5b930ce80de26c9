// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_relight_gpu.h"
#include "app/techniques/illuminance/papers/composition.h"

#include "engine/core/parallel.h"
#include "engine/lighting/fastest_update.h"
#include "engine/scene/bake_setting_names.h"

#include <algorithm>
#include <array>
#include <set>
#include <thread>

#include <fmt/format.h>

namespace limn {

namespace {

/// What Table 2 prints for some settings [ms].
struct PrintedSteps {
    std::optional<double> surfels, pull, caches, all;
};
constexpr std::array<PrintedSteps, 2> kOnCpu = {
    {{8.12, 5.00, 116., 131.}, {4.87, 1.13, 11.5, 21.1}}};
/// The whole frame stands with the lines of frames.
constexpr std::array<PrintedSteps, 2> kOnCard = {{{0.09, 1.72, 2.2, {}}, {0.04, 0.38, 0.58, {}}}};

std::vector<PaperFigure> stepFigures(const std::vector<RelightStats>& runs,
                                     const PrintedSteps& printed) {
    return {timeOf("direct [ms]", runs, {&RelightStats::directMs}),
            timeOf("surfels [ms]", runs, {&RelightStats::surfelLightMs}, printed.surfels),
            timeOf("pull [ms]", runs, {&RelightStats::pullMs}, printed.pull),
            timeOf("caches [ms]", runs, {&RelightStats::cacheLightMs}, printed.caches),
            timeOf("read [ms]", runs, {&RelightStats::surfelReadMs}),
            timeOf("field [ms]", runs, {&RelightStats::fieldMs}),
            timeOf("all [ms]", runs, {&RelightStats::totalMs}, printed.all)};
}

/// A line of Table 2 before it is measured.
struct StepLine {
    int number; ///< of the settings: 1 or 2
    LinkMode mode;
    LinkStorage storage;

    BakeSettings settings() const {
        BakeSettings s = number == 1 ? paperSettings1(mode) : paperSettings2(mode);
        s.storage = storage;
        return s;
    }
    /// Printed figures are those of SH links, as the total memory of Table 4 has it.
    PrintedSteps printed(const std::array<PrintedSteps, 2>& table) const {
        return storage == LinkStorage::Sh ? table[std::size_t(number - 1)] : PrintedSteps{};
    }
    std::string name() const {
        return fmt::format("settings {}, {}, {}", number, storage == LinkStorage::Sh ? "SH" : "RTP",
                           nameOf(mode));
    }
};

Result<PaperLine> stepsOnCpu(PaperRun& run, const StepLine& line, int threads, bool isMost) {
    const Result<const FrontScene*> front = run.scene(kPaperSponza);
    if (!front)
        return tl::make_unexpected(front.error());
    const auto baked = bakeFor(run, **front, line.settings());
    if (!baked)
        return tl::make_unexpected(baked.error());
    const ThreadLimit limit(threads);
    return PaperLine{{},
                     stepFigures(relightRuns(**front, *baked, run.options().runs),
                                 isMost ? line.printed(kOnCpu) : PrintedSteps{}),
                     {}};
}

Result<PaperLine> stepsOnDevice(PaperRun& run, const StepLine& line) {
    const Result<const FrontScene*> front = run.scene(kPaperSponza);
    if (!front)
        return tl::make_unexpected(front.error());
    const auto baked = bakeFor(run, **front, line.settings());
    if (!baked)
        return tl::make_unexpected(baked.error());
    const Result<GpuRuns> runs = relightOnGpu(
        run.options().device, *(*front)->trace, *baked, LitBands::All, 1, run.options().runs,
        [&](int k) { return withMovedLights((*front)->scene, k); });
    if (!runs)
        return tl::make_unexpected(runs.error());
    return PaperLine{{}, stepFigures(runs->runs, line.printed(kOnCard)), {}};
}

} // namespace

Result<void> measureStepTimes(PaperRun& run) {
    const int all = int(std::max(1U, std::thread::hardware_concurrency()));
    for (const int number : {1, 2})
        for (const LinkStorage storage : {LinkStorage::Sh, LinkStorage::Rtp})
            for (const LinkMode mode : kLinkModes) {
                const StepLine line{number, mode, storage};
                for (const int threads : std::set<int>{1, 2, all})
                    if (threads <= all)
                        if (const Result<void> added = run.line(
                                "T2",
                                fmt::format("{}, CPU, {} thread{}", line.name(), threads,
                                            threads == 1 ? "" : "s"),
                                [&] { return stepsOnCpu(run, line, threads, threads == all); });
                            !added)
                            return added;
                if (!run.options().onDevice)
                    continue;
                if (const Result<void> added = run.line("T2", line.name() + ", device",
                                                        [&] { return stepsOnDevice(run, line); });
                    !added)
                    return added;
            }
    return {};
}

Result<void> measureBands(PaperRun& run) {
    const auto printed = [](LinkStorage storage, std::uint32_t bands) -> std::optional<double> {
        constexpr std::array<double, 9> kRtp = {0, 0, 0.78, 0.99, 1.02, 1.29, 1.31, 0, 1.95};
        return storage == LinkStorage::Rtp && kRtp[bands] > 0 ? std::optional(kRtp[bands])
                                                              : std::nullopt;
    };
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (std::uint32_t bands = 2; bands <= 8; ++bands) {
            const auto measure = [&]() -> Result<PaperLine> {
                const Result<const FrontScene*> front = run.scene(kPaperSponza);
                if (!front)
                    return tl::make_unexpected(front.error());
                BakeSettings settings = paperSettings1(LinkMode::Limn);
                settings.storage = storage;
                settings.bands = bands;
                const auto baked = bakeFor(run, **front, settings);
                if (!baked)
                    return tl::make_unexpected(baked.error());
                const std::vector<RelightStats> runs =
                    relightRuns(**front, *baked, run.options().runs);
                return PaperLine{{},
                                 {timeOf("caches [ms]", runs, {&RelightStats::cacheLightMs},
                                         printed(storage, bands)),
                                  timeOf("surfels, pull [ms]", runs,
                                         {&RelightStats::surfelLightMs, &RelightStats::pullMs}),
                                  timeOf("read, field [ms]", runs,
                                         {&RelightStats::surfelReadMs, &RelightStats::fieldMs}),
                                  timeOf("direct [ms]", runs, {&RelightStats::directMs}),
                                  timeOf("all [ms]", runs, {&RelightStats::totalMs})},
                                 {}};
            };
            const std::string name =
                fmt::format("{}, {} bands", storage == LinkStorage::Rtp ? "RTP" : "SH", bands);
            if (const Result<void> added = run.line("F11", name, measure); !added)
                return added;
        }
    return {};
}

} // namespace limn
