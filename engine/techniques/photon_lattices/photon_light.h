// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/photon_lattices/photon.h"
#include "engine/techniques/photon_lattices/photon_injection.h"
#include "engine/techniques/photon_lattices/photon_settings.h"
#include "engine/techniques/photon_lattices/surface_area.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace limn {

/// What photons come from.
enum class PhotonOrigin : std::uint8_t { Light, Emitters, Sky };

/// A source of photons, apart from its colour and strength, on which no path depends.
struct PhotonSource {
    PhotonOrigin origin = PhotonOrigin::Light;
    Light shape;                ///< unitLight(), of Light
    std::uint32_t material = 0; ///< index into Scene::materials, of Emitters
    TextureRef emission;        ///< its emissive texture
    Sky sky;                    ///< of Sky
    bool operator==(const PhotonSource&) const = default;
};

/// A source as it shines in a scene.
struct ShiningSource {
    PhotonSource source;
    glm::vec3 colour{1};     ///< times strength
    std::uint32_t index = 0; ///< of Scene::lights, of Light
    bool operator==(const ShiningSource&) const = default;
};

/// Everything that the light of a scene depends on.
struct PhotonInputs {
    RsmSurfaces surfaces; ///< with the roughness of metals and of what transmits light
    PhotonSettings settings;
    std::vector<ShiningSource> sources;
    bool operator==(const PhotonInputs&) const = default;
};
PhotonInputs photonInputsOf(const Scene& scene);

/// The photons of a source and their sums in cells. Immutable.
struct InjectedPhotons {
    PhotonSource source;
    std::shared_ptr<const PhotonMap> map;
    std::vector<std::uint8_t> places; ///< choosePlaces()
    PhotonSums sums;

    std::uint64_t bytes() const;
};

/// Traces the photons of a source.
using TracePhotons = std::function<PhotonMap(const PhotonSource& source, const Progress& progress)>;

/// What following the inputs took.
struct PhotonCost {
    double areaMs = 0, traceMs = 0, injectionMs = 0;
    std::uint64_t rays = 0, traced = 0; ///< sources whose photons were traced
    std::uint32_t clipped = 0;          ///< instances whose area was clipped to cells
};

/// The photons of a scene and its areas, kept from one update to the next.
class PhotonStore {
public:
    /// Brings everything up to date with `now`, the inputs of `scene`, with settings.paths as they
    /// are there. Photons are traced anew where paths changed, summed anew where cells did. Returns
    /// false if cancelled; what was finished by then is kept.
    bool follow(const Scene& scene, const PhotonInputs& now, const TracePhotons& trace,
                const Progress& progress, PhotonCost& cost);

    /// Null if there is none.
    std::shared_ptr<const InjectedPhotons> of(const PhotonSource& source) const;

    const PhotonLattices& lattices() const { return m_lattices; }
    const PhotonAreas& areas() const { return m_areas; }
    std::uint64_t bytes() const; ///< of photons, their sums and the areas

private:
    PhotonLattices m_lattices;
    PhotonAreas m_areas;
    RsmSurfaces m_surfaces;    ///< of the photons
    PathSettings m_paths;      ///< the same
    InjectionSettings m_cells; ///< of their sums
    std::vector<std::shared_ptr<const InjectedPhotons>> m_sources;
};

/// The parts of a field that light of these sources makes: one for each lattice, and one of splats
/// where settings ask for them.
std::vector<std::shared_ptr<const FieldPart>> photonParts(const PhotonStore& store,
                                                          const PhotonInputs& inputs);

} // namespace limn
