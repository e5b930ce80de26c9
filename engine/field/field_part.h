// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

struct FieldPoint;

/// A number that a part stores, red, green and blue, and what it is multiplied by.
struct FieldTap {
    std::uint32_t index = 0; ///< of the number, as the part counts them
    float weight = 0;
};
using FieldTaps = std::vector<FieldTap>;

/// The lobe that a glossy surface reflects.
struct ReflectedLobe {
    glm::vec3 origin{0}; ///< clear of the surface [m, world]
    glm::vec3 axis{0};   ///< unit
    float spread = 0;    ///< half of the lobe lies within this angle of the axis [rad]
};

/// A part of a field besides its lightmap and its grid, such as another grid or light kept on
/// objects: numbers, and lookups that are linear in them. A technique defines its parts; pictures
/// of the CPU and explanations read them through this. A part does not change after it was made.
class FieldPart {
public:
    virtual ~FieldPart() = default;

    /// What messages call it, such as "photon lattice".
    virtual const char* name() const = 0;

    // Each of these adds the taps whose sum() is what the part contributes; none where it
    // contributes nothing. The field's light is the sum over its parts, which is clamped to 0 as a
    // whole.

    /// Irradiance at the point [W m^-2].
    virtual void irradianceTaps(const FieldPoint& point, FieldTaps& taps) const = 0;
    /// Radiance that arrives from unit `direction` [W m^-2 sr^-1].
    virtual void radianceTaps(const FieldPoint& point, glm::vec3 direction,
                              FieldTaps& taps) const = 0;
    /// Mean radiance in a lobe as of sampleLobe() [W m^-2 sr^-1].
    virtual void lobeTaps(const FieldPoint& point, glm::vec3 direction, int bands,
                          const std::array<float, kMaxBands>& factors, FieldTaps& taps) const = 0;

    /// Whether glossy surfaces (engine/scene/surface/receiver_bands.h) reflect what
    /// reflectionTaps() finds, in place of the lobes of the whole field. One part of a field may.
    virtual bool reflects() const { return false; }
    /// Mean radiance in the lobe [W m^-2 sr^-1]. Returns false where the part does not know what is
    /// there, and the taps are a guess.
    virtual bool reflectionTaps(const ReflectedLobe& /*lobe*/, FieldTaps& /*taps*/) const {
        return false;
    }

    /// The sum of the numbers times their weights.
    virtual glm::vec3 sum(std::span<const FieldTap> taps) const = 0;

    /// Whether the other part is of the same kind, with the same numbers and lookups.
    virtual bool equals(const FieldPart& other) const = 0;
};

} // namespace limn
