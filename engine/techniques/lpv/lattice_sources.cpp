// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/lattice_sources.h"

#include "engine/core/stopwatch.h"
#include "engine/math/sh.h"
#include "engine/scene/light/unit_light.h"
#include "engine/techniques/lpv/blockers.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace limn {

namespace {

std::vector<LpvEmission> emissionOf(const Scene& scene, const LpvSettings& settings) {
    std::vector<LpvEmission> emission;
    if (settings.emitters)
        for (const Material& m : scene.materials)
            emission.push_back({m.emission, m.emissiveTexture});
    return emission;
}

} // namespace

LpvInputs lpvInputsOf(const Scene& scene) {
    const LpvSettings settings = lpvSettingsOf(scene.technique);
    return {{rsmSurfacesOf(scene), settings.resolution, settings.mapSize},
            settings,
            emissionOf(scene, settings),
            rsmSourcesOf(scene)};
}

void LatticeSources::followSurfaces(const Scene& scene, const LpvInputs& now, LpvSourceCost& cost) {
    Stopwatch clock;
    if (m_surfaces != now.surfaces) {
        m_surfaces = now.surfaces;
        m_lights.clear();
        m_emission.clear();
        m_emitters.clear();
        m_lattice = latticeOver(scene.bounds, now.settings.resolution);
        m_blockers = blockersOf(surfacePieces(scene, m_lattice.cell * 0.5f), m_lattice);
        ++m_surfacesVersion;
        ++m_emittersVersion;
    }
    cost.blockerMs += clock.lap();
    if (m_emission != now.emission) {
        m_emission = now.emission;
        m_emitters =
            m_emission.empty() ? std::vector<InjectedInstance>() : injectEmitters(scene, m_lattice);
        ++m_emittersVersion;
    }
    cost.mapMs += clock.lap();
}

bool LatticeSources::followLights(const Scene& scene, const LpvInputs& now, const TraceOf& trace,
                                  const Progress& progress, LpvSourceCost& cost) {
    Stopwatch clock;
    std::erase_if(m_lights, [&](const InjectedLight& kept) {
        return std::ranges::none_of(
            scene.lights, [&](const Light& light) { return unitLight(light) == kept.shape; });
    });
    for (const RsmSource& source : now.sources) {
        if (injectionOf(source.shape))
            continue;
        InjectedLight light =
            injectLight(trace(), scene, source.shape, now.settings.mapSize, m_lattice, progress);
        if (progress.cancelled())
            return false;
        cost.rays += light.rays;
        ++cost.traced;
        m_lights.push_back(std::move(light));
    }
    cost.mapMs += clock.lap();
    return true;
}

const InjectedLight* LatticeSources::injectionOf(const Light& shape) const {
    const auto it = std::ranges::find(m_lights, shape, &InjectedLight::shape);
    return it == m_lights.end() ? nullptr : &*it;
}

CellLight LatticeSources::injected(std::span<const RsmSource> sources,
                                   std::span<const std::uint32_t> black) const {
    CellLight cells(m_lattice.size);
    addInjected(m_emitters, glm::vec3(1), m_lattice, {}, cells);
    for (const RsmSource& source : sources)
        addInjected(injectionOf(source.shape)->parts, source.colour, m_lattice, black, cells);
    return cells;
}

LitLattice LatticeSources::lit(std::span<const RsmSource> sources, std::uint32_t rounds) const {
    LitLattice lit{m_lattice, injected(sources), {}, *m_blockers, {}, 0, rounds};
    for (const RsmSource& source : sources) {
        const InjectedLight& light = *injectionOf(source.shape);
        for (const ShownTexel& texel : light.texels)
            lit.texels.push_back({texel, texel.reflected * source.colour});
        lit.allTexels += light.allTexels;
    }
    return lit;
}

std::array<float, 2> fieldFactors(bool fluxLookup, float cell) {
    const float g = (fluxLookup ? 2 * std::numbers::pi_v<float> / 3 : 4.f) / (cell * cell);
    const auto factors = irradianceFactors();
    return {g / factors[0], -g / factors[1]};
}

void describeSources(const LatticeSources& sources, const LpvSourceCost& cost, std::uint64_t rounds,
                     LightingReport& report) {
    report.steps = {
        {"blockers", "Geometry volume", "Surfaces that block light, summed in cells",
         cost.blockerMs},
        {"shadow_maps", "Reflective shadow maps",
         "Maps of lights that are out of date; what they see and what emits, summed in cells",
         cost.mapMs}};
    report.counters = {
        {"cells", "Cells", "Cells of the lattice", double(sources.lattice().cells())},
        {"rounds", "Rounds", "Rounds of propagation that ran", double(rounds)},
        {"lights_traced", "Lights traced",
         "Lights whose shadow map was cast: they or an object moved", double(cost.traced)}};
}

} // namespace limn
