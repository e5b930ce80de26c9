// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/lattice.h"
#include "engine/lighting/lighting_report.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/lpv/injected_lights.h"
#include "engine/techniques/lpv/lpv_overlay.h"
#include "engine/techniques/lpv/lpv_settings.h"
#include "engine/techniques/lpv/propagation.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace limn {

/// What shadow maps and blockers depend on, besides the lights.
struct LpvSurfaces {
    RsmSurfaces surfaces;
    std::uint32_t resolution, mapSize;
    bool operator==(const LpvSurfaces&) const = default;
};

/// What the emissive surfaces of a material send, besides their place.
struct LpvEmission {
    glm::vec3 radiance;
    TextureRef texture;
    bool operator==(const LpvEmission&) const = default;
};

/// Everything that the light of a scene depends on.
struct LpvInputs {
    LpvSurfaces surfaces;
    LpvSettings settings;
    std::vector<LpvEmission> emission; ///< by material; empty where emitters are not asked for
    std::vector<RsmSource> sources;
    bool operator==(const LpvInputs&) const = default;
};

LpvInputs lpvInputsOf(const Scene& scene);

/// What following the inputs took.
struct LpvSourceCost {
    double blockerMs = 0, mapMs = 0;    ///< mapMs covers emitters, too
    std::uint64_t rays = 0, traced = 0; ///< of shadow maps; lights whose map was cast
};

/// What a scene sends into its lattice and what it blocks there, on the CPU, kept from one update
/// to the next.
class LatticeSources {
public:
    /// Returns the trace scene of the scene that is lit. It is called only where rays are needed.
    using TraceOf = std::function<const TraceScene&()>;

    /// Brings lattice, blockers and emitters up to date with `now`, the inputs of `scene`. Forgets
    /// the lights where surfaces changed.
    void followSurfaces(const Scene& scene, const LpvInputs& now, LpvSourceCost& cost);

    /// Casts the maps of lights that have none; call after followSurfaces(). Returns false if
    /// cancelled; what was finished by then is kept.
    bool followLights(const Scene& scene, const LpvInputs& now, const TraceOf& trace,
                      const Progress& progress, LpvSourceCost& cost);

    /// The kept light with that shape; null if there is none.
    const InjectedLight* injectionOf(const Light& shape) const;

    /// Sum of the emitters and of `sources`, without what the instances in `black` reflect.
    CellLight injected(std::span<const RsmSource> sources,
                       std::span<const std::uint32_t> black = {}) const;

    /// What overlays show, with an empty LitLattice::sum.
    LitLattice lit(std::span<const RsmSource> sources, std::uint32_t rounds) const;

    const Lattice& lattice() const { return m_lattice; }
    /// Call after followSurfaces().
    const FaceBlockers& blockers() const { return *m_blockers; }
    const std::vector<InjectedInstance>& emitters() const { return m_emitters; }

    // Increase whenever that was made anew; 0: not yet.
    std::uint64_t surfacesVersion() const { return m_surfacesVersion; } ///< lattice and blockers
    std::uint64_t emittersVersion() const { return m_emittersVersion; }

private:
    Lattice m_lattice;
    std::optional<FaceBlockers> m_blockers;
    std::optional<LpvSurfaces> m_surfaces; ///< of everything here
    std::vector<LpvEmission> m_emission;   ///< of m_emitters
    std::vector<InjectedInstance> m_emitters;
    std::vector<InjectedLight> m_lights; ///< each shape once
    std::uint64_t m_surfacesVersion = 0, m_emittersVersion = 0;
};

/// Irradiance of a surface with normal n is g max(0, I(-n)) / s^2. The factors, for each of two
/// bands, make of the harmonics of I those of an incident radiance of which a field reads just
/// that: (g / s^2) (-1)^l I_lm / A_l.
std::array<float, 2> fieldFactors(bool fluxLookup, float cell);

/// Sets what both the CPU and a device report: the steps "blockers" and "shadow_maps", and the
/// counters of cells, rounds and lights.
void describeSources(const LatticeSources& sources, const LpvSourceCost& cost, std::uint64_t rounds,
                     LightingReport& report);

} // namespace limn
