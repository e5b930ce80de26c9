// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/lighting/light_snapshot.h"
#include "engine/techniques/photon_lattices/photon_light.h"

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace limn {

/// Overlays of photon lattices. Photons are picked.
inline constexpr std::array<OverlayKind, 6> kPhotonOverlays = {
    {{.name = "photons",
      .label = "Photons",
      .tooltip = "Stored photons, by what they did last: diffuse bounces, reflection by metal, "
                 "passage through glass, or none since they left an emissive surface or the sky",
      .showsLight = true},
     {.name = "photon-path",
      .label = "Photon: path",
      .tooltip = "The path of the picked photon as dots. Click a surface to pick the closest one",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .describesPick = true,
      .picked = "Photon",
      .pickedTooltip = "Number of the photon"},
     {.name = "photon-lobes",
      .label = "Photon cells: light",
      .tooltip = "Light of the lattices' cells by the direction that a surface faces, as lobes, "
                 "each in the colour of its light",
      .showsLight = true},
     {.name = "photon-counts",
      .label = "Photon cells: photons",
      .tooltip = "Number of photons in each cell of the three lattices",
      .showsLight = true},
     {.name = "photon-lattice",
      .label = "Photon lattice that lights",
      .tooltip = "Where photons are stored, the shares of light that the three lattices give: red "
                 "the coarse one, green the middle one, blue the fine one",
      .showsLight = true},
     {.name = "photon-areas",
      .label = "Photon cells: area",
      .tooltip = "Area of surface in cells with photons. Light of cells with slivers of surface is "
                 "divided by a larger area, so that it cannot flash",
      .showsLight = true}}};

/// Photons and lattices, copied.
struct LitPhotons {
    struct Source {
        std::shared_ptr<const InjectedPhotons> injected;
        glm::vec3 colour{1};
        std::uint32_t light = ~0U; ///< index into Scene::lights; ~0: none of them
    };
    std::vector<Source> sources;
    PhotonLattices lattices;
    IndirectField field; ///< of parts alone
};
LitPhotons litPhotons(const PhotonStore& store, const PhotonInputs& inputs,
                      const IndirectField& field);

class PhotonSnapshot : public LightSnapshot {
public:
    explicit PhotonSnapshot(LitPhotons lit);

    const Technique& technique() const override;
    OverlayData overlay(const OverlayRequest& request, const Scene& scene,
                        const LightSnapshot* light) const override;
    std::uint32_t pickCount() const override { return m_count; }
    std::optional<std::uint32_t> pickAt(const Scene& scene, const Hit& hit) const override;
    std::optional<std::uint32_t> nearestPick(const OverlaySource& other,
                                             std::uint32_t pick) const override;
    std::vector<OverlayLine> describePick(const Scene& scene, std::uint32_t pick) const override;

    /// A stored photon and its source.
    struct Stored {
        const Photon* photon;
        const LitPhotons::Source* source;
        std::uint8_t place; ///< choosePlaces()
    };
    /// Photon number `pick` < pickCount().
    Stored stored(std::uint32_t pick) const;
    const LitPhotons& lit() const { return m_lit; }

private:
    std::optional<std::uint32_t> closest(glm::vec3 p, glm::vec3 normal) const;

    LitPhotons m_lit;
    std::uint32_t m_count = 0; ///< photons of all sources
};

/// The overlays of cells: lobes, counts and areas.
OverlayData cellLobeOverlay(const LitPhotons& lit);
OverlayData cellCountOverlay(const LitPhotons& lit);
OverlayData cellAreaOverlay(const LitPhotons& lit);

} // namespace limn
