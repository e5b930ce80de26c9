// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/settings_defect.h"

#include <cstdint>

#include <fmt/format.h>

namespace limn {

std::string settingsDefect(const BakeSettings& s) {
    const auto outside = [](std::uint32_t v, std::uint32_t low, std::uint32_t high) {
        return v < low || v > high;
    };
    if (outside(s.surfels, 64, 1U << 20))
        return fmt::format("bake settings: surfels {} is outside [64, 1048576]", s.surfels);
    if (s.placement > SurfelPlacement::Random)
        return "bake settings: unknown placement";
    if (s.linker > Linker::FormFactor)
        return "bake settings: unknown linker";
    if (s.cut > CutCriterion::SolidAngle)
        return "bake settings: unknown cut";
    if (s.storage > LinkStorage::Sh)
        return "bake settings: unknown storage";
    if (s.clustering > Clustering::KdTree)
        return "bake settings: unknown clustering";
    if (outside(s.links, 1, 4096))
        return fmt::format("bake settings: links {} is outside [1, 4096]", s.links);
    if (outside(s.bands, 2, 8))
        return fmt::format("bake settings: bands {} is outside [2, 8]", s.bands);
    if (outside(s.chromaBands, 0, 8))
        return fmt::format("bake settings: chromaBands {} is outside [0, 8]", s.chromaBands);
    if (outside(s.rays, 16, 65536))
        return fmt::format("bake settings: rays {} is outside [16, 65536]", s.rays);
    for (const float weight : {s.clusterNormalWeight, s.clusterBalanceWeight})
        if (!(weight >= 0 && weight <= 100))
            return fmt::format("bake settings: cluster weight {} is outside [0, 100]", weight);
    if (!(s.texelsPerMetre >= 0 && s.texelsPerMetre < 1e6f))
        return fmt::format("bake settings: texelsPerMetre {} is outside [0, 1e6)",
                           s.texelsPerMetre);
    if (s.texelsPerMetre == 0 && outside(s.lightmapCaches, 1, 1U << 24))
        return fmt::format("bake settings: lightmapCaches {} is outside [1, 16777216]",
                           s.lightmapCaches);
    if (s.grid != glm::uvec3(0) &&
        (outside(s.grid.x, 1, 256) || outside(s.grid.y, 1, 256) || outside(s.grid.z, 1, 256)))
        return fmt::format("bake settings: grid {}x{}x{} is outside 1 to 256 a side", s.grid.x,
                           s.grid.y, s.grid.z);
    return {};
}

} // namespace limn
