// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_settings.h"

#include <cstddef>

namespace limn {

static constexpr std::array<const char*, 2> kModes = {"by the surfaces hit", "by directions"};
static constexpr std::array<const char*, 6> kBlurs = {
    "none", "6 neighbours", "3 x 3 x 3, weighted", "3 x 3 x 3", "5 x 5 x 5, weighted", "5 x 5 x 5"};
static constexpr std::array<const char*, 3> kSplats = {"none", "caustics", "all light"};

constinit const std::array<TechniqueSetting, 15> kPhotonSettings = {
    {{.setting = {.key = "photon-lattices.photons",
                  .label = "Photons of a light",
                  .tooltip = "Each light, each emissive material and the sky send this many "
                             "photons. Noise falls with their root, time grows with their number",
                  .invalidates = Invalidates::Light},
      .range = {16, 1e7},
      .usual = 20000,
      .whole = true},
     {.setting = {.key = "photon-lattices.bounces",
                  .label = "Diffuse bounces",
                  .tooltip = "Number of diffuse reflections after which a photon ends, that of "
                             "the surface which its light sees among them",
                  .invalidates = Invalidates::Light},
      .range = {1, 64},
      .usual = 1,
      .whole = true},
     {.setting = {.key = "photon-lattices.specular",
                  .label = "Specular bounces",
                  .tooltip = "Number of reflections by metal and passages through glass after "
                             "which a photon ends. 0: metal and glass cast no light",
                  .invalidates = Invalidates::Light},
      .range = {0, 64},
      .usual = 8,
      .whole = true},
     {.setting = {.key = "photon-lattices.mode",
                  .label = "Light of a cell",
                  .tooltip = "0: a surface receives the light of the photons in its cell that "
                             "arrived on surfaces facing its way, which is never negative. 1: "
                             "that from the directions in which photons came, as in the thesis",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true,
      .choices = kModes},
     {.setting = {.key = "photon-lattices.blur",
                  .label = "Blur",
                  .tooltip = "Cells of the two coarse lattices that are averaged. 0: none, 1: six "
                             "neighbours, 2: 3 x 3 x 3 weighted, 3: 3 x 3 x 3, 4: 5 x 5 x 5 "
                             "weighted, 5: 5 x 5 x 5",
                  .invalidates = Invalidates::Light},
      .range = {0, 5},
      .usual = 3,
      .whole = true,
      .choices = kBlurs},
     {.setting = {.key = "photon-lattices.lookup",
                  .label = "Trilinear lookup",
                  .tooltip = "Off: a surface receives the light of its cell. On: of the eight "
                             "cells around it, which hides their borders and blurs caustics",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "photon-lattices.low",
                  .label = "Cells of the coarse lattice",
                  .tooltip = "Cells along the scene's longest side of the lattice for diffuse "
                             "light where photons are few",
                  .invalidates = Invalidates::Light},
      .range = {2, 32},
      .usual = 4,
      .whole = true},
     {.setting = {.key = "photon-lattices.mid",
                  .label = "Cells of the middle lattice",
                  .tooltip = "Cells along the scene's longest side of the lattice for diffuse "
                             "light where photons are many",
                  .invalidates = Invalidates::Light},
      .range = {2, 64},
      .usual = 8,
      .whole = true},
     {.setting = {.key = "photon-lattices.high",
                  .label = "Cells of the fine lattice",
                  .tooltip = "Cells along the scene's longest side of the lattice for light that "
                             "metal reflects or glass refracts onto a surface",
                  .invalidates = Invalidates::Light},
      .range = {8, 256},
      .usual = 128,
      .whole = true},
     {.setting = {.key = "photon-lattices.emitters",
                  .label = "Emissive surfaces",
                  .tooltip = "Emissive surfaces send photons, too. Those that arrive are stored "
                             "at once, as no other step adds that light",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 1,
      .whole = true},
     {.setting = {.key = "photon-lattices.sky",
                  .label = "Sky",
                  .tooltip = "The sky sends photons, too, from discs around the scene",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "photon-lattices.splat",
                  .label = "Splats",
                  .tooltip = "Photons that light the surface around them, each a disc, instead of "
                             "their cells. 0: none, 1: those of the fine lattice, 2: all, as in "
                             "image space photon mapping",
                  .invalidates = Invalidates::Light},
      .range = {0, 2},
      .usual = 0,
      .whole = true,
      .choices = kSplats},
     {.setting = {.key = "photon-lattices.splat_radius",
                  .label = "Radius of splats",
                  .tooltip = "Radius of the discs as a share of the scene's longest side. Larger: "
                             "less noise, softer light, longer pictures",
                  .invalidates = Invalidates::Light},
      .range = {1e-3, 0.25},
      .usual = 0.02},
     {.setting = {.key = "photon-lattices.still",
                  .label = "Photons of a light at rest",
                  .tooltip = "When nothing but the camera has moved since the last update, and "
                             "for the first one, each light sends this many photons once. 0: no "
                             "more than usual",
                  .invalidates = Invalidates::Light},
      .range = {0, 1e7},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "photon-lattices.few",
                  .label = "Few photons",
                  .tooltip = "Where the 27 cells around a photon in the middle lattice hold fewer "
                             "of its light than this, it goes into the coarse one",
                  .invalidates = Invalidates::Light},
      .range = {0, 1000},
      .usual = 8,
      .whole = true}}};

PhotonSettings photonSettingsOf(const TechniqueChoice& choice) {
    const auto value = [&](std::size_t i) { return settingOf(choice, kPhotonSettings[i]); };
    const auto number = [&](std::size_t i) { return std::uint32_t(value(i)); };
    return {.paths = {.photons = number(0), .bounces = number(1), .specular = number(2)},
            .injection = {.incident = value(3) > 0,
                          .low = number(6),
                          .mid = number(7),
                          .high = number(8),
                          .splats = PhotonSplats(number(11)),
                          .few = number(14)},
            .blur = PhotonBlur(number(4)),
            .trilinear = value(5) > 0,
            .emitters = value(9) > 0,
            .sky = value(10) > 0,
            .splatRadius = float(value(12)),
            .still = number(13)};
}

} // namespace limn
