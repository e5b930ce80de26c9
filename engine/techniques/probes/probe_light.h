// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/math/sh.h"
#include "engine/techniques/probes/probe_maps.h"
#include "engine/trace/direct_light.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Spherical harmonics of the radiance that arrives at a probe, three bands.
using ProbeHarmonics = std::array<glm::vec3, kIrradianceBands * kIrradianceBands>;

/// Radiance at all probes, divided by where it comes from. Origins are the lights of the scene, in
/// its order, and then the three below.
struct ProbeLight {
    std::uint32_t lights = 0; ///< number of the scene's lights
    /// Per probe and origin. Those of a light are for a colour and a strength of 1, so that editing
    /// them needs no ray.
    std::vector<ProbeHarmonics> parts;
    /// Per origin, of the same lights: radiance of every texel of every probe's map
    /// [W m^-2 sr^-1]. Origins that were not computed are empty; all are if !keepsTexels.
    std::vector<std::vector<glm::vec3>> texels;
    bool keepsTexels = false;

    std::uint32_t emitters() const { return lights; }    ///< emissive surfaces, seen straight
    std::uint32_t sky() const { return lights + 1; }     ///< seen straight
    std::uint32_t bounced() const { return lights + 2; } ///< what surfaces reflect of the field
    std::uint32_t origins() const { return lights + 3; }
    ProbeHarmonics& part(std::uint32_t probe, std::uint32_t origin) {
        return parts[std::size_t(probe) * origins() + origin];
    }
    const ProbeHarmonics& part(std::uint32_t probe, std::uint32_t origin) const {
        return parts[std::size_t(probe) * origins() + origin];
    }
};

/// What lights a probe's hits.
struct ProbeScene {
    const Scene& scene;
    const TraceScene& trace;
    const ProbeMaps& maps;
    const std::vector<float>& solidAngles; ///< of maps.map
    const IndirectField& field;            ///< read by ProbeLight::bounced()
};

/// A surface point in a probe's map.
struct MapPoint {
    LitPoint lit;
    glm::vec3 albedo{0}, emission{0}; ///< means over the texel; emission [W m^-2 sr^-1]
};

/// The point that a probe sees in the direction of a texel of its map, which is not the sky.
/// Reads no field.
MapPoint mapPoint(const ProbeScene& in, std::uint32_t probe, std::uint32_t texel);

/// Recomputes the listed origins of a probe: lights what its map shows, with a shadow ray from each
/// hit to each of these lights, projects the radiance, and keeps it if light.keepsTexels. The share
/// of the hits in solids is black. Returns the number of rays.
std::uint64_t lightProbe(const ProbeScene& in, std::uint32_t probe,
                         const std::vector<std::uint32_t>& origins, ProbeLight& light);

} // namespace limn
