// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_part.h"
#include "engine/techniques/probes/march_ray.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace limn {

/// What glossy surfaces reflect of what probes see: rays are marched through the probes' maps. Its
/// numbers are the texels of MarchedMaps::radiance, level after level.
class MarchedPart : public FieldPart {
public:
    explicit MarchedPart(std::shared_ptr<const MarchedMaps> maps) : m_maps(std::move(maps)) {}

    const MarchedMaps& maps() const { return *m_maps; }

    const char* name() const override { return "map of reflections"; }
    void irradianceTaps(const FieldPoint&, FieldTaps&) const override {}
    void radianceTaps(const FieldPoint&, glm::vec3, FieldTaps&) const override {}
    void lobeTaps(const FieldPoint&, glm::vec3, int, const std::array<float, kMaxBands>&,
                  FieldTaps&) const override {}
    bool reflects() const override { return true; }
    bool reflectionTaps(const ReflectedLobe& lobe, FieldTaps& taps) const override;
    glm::vec3 sum(std::span<const FieldTap> taps) const override;
    bool equals(const FieldPart& other) const override;

private:
    std::shared_ptr<const MarchedMaps> m_maps;
};

/// The maps of the part of a field that reflects(), which is a MarchedPart; null: there is none.
const MarchedMaps* marchedMapsOf(std::span<const std::shared_ptr<const FieldPart>> parts);

/// A texel of a level of a probe's map.
struct MarchedTexel {
    std::uint32_t probe = 0, level = 0, texel = 0;
};
/// The texel that a number of a MarchedPart over these maps stands for.
MarchedTexel marchedTexel(const MarchedMaps& maps, std::uint32_t number);

} // namespace limn
