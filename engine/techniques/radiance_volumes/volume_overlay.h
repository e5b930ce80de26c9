// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/radiance_volumes/lit_volume.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace limn {

/// Overlays of radiance volumes. Caches are picked.
inline constexpr std::array<OverlayKind, 4> kVolumeOverlays = {
    {{.name = "volume-caches",
      .label = "Radiance volumes: caches",
      .tooltip =
          "The caches by cascade, or the light of the picked one as a lobe. Rings: places that the "
          "view needs beyond the number of caches. Click a surface to pick the cache that counts "
          "most there and to read all of that point's",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .picked = "Cache",
      .pickedTooltip = "Number of the cache that is shown alone; -1: none picked"},
     {.name = "volume-cascades",
      .label = "Radiance volumes: cascades",
      .tooltip = "Which cascades light what the view shows, and which points find no cache",
      .showsLight = true},
     {.name = "volume-voxels",
      .label = "Radiance volumes: voxels",
      .tooltip =
          "The voxels that cast shadows. Of a picked cache, the spheres of the cone towards the "
          "area lights that give it most",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .picked = "Cache",
      .pickedTooltip = "Number of the cache whose cone is shown; -1: none"},
     {.name = "volume-visibility",
      .label = "Radiance volumes: visibility",
      .tooltip =
          "The virtual area lights by the share of their light that reaches the picked cache",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Cache",
      .pickedTooltip = "Number of the cache"}}};

class VolumeSnapshot : public LightSnapshot {
public:
    explicit VolumeSnapshot(LitVolume lit) : m_lit(std::move(lit)) {}

    const Technique& technique() const override;
    OverlayData overlay(const OverlayRequest& request, const Scene& scene,
                        const LightSnapshot* light) const override;
    std::uint32_t pickCount() const override;
    std::optional<std::uint32_t> pickAt(const Scene& scene, const Hit& hit) const override;
    std::optional<std::uint32_t> nearestPick(const OverlaySource& other,
                                             std::uint32_t pick) const override;
    std::vector<OverlayLine> describePick(const Scene& scene, std::uint32_t pick) const override;
    std::vector<OverlayLine> describeAt(const OverlayRequest& request, const Scene& scene,
                                        const Hit& hit, const LightSnapshot* light) const override;

private:
    LitVolume m_lit;
};

} // namespace limn
