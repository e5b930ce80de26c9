// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_part.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A photon that lights the surface around it.
struct Splat {
    glm::vec3 power{0}; ///< [W]
    glm::vec3 position{0};
    glm::vec3 normal{0}; ///< unit
    bool operator==(const Splat&) const = default;
};

/// Photons as a part of a field: irradiance is the sum of P / (pi r^2) over those within radius r
/// whose normals differ by at most 60 degrees. Number i is the power of splat i. Light counts as
/// equal from all directions.
/// McGuire, Luebke. Hardware-Accelerated Global Illumination by Image Space Photon Mapping. 2009
class PhotonSplatPart : public FieldPart {
public:
    /// radius > 0 [m]
    PhotonSplatPart(std::vector<Splat> splats, float radius);

    const char* name() const override { return "photon splats"; }
    void irradianceTaps(const FieldPoint& point, FieldTaps& taps) const override;
    void radianceTaps(const FieldPoint& point, glm::vec3 direction, FieldTaps& taps) const override;
    void lobeTaps(const FieldPoint& point, glm::vec3 direction, int bands,
                  const std::array<float, kMaxBands>& factors, FieldTaps& taps) const override;
    glm::vec3 sum(std::span<const FieldTap> taps) const override;
    bool equals(const FieldPart& other) const override;

    const std::vector<Splat>& splats() const { return m_splats; }
    float radius() const { return m_radius; }
    static constexpr float kMinCosine = 0.5f; ///< of the normals of a splat and what it lights

    std::uint64_t bytes() const { return m_splats.size() * (sizeof(Splat) + sizeof(m_order[0])); }

private:
    /// The cell of a point in a grid with cells of the radius, as a number.
    std::uint64_t keyOf(glm::ivec3 cell) const;
    glm::ivec3 cellAt(glm::vec3 p) const;
    void addTaps(const FieldPoint& point, float scale, FieldTaps& taps) const;

    std::vector<Splat> m_splats;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> m_order; ///< cell and splat, ascending
    float m_radius;
};

} // namespace limn
