// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <array>
#include <cstdint>

namespace limn {

/// Settings of light propagation volumes, in the order of LpvSettings.
inline constexpr std::array<TechniqueSetting, 5> kLpvSettings = {
    {{.setting = {.key = "lpv.resolution",
                  .label = "Cells along the longest side",
                  .tooltip =
                      "The scene's box is divided into cubic cells, this many along its longest "
                      "side. Time and memory grow with the cube",
                  .invalidates = Invalidates::Light},
      .range = {4, 128},
      .usual = 32,
      .whole = true},
     {.setting = {.key = "lpv.rounds",
                  .label = "Rounds of propagation",
                  .tooltip =
                      "In each round light moves on by one cell. With fewer rounds than half "
                      "the cells along a side, it does not reach the far end of a room. 0: half "
                      "the cells along the longest side",
                  .invalidates = Invalidates::Light},
      .range = {0, 1024},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "lpv.map_size",
                  .label = "Reflective shadow map (texels)",
                  .tooltip =
                      "Texels along a side of each view of a light: one for a sun or a narrow "
                      "spot, six for other spots and points, and for a rectangle 24 of half "
                      "the size. Rays are traced only where a light, an object or a material "
                      "changed",
                  .invalidates = Invalidates::Light},
      .range = {16, 1024},
      .usual = 128,
      .whole = true},
     {.setting = {.key = "lpv.flux_lookup",
                  .label = "Irradiance from flux",
                  .tooltip =
                      "On: a surface receives the flux that arrives through its cell's face. "
                      "Off: the cell's light counts as a point light half a cell away, as in "
                      "the paper of 2010, which is brighter by a factor of 1.91",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 1,
      .whole = true},
     {.setting = {.key = "lpv.emitters",
                  .label = "Emissive surfaces",
                  .tooltip =
                      "Emissive surfaces send light into the lattice, too, which the paper's "
                      "technique does not do. No surface reflects that light",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 1,
      .whole = true}}};

/// The settings' values.
struct LpvSettings {
    std::uint32_t resolution = 0, rounds = 0, mapSize = 0;
    bool fluxLookup = false, emitters = false;
    bool operator==(const LpvSettings&) const = default;
};

inline LpvSettings lpvSettingsOf(const TechniqueChoice& choice) {
    const auto resolution = std::uint32_t(settingOf(choice, kLpvSettings[0]));
    const auto rounds = std::uint32_t(settingOf(choice, kLpvSettings[1]));
    return {.resolution = resolution,
            .rounds = rounds > 0 ? rounds : resolution / 2,
            .mapSize = std::uint32_t(settingOf(choice, kLpvSettings[2])),
            .fluxLookup = settingOf(choice, kLpvSettings[3]) > 0,
            .emitters = settingOf(choice, kLpvSettings[4]) > 0};
}

} // namespace limn
