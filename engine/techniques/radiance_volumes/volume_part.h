// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_part.h"
#include "engine/techniques/radiance_volumes/allocation.h"
#include "engine/techniques/radiance_volumes/cache_light.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Lit caches as a part of a field. Its numbers are the caches' harmonics, then the texels of their
/// maps for reflections, then each colour of the harmonics alone, with the others 0.
class VolumePart : public FieldPart {
public:
    /// The caches' places; shared by parts, because light changes more often.
    std::shared_ptr<const CacheAllocation> caches;
    std::uint32_t bands = 2; ///< 2 or 3
    /// Irradiance of each cache is clamped to 0 before caches are mixed, as in the program of
    /// Reich. Realtime Global Illumination using Dynamic Radiance Volumes. 2015.
    bool clamped = false;
    CacheLight light;
    std::optional<GlossyMapShape> glossy;
    glm::vec3 eye{0}; ///< of those maps

    std::size_t coefficients() const { return std::size_t(bands) * bands; }
    /// Number of the first texel of the maps.
    std::size_t firstTexel() const { return light.harmonics.size(); }
    /// Number of the first colour of a harmonic; colour c of harmonic i is 3 i + c further.
    std::size_t firstColour() const { return firstTexel() + light.glossy.size(); }
    std::size_t bytes() const;

    const char* name() const override { return "radiance volumes"; }
    void irradianceTaps(const FieldPoint& point, FieldTaps& taps) const override;
    void radianceTaps(const FieldPoint& point, glm::vec3 direction, FieldTaps& taps) const override;
    void lobeTaps(const FieldPoint& point, glm::vec3 direction, int lobeBands,
                  const std::array<float, kMaxBands>& factors, FieldTaps& taps) const override;
    glm::vec3 sum(std::span<const FieldTap> taps) const override;
    bool equals(const FieldPart& other) const override;

private:
    CacheLookup lookUp(const FieldPoint& point) const;
    void addHarmonics(const FieldPoint& point, std::span<const float> weights,
                      FieldTaps& taps) const;
    void addClamped(const FieldPoint& point, std::span<const float> weights, FieldTaps& taps) const;
};

} // namespace limn
