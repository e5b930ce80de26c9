// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/arrival_overlay.h"

#include "engine/overlay/palette.h"
#include "engine/techniques/lpv/arrival.h"
#include "engine/techniques/lpv/blockers.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace limn {

namespace {

constexpr float kSideScale = 0.3f; // half a mark's side over a cell's
constexpr float kLift = 0.02f;     // of marks off surfaces, over a cell's side

const glm::vec3 kDarkColor(0.35f);

/// A side of a surface, and the cell in front of it.
struct FacedSide {
    glm::vec3 position, normal;
    std::uint32_t cell;
};

/// Sides of surfaces to be marked: for each cell and each of the six directions along the axes at
/// most one that has the cell in front of it and faces that way.
std::vector<FacedSide> facedSides(const Scene& scene, const Lattice& lattice) {
    std::vector<FacedSide> sides;
    std::vector<std::uint8_t> taken(6 * lattice.cells());
    const auto add = [&](glm::vec3 position, glm::vec3 n) {
        const std::uint32_t cell = lattice.index(lattice.at(position + n * (0.5f * lattice.cell)));
        const glm::vec3 size = glm::abs(n);
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        std::uint8_t& known = taken[6 * std::size_t(cell) + 2 * std::size_t(axis) + (n[axis] > 0)];
        if (!std::exchange(known, 1))
            sides.push_back({position, n, cell});
    };
    for (const SurfacePiece& piece : surfacePieces(scene, lattice.cell)) {
        add(piece.position, piece.normal);
        if (piece.twoSided)
            add(piece.position, -piece.normal);
    }
    return sides;
}

} // namespace

OverlayData arrivalOverlay(const LitLattice& lit, const Scene& scene) {
    const Lattice& lattice = lit.lattice;
    const std::vector<std::uint32_t> arrival =
        arrivalRounds(lit.injected, &lit.blockers, lit.rounds);
    const auto colorOf = [&](std::uint32_t round) {
        return round == kNeverLit ? kDarkColor
                                  : viridis(1 - float(round) / float(std::max(lit.rounds, 1U)));
    };
    OverlayData out;
    std::uint32_t dark = 0;
    for (const FacedSide& side : facedSides(scene, lattice)) {
        dark += arrival[side.cell] == kNeverLit ? 1 : 0;
        out.marks.push_back({.position = side.position + side.normal * (kLift * lattice.cell),
                             .radius = kSideScale * lattice.cell,
                             .normal = side.normal,
                             .color = packColor(colorOf(arrival[side.cell])),
                             .shape = MarkShape::Square});
    }
    out.legend.title = "Rounds until light arrives";
    for (int k = 0; k <= 4; ++k) {
        const std::uint32_t round = lit.rounds * std::uint32_t(k) / 4;
        out.legend.entries.push_back(
            {packColor(colorOf(round)),
             round == 0 ? std::string("0: light is injected") : fmt::format("{}", round)});
    }
    out.legend.entries.push_back(
        {packColor(kDarkColor),
         fmt::format("none in {} rounds: {} of {} marks", lit.rounds, dark, out.marks.size())});
    out.legend.notes = {
        fmt::format("A mark for each cell and side of a surface before it; light has "
                    "arrived when the cell has {:g} % of what it gets in all rounds",
                    100 * kArrivedShare)};
    return out;
}

} // namespace limn
