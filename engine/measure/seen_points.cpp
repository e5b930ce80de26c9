// SPDX-License-Identifier: MIT
#include "engine/measure/seen_points.h"

#include "engine/core/parallel.h"
#include "engine/field/sample_field.h"
#include "engine/picture/field_lobe.h"

namespace limn {

std::optional<SeenPoint> findSeenPoint(const TraceScene& trace, const PixelRays& rays,
                                       std::uint32_t pixel, std::uint32_t seed) {
    const auto width = std::uint32_t(rays.size.x);
    const Sampler sampler{mixBits(seed, pixel), 0};
    const glm::vec2 corner(float(pixel % width), float(pixel / width));
    const Hit hit = trace.closestHit(rays.through(corner + sampler.pair(0)), TraceMask::Seen);
    const std::optional<SurfacePoint> p = hit ? surfacePoint(trace, hit) : std::nullopt;
    return p ? std::optional(SeenPoint{hit, *p}) : std::nullopt;
}

std::vector<SeenPoint> findSeenPoints(const TraceScene& trace, const Camera& camera,
                                      std::uint32_t width, std::uint32_t height,
                                      std::uint32_t seed) {
    const PixelRays rays(camera, width, height);
    std::vector<SeenPoint> points;
    for (std::uint32_t i = 0; i < width * height; ++i)
        if (const std::optional<SeenPoint> p = findSeenPoint(trace, rays, i, seed))
            points.push_back(*p);
    return points;
}

std::optional<std::vector<glm::vec3>> traceIrradiance(const PathContext& context,
                                                      const std::vector<SeenPoint>& points,
                                                      std::uint32_t paths, std::uint32_t seed,
                                                      const Progress& progress) {
    constexpr std::uint32_t kGrain = 64;
    std::vector<glm::vec3> result(points.size());
    const bool done = parallelRanges(
        points.size(), kGrain, progress, "reference", [&](std::size_t begin, std::size_t end) {
            std::uint64_t rays = 0;
            for (std::size_t i = begin; i < end; ++i)
                for (std::uint32_t s = 0; s < paths; ++s)
                    result[i] +=
                        sampleIndirectIrradiance(context, points[i].surface,
                                                 {mixBits(seed, std::uint32_t(i)), s}, rays) /
                        float(paths);
        });
    return done ? std::optional(std::move(result)) : std::nullopt;
}

std::vector<glm::vec3> lookUpIrradiance(const IndirectField& field, const LightmapLayout& layout,
                                        const Scene& scene, const std::vector<SeenPoint>& points) {
    std::vector<glm::vec3> result;
    result.reserve(points.size());
    for (const auto& [hit, p] : points)
        result.push_back(sampleIrradiance(fieldPoint(field, layout, scene, hit, p)));
    return result;
}

} // namespace limn
