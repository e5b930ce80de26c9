// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/volume_settings.h"

#include <bit>

namespace limn {

static constexpr std::array<const char*, 3> kShadows = {"none", "directional", "published"};
static constexpr std::array<const char*, 3> kReflections = {"harmonics", "published", "microfacet"};

constinit const std::array<TechniqueSetting, 16> kVolumeSettings = {
    {{.setting = {.key = "radiance-volumes.read",
                  .label = "Area lights along a side",
                  .tooltip =
                      "Each light is replaced by about the square of this number of virtual area "
                      "lights, which its views share. Rounded to a power of two for each view",
                  .invalidates = Invalidates::Light},
      .range = {4, 256},
      .usual = 32,
      .whole = true},
     {.setting = {.key = "radiance-volumes.map",
                  .label = "Reflective shadow map (texels)",
                  .tooltip =
                      "Texels along a side of each view of a light, a power of two; texels are "
                      "averaged until there are as few as area lights",
                  .invalidates = Invalidates::Light},
      .range = {16, 2048},
      .usual = 128,
      .whole = true},
     {.setting = {.key = "radiance-volumes.bands",
                  .label = "Bands of a cache",
                  .tooltip = "Bands of the harmonics in which a cache keeps its light",
                  .invalidates = Invalidates::Light},
      .range = {2, 3},
      .usual = 2,
      .whole = true},
     {.setting = {.key = "radiance-volumes.cascades",
                  .label = "Cascades",
                  .tooltip = "Grids around the eye, each with half the side of the one before. The "
                             "largest one has twice the scene's longest side",
                  .invalidates = Invalidates::Light},
      .range = {1, 4},
      .usual = 3,
      .whole = true},
     {.setting = {.key = "radiance-volumes.nodes",
                  .label = "Nodes along a cascade's side",
                  .tooltip = "Places where a cascade may have a cache, along each side",
                  .invalidates = Invalidates::Light},
      .range = {16, 256},
      .usual = 32,
      .whole = true},
     {.setting = {.key = "radiance-volumes.caches",
                  .label = "Caches",
                  .tooltip =
                      "The largest number of caches. Fine cascades lose theirs first where the "
                      "view needs more",
                  .invalidates = Invalidates::Light},
      .range = {8, 1 << 20},
      .usual = 4096,
      .whole = true},
     {.setting = {.key = "radiance-volumes.transition",
                  .label = "Transition (cells)",
                  .tooltip = "Width of the band in which the light of two cascades is mixed",
                  .invalidates = Invalidates::Light},
      .range = {0, 10},
      .usual = 2},
     {.setting = {.key = "radiance-volumes.level",
                  .label = "Area lights that share a shadow",
                  .tooltip =
                      "Blocks of 2^level x 2^level area lights are shadowed by a single cone",
                  .invalidates = Invalidates::Light},
      .range = {0, 8},
      .usual = 2,
      .whole = true},
     {.setting = {.key = "radiance-volumes.shadow",
                  .label = "Shadows",
                  .tooltip =
                      "Whether area lights cast shadows, by cones through voxels. Directional (1): "
                      "voxels are averaged for each direction. Published (2): the cones of the "
                      "thesis, which let light through walls and are dimmed by the surface that "
                      "sends it",
                  .invalidates = Invalidates::Light},
      .range = {0, 2},
      .usual = 1,
      .whole = true,
      .choices = kShadows},
     {.setting = {.key = "radiance-volumes.voxels",
                  .label = "Voxels along a side",
                  .tooltip =
                      "Voxels along each side of the cube in which cones are followed, a power of "
                      "two",
                  .invalidates = Invalidates::Light},
      .range = {16, 512},
      .usual = 64,
      .whole = true},
     {.setting = {.key = "radiance-volumes.rate",
                  .label = "Fading of voxels",
                  .tooltip =
                      "Where an object moves, opacities of voxels change by this share in each "
                      "update, so that shadows do not pop. 0: at once",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0},
     {.setting =
          {.key = "radiance-volumes.glossy",
           .label = "Reflections",
           .tooltip =
               "Harmonics: glossy surfaces reflect those of the caches. Published: each cache "
               "keeps a map of its light for them, which reflects less the more obliquely one "
               "looks. Microfacet: the same with lobes that reflect as much at all angles",
           .invalidates = Invalidates::Light},
      .range = {0, 2},
      .usual = 0,
      .whole = true,
      .choices = kReflections},
     {.setting = {.key = "radiance-volumes.tile",
                  .label = "Map for reflections (texels)",
                  .tooltip = "Texels along a side of a cache's map, a power of two",
                  .invalidates = Invalidates::Light},
      .range = {4, 64},
      .usual = 16,
      .whole = true},
     {.setting = {.key = "radiance-volumes.fill",
                  .label = "Levels of maps that are filled",
                  .tooltip =
                      "Dark texels of this many levels of the maps for reflections take the light "
                      "of the next coarser level, so that single area lights do not show",
                  .invalidates = Invalidates::Light},
      .range = {0, 5},
      .usual = 0,
      .whole = true},
     {.setting = {.key = "radiance-volumes.freeze",
                  .label = "Freeze the caches' view",
                  .tooltip =
                      "On: caches stay those of the view that they were last placed for, so that "
                      "the camera can step out and look at them",
                  .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true},
     {.setting =
          {.key = "radiance-volumes.clamp",
           .label = "Clamp each cache",
           .tooltip =
               "On: irradiance below 0 of a cache, which few bands cause, counts as 0 before "
               "caches are mixed, which adds light. Off: only their mean is clamped",
           .invalidates = Invalidates::Light},
      .range = {0, 1},
      .usual = 0,
      .whole = true}}};

VolumeSettings volumeSettingsOf(const TechniqueChoice& choice) {
    const auto value = [&](std::size_t i) { return settingOf(choice, kVolumeSettings[i]); };
    const auto whole = [&](std::size_t i) { return std::uint32_t(value(i)); };
    return {.read = whole(0),
            .map = std::bit_floor(whole(1)),
            .bands = whole(2),
            .cascades = whole(3),
            .nodes = whole(4),
            .caches = whole(5),
            .transition = float(value(6)),
            .level = whole(7),
            .shadow = ConeShadows(whole(8)),
            .voxels = std::bit_floor(whole(9)),
            .rate = float(value(10)),
            .glossy = value(11) > 0,
            .microfacet = value(11) > 1,
            .tile = std::bit_floor(whole(12)),
            .fill = whole(13),
            .freeze = value(14) > 0,
            .clamp = value(15) > 0};
}

} // namespace limn
