// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/light_skin/skin_state.h"

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace limn {

/// Overlays of LightSkin. Caches are picked.
inline constexpr std::array<OverlayKind, 5> kSkinOverlays = {
    {{.name = "skin-caches",
      .label = "LightSkin caches",
      .tooltip = "Light caches as discs of the area that each stands for, in the colour of the "
                 "irradiance that it receives. Click a surface to pick one of them",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .pickedTooltip = "Number of the cache that is described; -1: none picked"},
     {.name = "skin-importance",
      .label = "LightSkin importance",
      .tooltip = "Texels of the lights' reflective shadow maps on the surfaces that they stand "
                 "for, by their importance for the view. Rings: those that were chosen, larger "
                 "where one stands for more",
      .showsLight = true},
     {.name = "skin-proxies",
      .label = "LightSkin proxy lights",
      .tooltip = "The diffuse proxy lights of all caches, or both of the picked cache with the "
                 "spread of what they stand for, and the caches that shade them",
      .showsLight = true,
      .pick = OverlayPick::Optional,
      .describesPick = true,
      .pickedTooltip = "Number of the cache whose proxy lights are shown; -1: none picked"},
     {.name = "skin-weights",
      .label = "LightSkin weights",
      .tooltip = "The caches that light the surface at the picked cache, by their weight",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .describesPick = true,
      .pickedTooltip = "Number of the cache at whose place weights are shown; -1: none picked"},
     {.name = "skin-samples",
      .label = "LightSkin view samples",
      .tooltip = "The places for which texels of reflective shadow maps are to matter",
      .showsLight = true}}};

/// A virtual light as overlays show it.
struct ShownVirtualLight {
    glm::vec3 position{0}, normal{0};
    float area = 0;       ///< [m^2]
    float importance = 0; ///< per area and mean
    float weight = 0;     ///< 0: it was not chosen
};

/// The light on objects, copied.
struct LitSkin {
    std::shared_ptr<const LightCaches> caches;
    std::vector<CacheProxies> proxies;
    std::vector<glm::vec3> irradiance; ///< of each cache, before shade [W m^-2]
    std::vector<glm::vec3> flux;       ///< of the diffuse proxies, then of the glossy ones
    std::vector<float> exponents;      ///< of the caches' lobes; empty: nothing is glossy
    std::vector<ShownVirtualLight> lights;
    std::uint64_t allLights = 0, chosen = 0;
    ViewSamples samples;
    bool shade = false;
};
LitSkin litSkinOf(const SkinState& state, const SkinInputs& inputs);

class SkinSnapshot : public LightSnapshot {
public:
    explicit SkinSnapshot(LitSkin lit) : m_lit(std::move(lit)) {}

    const Technique& technique() const override;
    OverlayData overlay(const OverlayRequest& request, const Scene& scene,
                        const LightSnapshot* light) const override;
    std::uint32_t pickCount() const override { return std::uint32_t(m_lit.caches->size()); }
    std::optional<std::uint32_t> pickAt(const Scene& scene, const Hit& hit) const override;
    std::optional<std::uint32_t> nearestPick(const OverlaySource& other,
                                             std::uint32_t pick) const override;
    std::vector<OverlayLine> describePick(const Scene& scene, std::uint32_t pick) const override;
    /// Of "skin-weights": the caches that light the surface there.
    std::vector<OverlayLine> describeAt(const OverlayRequest& request, const Scene& scene,
                                        const Hit& hit, const LightSnapshot* light) const override;

private:
    LitSkin m_lit;
};

} // namespace limn
