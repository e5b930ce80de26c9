// SPDX-License-Identifier: MIT
#include "engine/measure/seen_truth.h"

#include "engine/core/parallel.h"
#include "engine/shading/direct_light.h"

#include <algorithm>
#include <utility>

namespace limn {

static ImageF rowImage(std::vector<glm::vec3> rgb) {
    const auto width = std::uint32_t(rgb.size());
    return {width, 1, std::move(rgb)};
}

static ImageF withMore(ImageF image, const std::vector<glm::vec3>& more) {
    for (std::size_t i = 0; i < more.size(); ++i)
        image.rgb[i] += more[i];
    return image;
}

bool SeenTruth::isDark() const {
    return std::ranges::all_of(first.rgb, [](glm::vec3 e) { return e == glm::vec3(0); });
}

std::optional<SeenTruth> findSeenTruth(const TraceScene& trace, const Camera& camera,
                                       const TruthSize& size, const Progress& progress) {
    SeenTruth truth;
    truth.points = findSeenPoints(trace, camera, size.width, size.height, 1);
    std::vector<glm::vec3> direct(truth.points.size());
    parallelRanges(direct.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::uint64_t rays = 0;
        for (std::size_t i = begin; i < end; ++i)
            direct[i] = directIrradiance(trace, truth.points[i].surface, rays);
    });
    truth.direct = rowImage(std::move(direct));
    const Emitters emitters = findEmitters(trace);
    const SkyLight sky = findSkyLight(trace.scene().sky);
    const PathContext context{trace, emitters, sky};
    const auto first = traceIrradiance(context, truth.points, size.paths, 2, progress),
               second = traceIrradiance(context, truth.points, size.paths, 3, progress);
    if (!first || !second)
        return {};
    truth.first = withMore(truth.direct, *first);
    truth.second = withMore(truth.direct, *second);
    return truth;
}

Result<Comparison> compareWithTruth(const TraceScene& trace, const Lighting& lighting,
                                    const LightmapLayout& layout, const SeenTruth& truth) {
    return compareImages(withMore(truth.direct, lookUpIrradiance(*lighting.field(), layout,
                                                                 trace.scene(), truth.points)),
                         truth.first, truth.second);
}

} // namespace limn
