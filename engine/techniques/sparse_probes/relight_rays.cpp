// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/relight_rays.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"

namespace limn {

std::vector<glm::vec3> relightDirections(std::uint32_t count) {
    const DirectionSet set(count, true, 0);
    std::vector<glm::vec3> directions(count);
    for (std::uint32_t q = 0; q < count; ++q)
        directions[q] = set[q];
    return directions;
}

std::vector<float> relightBasis(std::span<const glm::vec3> directions, int bands) {
    const auto coefficients = std::size_t(bands * bands);
    std::vector<float> basis(directions.size() * coefficients);
    for (std::size_t q = 0; q < directions.size(); ++q)
        shBasis(bands, directions[q], &basis[q * coefficients]);
    return basis;
}

std::vector<std::uint32_t> traceRelightRays(const TraceScene& trace, const ReceiverAt& receiverAt,
                                            std::span<const glm::vec3> probes,
                                            std::span<const glm::vec3> directions,
                                            const Progress& progress) {
    std::vector<std::uint32_t> hits(probes.size() * directions.size(), kSkyHit);
    parallelRanges(hits.size(), 1024, progress, "relight rays",
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) {
                           const Hit hit = trace.closestHit(
                               {probes[i / directions.size()], directions[i % directions.size()]},
                               TraceMask::Static);
                           if (!hit)
                               continue;
                           const std::uint32_t receiver = receiverAt(trace.scene(), hit);
                           hits[i] = receiver == ReceiverAt::kNone ? kDarkHit : receiver;
                       }
                   });
    return hits;
}

} // namespace limn
