// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_part.h"
#include "engine/lattice/cell_lobes.h"
#include "engine/lattice/lattice.h"
#include "engine/techniques/photon_lattices/photon_settings.h"
#include "engine/techniques/photon_lattices/surface_area.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A lattice cell's light and surface, two bands each.
struct PhotonCell {
    Lobe light{};                ///< photonHarmonics() times power [W]
    std::array<float, 4> area{}; ///< facingHarmonics() times area [m^2]
    bool operator==(const PhotonCell&) const = default;
};

/// Index of no entry.
inline constexpr std::uint32_t kNoEntry = ~0U;

/// A lattice with the cells that a lookup needs.
struct LitCells {
    Lattice lattice;
    /// Per cell of the lattice its entry, or kNoEntry; empty: entries are searched for in cellOf.
    std::vector<std::uint32_t> entryOf;
    std::vector<std::uint32_t> cellOf; ///< per entry: its cell, ascending
    std::vector<PhotonCell> cells;     ///< per entry

    std::uint32_t entryAt(std::uint32_t cell) const;
    std::uint64_t bytes() const {
        return (entryOf.size() + cellOf.size()) * sizeof(std::uint32_t) +
               cells.size() * sizeof(PhotonCell);
    }
    bool operator==(const LitCells&) const = default;
};

/// Which cells get entries.
enum class CellsKept : std::uint8_t {
    Lit,    ///< those that hold light
    Around, ///< also their neighbours with surface, which a trilinear lookup blends with them
    All     ///< all that hold light or surface
};

/// Cells with their light and surface, which are in the order of the cells. None without light.
LitCells litCells(const Lattice& lattice, std::span<const CellLobe> light,
                  std::span<const CellArea> areas, CellsKept kept);

/// Averages light and area of all cells by a blur, which is the same with both; what lies beyond
/// the lattice counts as empty. The entries are then all cells. `cells` has CellsKept::All.
LitCells blurred(const LitCells& cells, PhotonBlur blur);

/// A cell around another one and its weight in a blur.
struct WeightedCell {
    glm::ivec3 offset{0};
    float weight = 1;
};
/// The weights of a blur, which are symmetric and sum to 1.
std::vector<WeightedCell> blurWeights(PhotonBlur blur);

/// Area over that of a cell's face below which a cell's light is divided by this instead, so that
/// slivers of surface do not flash.
inline constexpr float kMinAreaShare = 0.05f;

/// A lattice as a part of a field. Irradiance at a point of cell c with normal n is
/// sum c_i Y_i(n) / max(sum a_i Y_i(n), s^2 / 20), s being the side of a cell, or for incident
/// light 4 pi / 3 times that, with photonHarmonics() c and facingHarmonics() a. Number 4 e + i is
/// coefficient i of entry e. Light counts as equal from all directions: no surface reflects it
/// glossily. Norén, Sjölin. Image Space Light Lattice Photon Mapping. 2010, without the area.
class PhotonLatticePart : public FieldPart {
public:
    PhotonLatticePart(LitCells cells, bool incident, bool trilinear)
        : m_cells(std::move(cells)), m_incident(incident), m_trilinear(trilinear) {}

    const char* name() const override { return "photon lattice"; }
    void irradianceTaps(const FieldPoint& point, FieldTaps& taps) const override;
    void radianceTaps(const FieldPoint& point, glm::vec3 direction, FieldTaps& taps) const override;
    void lobeTaps(const FieldPoint& point, glm::vec3 direction, int bands,
                  const std::array<float, kMaxBands>& factors, FieldTaps& taps) const override;
    glm::vec3 sum(std::span<const FieldTap> taps) const override;
    bool equals(const FieldPart& other) const override;

    const LitCells& cells() const { return m_cells; }
    bool incident() const { return m_incident; }
    bool trilinear() const { return m_trilinear; }
    /// Area below which a cell's light is divided by this instead [m^2].
    float minArea() const { return m_cells.lattice.cell * m_cells.lattice.cell * kMinAreaShare; }

private:
    LitCells m_cells;
    bool m_incident, m_trilinear;
};

} // namespace limn
