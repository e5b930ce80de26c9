// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <array>
#include <cstdint>

namespace limn {

/// What the precomputation depends on besides the scene and its bake settings, of which it reads
/// the number of texels, the rays and the grid.
struct SparseSettings {
    std::uint32_t probes = 80;     ///< wanted
    std::uint32_t cells = 32;      ///< of the open air, along the scene's longest side
    std::uint32_t rays = 800;      ///< Q: relight rays of a probe
    std::uint32_t bands = 4;       ///< of a probe's harmonics
    std::uint32_t compression = 0; ///< [%] of each cluster's matrix that may be lost; 0: all kept
    std::uint32_t unchecked = 0; ///< 1: what no probe sees is taken from all of a receiver's probes

    bool operator==(const SparseSettings&) const = default;
};

/// The technique's settings in documents, in the order of the inspector. The last one alone belongs
/// to updates.
inline constexpr std::array<TechniqueSetting, 7> kSparseSettings = {{
    {.setting = {.key = "sparse-probes.count",
                 .label = "Probes",
                 .tooltip = "About how many probes are kept in the open air. More: finer light, "
                            "longer updates. Needs a bake"},
     .range = {9, 4096},
     .usual = 80,
     .whole = true},
    {.setting = {.key = "sparse-probes.bands",
                 .label = "Bands of probes",
                 .tooltip = "Bands of spherical harmonics in which probes hold radiance, l² "
                            "numbers each. More: sharper light, larger matrices. Needs a bake"},
     .range = {1, 8},
     .usual = 4,
     .whole = true},
    {.setting = {.key = "sparse-probes.rays",
                 .label = "Relight rays",
                 .tooltip = "Rays by which each probe finds the texels that light it. More: less "
                            "noise, longer updates. Needs a bake"},
     .range = {50, 8000},
     .usual = 800,
     .whole = true},
    {.setting = {.key = "sparse-probes.cells",
                 .label = "Cells of the air",
                 .tooltip = "Cells along the longest side of the scene in which open air is looked "
                            "for. Probes stand in the middles of those beside surfaces. Needs a "
                            "bake"},
     .range = {8, 64},
     .usual = 32,
     .whole = true},
    {.setting = {.key = "sparse-probes.unchecked",
                 .label = "Light what no probe sees",
                 .tooltip = "What none of the eight probes of a texel sees is taken from all of "
                            "them. Off: it is black. On: light may leak. Needs a bake"},
     .range = {0, 1},
     .usual = 0,
     .whole = true},
    {.setting = {.key = "sparse-probes.compression",
                 .label = "Compression (%)",
                 .tooltip = "Share of the matrices of each cluster of texels that may be lost by "
                            "keeping their strongest components alone [%]. More: less memory, "
                            "faster updates, larger errors. 0: not compressed. What would get "
                            "larger stays as it is. Needs a bake"},
     .range = {0, 50},
     .usual = 0,
     .whole = true},
    {.setting = {.key = "sparse-probes.clamp",
                 .label = "Clamp each probe",
                 .tooltip = "Negative irradiance from any single probe counts as 0, as in the "
                            "paper's program, which adds light. Off: only negative sums do",
                 .invalidates = Invalidates::Light},
     .range = {0, 1},
     .usual = 0,
     .whole = true},
}};

/// Their values in a document.
SparseSettings sparseSettingsOf(const TechniqueChoice& choice);

/// Whether each probe's part of the irradiance is kept from being negative, as the paper's program
/// does, and not only the sum.
bool clampsParts(const TechniqueChoice& choice);

/// Lists the fields of SparseSettings, each within its range. `s` is a SparseSettings, const or
/// not.
template <class S, class Visit>
void visitSparseSettings(S& s, const Visit& visit) {
    visit(kSparseSettings[0], s.probes);
    visit(kSparseSettings[1], s.bands);
    visit(kSparseSettings[2], s.rays);
    visit(kSparseSettings[3], s.cells);
    visit(kSparseSettings[4], s.unchecked);
    visit(kSparseSettings[5], s.compression);
}

} // namespace limn
