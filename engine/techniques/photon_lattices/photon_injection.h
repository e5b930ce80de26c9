// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/cell_lobes.h"
#include "engine/lattice/lattice.h"
#include "engine/techniques/photon_lattices/photon.h"
#include "engine/techniques/photon_lattices/photon_settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace limn {

/// The lattices, from soft light to caustics.
enum class PhotonLattice : std::uint8_t { Low, Mid, High };
inline constexpr std::size_t kPhotonLattices = 3;
/// PhotonPlaces of a photon that no lattice holds because it is splatted.
inline constexpr std::uint8_t kSplatted = kPhotonLattices;

/// The three lattices over a scene's box.
using PhotonLattices = std::array<Lattice, kPhotonLattices>;
PhotonLattices photonLattices(const Bounds& bounds, const InjectionSettings& settings);

/// A surface belongs to the cell of the point this share of a cell's side off it. Surfaces that lie
/// in the faces of cells, as walls do, would otherwise belong to either cell by rounding.
inline constexpr float kLatticeLift = 1e-3f;

/// Index of the cell to which a surface point with unit geometric normal belongs.
inline std::uint32_t cellOf(const Lattice& lattice, glm::vec3 p, glm::vec3 normal) {
    return lattice.index(lattice.at(p + normal * (kLatticeLift * lattice.cell)));
}

/// Harmonics of a photon of power 1, two bands. Of its surface, with the kernel (1 + cos) / 2 about
/// its normal, so that a sum over photons is never negative; or, `incident`, those of the direction
/// from which it came.
std::array<float, 4> photonHarmonics(const Photon& photon, bool incident);

/// The same of 1 m^2 of surface with unit normal n, as photonHarmonics() of a photon on it.
std::array<float, 4> facingHarmonics(glm::vec3 n);

/// Which lattice holds each photon, a PhotonLattice or kSplatted. High: the path's last vertex sent
/// it through glass or reflected it narrowly. Else Mid, or Low where the 27 cells of Mid around it
/// hold fewer than InjectionSettings::few such photons of the same map.
std::vector<std::uint8_t> choosePlaces(const PhotonMap& map, const Lattice& mid,
                                       const InjectionSettings& settings);

/// Photons of a map summed in cells [W], those that are chosen for each lattice.
using PhotonSums = std::array<std::vector<CellLobe>, kPhotonLattices>;
PhotonSums injectPhotons(const PhotonMap& map, const std::vector<std::uint8_t>& places,
                         const PhotonLattices& lattices, bool incident);

} // namespace limn
