// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/techniques/sparse_probes/sparse_bake.h"

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Harmonics of the radiance at probes [W m^-2 sr^-1]: for each probe bands^2 red values, then
/// green, then blue.
using ProbeRadiance = std::vector<float>;

/// The field's constant harmonic of radiance of which surfaces read an irradiance of 1, whatever
/// their normal: 1 / (A_0 Y_00).
inline constexpr float kRadiancePerIrradiance = 2 * std::numbers::inv_sqrtpi_v<float>;

/// The middle of a cell of the field's grid.
glm::vec3 cellCentre(const IndirectField& field, std::uint32_t cell);

/// What probes see of the sky alone. `directions` and `basis` are those of the relight rays.
ProbeRadiance gatherSky(const SparseBake& bake, std::span<const glm::vec3> directions,
                        std::span<const float> basis, const Sky& sky);

/// What probes see of the receivers, which send `radiance`, and of the sky:
/// P_lm = sky + (4 pi / Q) sum over q of radiance(hit_q) Y_lm(d_q).
void gatherProbes(const SparseBake& bake, std::span<const float> basis,
                  std::span<const glm::vec3> radiance, const ProbeRadiance& sky,
                  ProbeRadiance& probes);

/// Irradiance of all receivers [W m^-2], E = max(0, sum of T_lm P_lm), unless something else is
/// kept from being negative.
void gatherReceivers(const SparseBake& bake, const ProbeRadiance& probes, NotNegative clamped,
                     std::vector<glm::vec3>& irradiance);

/// Adds to `probes`, weights per coefficient of each probe, what follows from weights of the
/// receivers' irradiance: the transpose of the transport.
void addTransposed(const SparseBake& bake, std::span<const glm::vec3> receivers,
                   std::span<glm::vec3> probes);

/// Fills the field's grid with the mean of the eight probes nearest to each cell, by their weights
/// and without regard to walls. The field has three bands.
void fillGrid(const SparseBake& bake, const ProbeRadiance& probes, IndirectField& field);

} // namespace limn
