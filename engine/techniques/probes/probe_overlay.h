// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/probes/lit_probes.h"

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace limn {

/// Overlays of light field probes. Probes are picked.
inline constexpr std::array<OverlayKind, 6> kProbeOverlays = {
    {{.name = "probes",
      .label = "Probes",
      .tooltip = "Where probes stand: balls that show the light which reaches the probe from each "
                 "side. Magenta squares: probes in solids, whose light is not used",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .picked = "Probe",
      .pickedTooltip = "Number of the probe that is described; -1: none picked"},
     {.name = "probe-rays",
      .label = "Probe rays",
      .tooltip = "What one probe sees: the surfaces that its rays meet, by their distance; click a "
                 "surface to pick the nearest probe",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Probe",
      .pickedTooltip = "Number of the probe whose rays are shown; -1: none picked"},
     {.name = "probe-age",
      .label = "Probe age",
      .tooltip = "How many updates ago each probe was lit, and which probes are stale: still lit "
                 "as the scene was before it changed",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .picked = "Probe",
      .pickedTooltip = "Number of the probe that is described; -1: none picked"},
     {.name = "probe-weights",
      .label = "Weight of a probe",
      .tooltip = "Which surfaces are lit by one probe, and how much of their light it gives; click "
                 "a surface to pick the nearest probe",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Probe",
      .pickedTooltip = "Number of the probe whose weights are shown; -1: none picked"},
     {.name = "probe-visibility",
      .label = "Visibility by a probe",
      .tooltip = "Which surfaces a probe counts as seen, by its distances alone: hidden ones that "
                 "are bright get light through walls",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Probe",
      .pickedTooltip = "Number of the probe that is shown; -1: none picked"},
     {.name = "probe-reflections",
      .label = "Marched reflections",
      .tooltip = "Where reflections end that are marched through the probes' maps, from all that "
                 "one probe sees: at a surface, in the sky, or unknown",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Probe",
      .pickedTooltip = "Number of the probe from which reflections are looked at; -1: none "
                       "picked"}}};

class ProbeSnapshot : public LightSnapshot {
public:
    explicit ProbeSnapshot(LitProbes lit) : m_lit(std::move(lit)) {}

    const Technique& technique() const override;
    OverlayData overlay(const OverlayRequest& request, const Scene& scene,
                        const LightSnapshot* light) const override;
    std::uint32_t pickCount() const override { return m_lit.maps.grid.count(); }
    std::optional<std::uint32_t> pickAt(const Scene& scene, const Hit& hit) const override;
    std::optional<std::uint32_t> nearestPick(const OverlaySource& other,
                                             std::uint32_t pick) const override;
    std::vector<OverlayLine> describePick(const Scene& scene, std::uint32_t pick) const override;

private:
    std::optional<std::uint32_t> nearest(glm::vec3 place) const;

    LitProbes m_lit;
};

} // namespace limn
