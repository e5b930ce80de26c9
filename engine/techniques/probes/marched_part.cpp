// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/marched_part.h"

#include <algorithm>

namespace limn {

/// Number of the first texel of a level.
static std::size_t firstOf(const MarchedMaps& maps, std::size_t level) {
    std::size_t first = 0;
    for (std::size_t k = 0; k < level; ++k)
        first += maps.radiance[k].size();
    return first;
}

MarchedTexel marchedTexel(const MarchedMaps& maps, std::uint32_t number) {
    std::size_t level = 0, first = 0;
    while (number >= first + maps.radiance[level].size())
        first += maps.radiance[level++].size();
    const std::size_t side = maps.levelSide(level), index = number - first;
    return {std::uint32_t(index / (side * side)), std::uint32_t(level),
            std::uint32_t(index % (side * side))};
}

bool MarchedPart::reflectionTaps(const ReflectedLobe& lobe, FieldTaps& taps) const {
    const MarchedRay ray = marchRay(*m_maps, lobe.origin, lobe.axis);
    const MarchedLookup lookup = lookUp(*m_maps, ray, lobe.origin, lobe.axis, lobe.spread);
    if (lookup.probe != MarchedRay::kNoProbe && lookup.direction != glm::vec3(0)) {
        const MarchedTaps texels =
            probeTaps(*m_maps, lookup.probe, lookup.direction, lookup.spread);
        for (std::size_t k = 0; k < texels.count; ++k) {
            const MarchedTap& texel = texels.tap[k];
            taps.push_back(
                {std::uint32_t(firstOf(*m_maps, texel.level) + texel.index), texel.weight});
        }
    }
    return ray.end != MarchEnd::Unknown;
}

glm::vec3 MarchedPart::sum(std::span<const FieldTap> taps) const {
    glm::vec3 sum(0);
    for (const FieldTap& tap : taps) {
        const MarchedTexel texel = marchedTexel(*m_maps, tap.index);
        const std::size_t side = m_maps->levelSide(texel.level);
        sum += tap.weight * m_maps->radiance[texel.level][texel.probe * side * side + texel.texel];
    }
    return sum;
}

bool MarchedPart::equals(const FieldPart& other) const {
    const auto* o = dynamic_cast<const MarchedPart*>(&other);
    return o && (m_maps == o->m_maps || *m_maps == *o->m_maps);
}

const MarchedMaps* marchedMapsOf(std::span<const std::shared_ptr<const FieldPart>> parts) {
    for (const auto& part : parts)
        if (const auto* marched = dynamic_cast<const MarchedPart*>(part.get()))
            return &marched->maps();
    return nullptr;
}

} // namespace limn
