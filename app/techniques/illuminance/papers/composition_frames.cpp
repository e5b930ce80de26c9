// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/frame_times.h"
#include "app/techniques/illuminance/papers/composition.h"

#include "engine/lighting/fastest_update.h"

#include <array>

#include <fmt/format.h>

namespace limn {

namespace {

/// A size of pictures, and the printed times of shading [ms].
struct Resolution {
    std::uint32_t width, height;
    double with, without;
};
constexpr std::array<Resolution, 3> kResolutions = {
    {{960, 540, 0.99, 0.67}, {1920, 1080, 2.59, 1.41}, {3840, 2160, 8.84, 3.51}}};

} // namespace

Result<void> measureResolutions(PaperRun& run) {
    if (!run.options().onDevice)
        return {};
    const std::uint32_t share = run.options().softwareDevice ? 3 : 1;
    for (const Resolution& size : kResolutions)
        for (const bool indirect : {true, false}) {
            const auto measure = [&]() -> Result<PaperLine> {
                const Result<const FrontScene*> front = run.scene(kPaperSponza);
                if (!front)
                    return tl::make_unexpected(front.error());
                const auto baked = bakeFor(run, **front, paperSettings1(LinkMode::Limn));
                if (!baked)
                    return tl::make_unexpected(baked.error());
                const Result<DrawnFrames> drawn =
                    drawFrames({.device = run.options().device,
                                .width = size.width / share,
                                .height = size.height / share,
                                .indirect = indirect,
                                .seenOnly = false},
                               *(*front)->trace, *baked, run.options().runs, [&](int k) {
                                   return FrameScene{withMovedLights((*front)->scene, k),
                                                     (*front)->view.camera};
                               });
                if (!drawn)
                    return tl::make_unexpected(drawn.error());
                using F = FrameTimes;
                return PaperLine{
                    {},
                    {timeOf("shadow maps [ms]", drawn->frames, {&F::shadowMaps}),
                     timeOf("drawing [ms]", drawn->frames, {&F::geometry}),
                     timeOf("shading [ms]", drawn->frames, {&F::indirect, &F::direct, &F::tonemap},
                            indirect ? size.with : size.without),
                     timeOf("relighting [ms]", drawn->frames,
                            {&F::lightsOnSurfels, &F::surfels, &F::pull, &F::caches, &F::field}),
                     {"MiB", double(drawn->bytes) / (1 << 20), 0, {}}},
                    {}};
            };
            const std::string name =
                fmt::format("{} x {}, {} indirect light", size.width / share, size.height / share,
                            indirect ? "with" : "without");
            if (const Result<void> added = run.line("5.3.1", name, measure); !added)
                return added;
        }
    return {};
}

} // namespace limn
