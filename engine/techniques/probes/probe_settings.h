// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <array>
#include <cstdint>

namespace limn {

// The technique's settings in documents.
inline constexpr TechniqueSetting kProbeCount = {
    .setting = {.key = "probes.count",
                .label = "Probes",
                .tooltip = "About this many probes stand in a lattice over the scene. More: light "
                           "changes over shorter distances, walls hide it better, and updates "
                           "take longer",
                .invalidates = Invalidates::Light},
    .range = {8, 4096},
    .usual = 256,
    .whole = true};
inline constexpr TechniqueSetting kProbeSide = {
    .setting = {.key = "probes.side",
                .label = "Map's side (texels)",
                .tooltip = "Each probe looks in the square of this many directions. More: small "
                           "bright things are not missed",
                .invalidates = Invalidates::Light},
    .range = {8, 256},
    .usual = 48,
    .whole = true};
inline constexpr TechniqueSetting kProbesPerUpdate = {
    .setting = {.key = "probes.perUpdate",
                .label = "Probes per update",
                .tooltip = "While light changes, each update lights this many probes anew, in "
                           "turn. More: light follows sooner, frames take longer",
                .invalidates = Invalidates::Light},
    .range = {1, 4096},
    .usual = 2,
    .whole = true};
inline constexpr TechniqueSetting kSmoothProbes = {
    .setting = {.key = "probes.smooth",
                .label = "Smooth weights",
                .tooltip = "Surfaces blend probes with the smoother weights of Majercik et al. "
                           "2019. Off: with those of McGuire et al. 2017",
                .invalidates = Invalidates::Light},
    .range = {0, 1},
    .usual = 0,
    .whole = true};
inline constexpr TechniqueSetting kProbeBounces = {
    .setting = {.key = "probes.bounces",
                .label = "More bounces",
                .tooltip = "Probes also see light that has bounced before, by what surfaces read "
                           "from probes. Off: light is reflected once, as in the paper",
                .invalidates = Invalidates::Light},
    .range = {0, 1},
    .usual = 0,
    .whole = true};
inline constexpr TechniqueSetting kProbeReflections = {
    .setting = {.key = "probes.reflections",
                .label = "Marched reflections",
                .tooltip = "Glossy surfaces reflect what rays meet that are marched through the "
                           "probes' maps: as sharp as the maps. Off, and in the editor where the "
                           "CPU computes the light: they reflect the probes' harmonics, a wide "
                           "blur",
                .invalidates = Invalidates::Light},
    .range = {0, 1},
    .usual = 1,
    .whole = true};
inline constexpr std::array kProbeSettings = {kProbeCount,   kProbeSide,    kProbesPerUpdate,
                                              kSmoothProbes, kProbeBounces, kProbeReflections};

/// LightingReport::lacks of light without the reflections that the document asks for.
inline constexpr const char* kLacksReflections =
    "glossy surfaces reflect the probes' harmonics; reflections are marched by limn render, and "
    "where the device computes the light";
/// The same of light on a device whose buffers may not be as large as the maps.
inline constexpr const char* kLacksLargeMaps =
    "glossy surfaces reflect the probes' harmonics, because the maps that reflections are marched "
    "through are larger than this device can bind; lower probes.side or probes.count";

/// Their values in a document.
struct ProbeSettings {
    std::uint32_t count = 256;   ///< probes wanted
    std::uint32_t side = 48;     ///< of a probe's map [texels]
    std::uint32_t perUpdate = 2; ///< probes that an update refreshes while somebody looks
    bool smooth = false;         ///< GridMoments::smooth
    bool bounces = false;        ///< light bounces more than once
    bool reflections = true;     ///< a MarchedPart, where there is a glossy receiver
};
ProbeSettings probeSettingsOf(const TechniqueChoice& choice);

} // namespace limn
