// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <array>
#include <cstdint>
#include <numbers>

namespace limn {

/// Settings of LightSkin, in the order of SkinSettings.
inline constexpr std::array<TechniqueSetting, 12> kSkinSettings = {
    {{.setting = {.key = "light-skin.vals",
                  .label = "Chosen virtual area lights",
                  .tooltip = "Texels of each light's reflective shadow map that light the caches, "
                             "chosen at random by their importance for the view. Fewer flicker",
                  .invalidates = Invalidates::Light},
      .range = {16, 65536},
      .usual = 2048,
      .whole = true},
     {.setting = {.key = "light-skin.map_size",
                  .label = "Reflective shadow map (texels)",
                  .tooltip =
                      "Texels along a side of each view of a light: one for a sun or a narrow "
                      "spot, six for other spots and points, and for a rectangle 24 of half "
                      "the size. Rays are traced only where a light, an object or a material "
                      "changed",
                  .invalidates = Invalidates::Light},
      .range = {8, 2048},
      .usual = 128,
      .whole = true},
     {.setting = {.key = "light-skin.samples",
                  .label = "View samples",
                  .tooltip = "Pixels of the view at which the importance of texels is measured",
                  .invalidates = Invalidates::Light},
      .range = {16, 4096},
      .usual = 256,
      .whole = true},
     {.setting = {.key = "light-skin.all",
                  .label = "All texels",
                  .tooltip = "Every texel of the reflective shadow maps lights the caches, none is "
                             "chosen. Slow, without noise",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "light-skin.spacing",
                  .label = "Distance of caches (% of the diagonal)",
                  .tooltip = "Largest distance of a surface point from the nearest cache, as a "
                             "share of the diagonal of the static objects' box. It grows where "
                             "there would be too many caches",
                  .invalidates = Invalidates::Light},
      .range = {0.25, 30},
      .usual = 2},
     {.setting = {.key = "light-skin.angle",
                  .label = "Angle of caches (degrees)",
                  .tooltip = "Surfaces whose normals differ by more than this have caches of their "
                             "own",
                  .invalidates = Invalidates::Light},
      .range = {5, 80},
      .usual = 30},
     {.setting = {.key = "light-skin.defence",
                  .label = "Share drawn by flux and area",
                  .tooltip =
                      "Share of the virtual area lights that is chosen by their flux alone, "
                      "and by their area alone, half each. With 0, light that no view sample "
                      "faces never arrives, and faint texels displace the proxy lights",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0.1},
     {.setting = {.key = "light-skin.vertex_lists",
                  .label = "Lists at vertices",
                  .tooltip = "On: a pixel reads the caches nearest to the next vertex, as in the "
                             "paper, which needs fine meshes. Off: those nearest to its part of "
                             "the surface",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "light-skin.glossy",
                  .label = "Glossy proxies",
                  .tooltip = "A second proxy light of each cache is for reflections towards the "
                             "view. Off: glossy surfaces reflect no bounced light",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 1,
      .whole = true},
     {.setting = {.key = "light-skin.shade",
                  .label = "Shade of caches",
                  .tooltip = "Caches between a cache and its proxy lights take their share of the "
                             "light as discs. Off: bounced light passes through everything",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 1,
      .whole = true},
     {.setting = {.key = "light-skin.visible_caches",
                  .label = "Samples at visible caches",
                  .tooltip = "On: the importance of texels is that for all caches which the view "
                             "shows, in place of random pixels. They stay where they are when the "
                             "view moves, and far surfaces count as much as near ones",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "light-skin.renew",
                  .label = "Renewed share",
                  .tooltip = "Share of the chosen virtual area lights that is chosen again in each "
                             "update. With less than 1 light flickers less while the view moves, "
                             "and is complete only after as many updates as shares",
                  .invalidates = Invalidates::Light},
      .range = {0.02f, 1},
      .usual = 1}}};

/// The settings' values.
struct SkinSettings {
    std::uint32_t vals = 0, mapSize = 0, samples = 0;
    bool all = false;
    float spacing = 0; ///< share of the diagonal
    float angle = 0;   ///< [rad]
    float defence = 0;
    bool vertexLists = false, glossy = false, shade = false, visibleCaches = false;
    float renew = 1; ///< share of the draws, (0, 1]
    bool operator==(const SkinSettings&) const = default;
};

inline SkinSettings skinSettingsOf(const TechniqueChoice& choice) {
    const auto number = [&](std::size_t k) { return settingOf(choice, kSkinSettings[k]); };
    return {.vals = std::uint32_t(number(0)),
            .mapSize = std::uint32_t(number(1)),
            .samples = std::uint32_t(number(2)),
            .all = number(3) > 0,
            .spacing = float(number(4) / 100),
            .angle = float(number(5) * std::numbers::pi / 180),
            .defence = float(number(6)),
            .vertexLists = number(7) > 0,
            .glossy = number(8) > 0,
            .shade = number(9) > 0,
            .visibleCaches = number(10) > 0,
            .renew = float(number(11))};
}

} // namespace limn
