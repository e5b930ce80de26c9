// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/probes/probe_light.h"
#include "engine/techniques/probes/probe_maps.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace limn {

/// Overlays of light field probes. Probes are picked.
inline constexpr std::array<OverlayKind, 3> kProbeOverlays = {
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
      .pickedTooltip = "Number of the probe that is described; -1: none picked"}}};

/// A probe's state.
struct ProbeAge {
    std::uint32_t updates = 0; ///< since it was lit: 0 by the last one
    bool stale = false;        ///< what it shows has changed since
    bool lit = false;          ///< it ever was
};

/// Lit probes, copied.
struct LitProbes {
    ProbeMaps maps;
    std::vector<ProbeHarmonics> light; ///< per probe, radiance [W m^-2 sr^-1]
    std::vector<ProbeAge> ages;        ///< per probe
};

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
