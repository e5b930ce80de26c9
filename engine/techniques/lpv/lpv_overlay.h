// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/lpv/lit_lattice.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace limn {

/// Overlays of light propagation volumes. Cells are picked.
inline constexpr std::array<OverlayKind, 5> kLpvOverlays = {
    {{.name = "lpv-lobes",
      .label = "LPV cells: light",
      .tooltip =
          "Light that leaves the lattice's cells after all rounds: its directions as a lobe, "
          "its flux as a colour. Click a surface to pick the cell in front of it",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .picked = "Cell",
      .pickedTooltip = "Number of the lattice's cell that is shown alone; -1: none picked"},
     {.name = "lpv-injected",
      .label = "LPV cells: injected",
      .tooltip = "The same before the first round: what lit surfaces and emitters send",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .picked = "Cell",
      .pickedTooltip = "Number of the lattice's cell that is shown alone; -1: none picked"},
     {.name = "lpv-blockers",
      .label = "LPV blockers",
      .tooltip =
          "The geometry volume: share of the light between two cells that surfaces block, on "
          "the cells' faces",
      .showsLight = true},
     {.name = "lpv-texels",
      .label = "LPV shadow map texels",
      .tooltip =
          "Texels of the lights' reflective shadow maps, by the flux that they send into the "
          "lattice. Rings: cells that are lit from both sides of a thin wall",
      .showsLight = true},
     {.name = "lpv-arrival",
      .label = "LPV arrival of light",
      .tooltip =
          "The round after which light arrives in the cell before a surface: far surfaces stay "
          "dark where there are fewer rounds than cells on the way",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .picked = "Cell",
      .pickedTooltip = "Number of the lattice's cell that is described; -1: none picked"}}};

class LpvSnapshot : public LightSnapshot {
public:
    explicit LpvSnapshot(LitLattice lit) : m_lit(std::move(lit)) {}

    const Technique& technique() const override;
    OverlayData overlay(const OverlayRequest& request, const Scene& scene,
                        const LightSnapshot* light) const override;
    std::uint32_t pickCount() const override { return std::uint32_t(m_lit.lattice.cells()); }
    std::optional<std::uint32_t> pickAt(const Scene& scene, const Hit& hit) const override;
    std::optional<std::uint32_t> nearestPick(const OverlaySource& other,
                                             std::uint32_t pick) const override;
    std::vector<OverlayLine> describePick(const Scene& scene, std::uint32_t pick) const override;

private:
    LitLattice m_lit;
};

/// Flux of a lobe of intensity [W].
glm::vec3 fluxOf(const Lobe& lobe);

/// Largest share of the light along an axis, either way, that is blocked at the lower face of cell
/// `c` across that axis; `c` may be one past the last cell. May exceed 1.
float blockedShare(const FaceBlockers& blockers, int axis, glm::ivec3 c);

} // namespace limn
