// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/sparse_probes/sparse_gather.h"

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace limn {

/// Overlays of sparse probes. Receivers are picked.
inline constexpr std::array<OverlayKind, 6> kSparseOverlays = {
    {{.name = "sparse-probes",
      .label = "Sparse probes",
      .tooltip = "Where probes stand: balls that show the light which reaches the probe from each "
                 "side",
      .showsLight = true},
     {.name = "sparse-unseen",
      .label = "Unseen by probes",
      .tooltip = "Share of what each texel sees that none of its eight probes sees: its light is "
                 "missing there"},
     {.name = "sparse-receiver",
      .label = "Probes of a texel",
      .tooltip = "The probes that light one texel, by their weight; click a surface to pick it",
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Texel",
      .pickedTooltip = "Number of the texel whose probes are shown; -1: none picked"},
     {.name = "sparse-rays",
      .label = "Relight rays",
      .tooltip = "The texels that light a probe: where the rays of the one nearest to a texel end, "
                 "by their distance; click a surface to pick the texel",
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Texel",
      .pickedTooltip = "Number of the texel; its nearest probe's rays are shown; -1: none picked"},
     {.name = "sparse-row",
      .label = "Transport to a texel",
      .tooltip = "How a texel weighs the light that its probes get from each side: its row of the "
                 "transport matrix as a lobe at each probe; click a surface to pick the texel",
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Texel",
      .pickedTooltip = "Number of the texel whose row is shown; -1: none picked"},
     {.name = "sparse-negative",
      .label = "Less than no light",
      .tooltip = "Irradiance before it is kept from being negative: texels where the harmonics "
                 "ring so much that less than no light would arrive",
      .showsLight = true}}};

/// The light of probes, copied.
class SparseSnapshot : public LightSnapshot {
public:
    explicit SparseSnapshot(ProbeRadiance probes) : m_probes(std::move(probes)) {}

    const Technique& technique() const override;
    const ProbeRadiance& probes() const { return m_probes; }

private:
    ProbeRadiance m_probes;
};

/// Builds an overlay of kSparseOverlays. `light` has the probes of `bake`; null: it is not known.
OverlayData sparseOverlay(const SparseBake& bake, const OverlayRequest& request, const Scene& scene,
                          const ProbeRadiance* light);

/// Describes a receiver: its place, what of its view is unseen, and its probes.
std::vector<OverlayLine> describeReceiver(const SparseBake& bake, const Scene& scene,
                                          std::uint32_t receiver);

/// The receiver of `bake` nearest to one of another bake, by its triangle; std::nullopt: none is on
/// the same instance.
std::optional<std::uint32_t> nearestReceiver(const SparseBake& bake, const SparseBake& other,
                                             std::uint32_t receiver);

} // namespace limn
