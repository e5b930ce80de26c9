// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/lpv.h"

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/math/sh.h"
#include "engine/scene/light/unit_light.h"
#include "engine/techniques/lpv/blockers.h"
#include "engine/techniques/lpv/injected_lights.h"
#include "engine/techniques/lpv/lpv_overlay.h"
#include "engine/techniques/lpv/propagation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace limn {

namespace {

constexpr TechniqueSetting kResolution = {
    .setting = {.key = "lpv.resolution",
                .label = "Cells along the longest side",
                .tooltip =
                    "The scene's box is divided into cubic cells, this many along its longest "
                    "side. Time and memory grow with the cube",
                .invalidates = Invalidates::Light},
    .range = {4, 128},
    .usual = 32,
    .whole = true};
constexpr TechniqueSetting kRounds = {
    .setting = {.key = "lpv.rounds",
                .label = "Rounds of propagation",
                .tooltip = "In each round light moves on by one cell. With fewer rounds than half "
                           "the cells along a side, it does not reach the far end of a room",
                .invalidates = Invalidates::Light},
    .range = {1, 1024},
    .usual = 16,
    .whole = true};
constexpr TechniqueSetting kMapSize = {
    .setting = {.key = "lpv.map_size",
                .label = "Reflective shadow map (texels)",
                .tooltip = "Texels along a side of each view of a light: one for a sun or a narrow "
                           "spot, six for other spots and points, and for a rectangle 24 of half "
                           "the size. Rays are traced only where a light, an object or a material "
                           "changed",
                .invalidates = Invalidates::Light},
    .range = {16, 1024},
    .usual = 128,
    .whole = true};
constexpr TechniqueSetting kFluxLookup = {
    .setting = {.key = "lpv.flux_lookup",
                .label = "Irradiance from flux",
                .tooltip = "On: a surface receives the flux that arrives through its cell's face. "
                           "Off: the cell's light counts as a point light half a cell away, as in "
                           "the paper of 2010, which is brighter by a factor of 1.91",
                .invalidates = Invalidates::Light},
    .range = {0, 1},
    .usual = 1,
    .whole = true};
constexpr TechniqueSetting kEmitters = {
    .setting = {.key = "lpv.emitters",
                .label = "Emissive surfaces",
                .tooltip = "Emissive surfaces send light into the lattice, too, which the paper's "
                           "technique does not do. No surface reflects that light",
                .invalidates = Invalidates::Light},
    .range = {0, 1},
    .usual = 1,
    .whole = true};
constexpr std::array kSettings = {kResolution, kRounds, kMapSize, kFluxLookup, kEmitters};

/// The settings' values.
struct LpvSettings {
    std::uint32_t resolution = 0, rounds = 0, mapSize = 0;
    bool fluxLookup = false, emitters = false;
    bool operator==(const LpvSettings&) const = default;
};

LpvSettings settingsOf(const TechniqueChoice& choice) {
    return {.resolution = std::uint32_t(settingOf(choice, kResolution)),
            .rounds = std::uint32_t(settingOf(choice, kRounds)),
            .mapSize = std::uint32_t(settingOf(choice, kMapSize)),
            .fluxLookup = settingOf(choice, kFluxLookup) > 0,
            .emitters = settingOf(choice, kEmitters) > 0};
}

/// What shadow maps and blockers depend on, besides the lights.
struct Surfaces {
    struct Placed {
        std::uint32_t mesh, material;
        glm::mat4 toWorld;
        bool operator==(const Placed&) const = default;
    };
    std::shared_ptr<const Assets> assets;
    std::vector<Placed> instances;
    std::vector<Material> materials;
    Bounds bounds;
    std::uint32_t resolution, mapSize;
    bool operator==(const Surfaces&) const = default;
};

/// The material with everything reset that does not affect its diffuse reflection.
Material diffusePart(Material m) {
    const Material plain;
    m.name.clear();
    m.roughness = plain.roughness;
    m.emission = plain.emission;
    m.normalScale = plain.normalScale;
    m.normalTexture = plain.normalTexture;
    m.emissiveTexture = plain.emissiveTexture;
    m.emissiveFlipbook = plain.emissiveFlipbook;
    return m;
}

Surfaces surfacesOf(const Scene& scene, const LpvSettings& settings) {
    Surfaces s{scene.assets, {}, {}, scene.bounds, settings.resolution, settings.mapSize};
    for (const Instance& i : scene.instances)
        s.instances.push_back({i.mesh, i.material, i.toWorld});
    std::ranges::transform(scene.materials, std::back_inserter(s.materials), diffusePart);
    return s;
}

/// What emissive surfaces send, besides their place; empty where none is asked for.
struct Emission {
    glm::vec3 radiance;
    TextureRef texture;
    bool operator==(const Emission&) const = default;
};

std::vector<Emission> emissionOf(const Scene& scene, const LpvSettings& settings) {
    std::vector<Emission> emission;
    if (settings.emitters)
        for (const Material& m : scene.materials)
            emission.push_back({m.emission, m.emissiveTexture});
    return emission;
}

/// A light that shines.
struct Source {
    std::uint32_t index; ///< of Scene::lights
    Light shape;         ///< unitLight()
    glm::vec3 colour;    ///< colour times strength
    bool operator==(const Source&) const = default;
};

std::vector<Source> sourcesOf(const Scene& scene) {
    std::vector<Source> sources;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i)
        if (const Light& light = scene.lights[i]; shines(light))
            sources.push_back({i, unitLight(light), light.color * light.strength});
    return sources;
}

/// Irradiance of a surface with normal n is g max(0, I(-n)) / s^2. The coefficients of incident
/// radiance of which a field reads just that are (g / s^2) (-1)^l I_lm / A_l.
std::array<float, 2> fieldFactors(bool fluxLookup, float cell) {
    const float g = (fluxLookup ? 2 * std::numbers::pi_v<float> / 3 : 4.f) / (cell * cell);
    const auto factors = irradianceFactors();
    return {g / factors[0], -g / factors[1]};
}

class LpvLighting : public Lighting {
public:
    LpvLighting() { m_field.bands = 2; }

    LightingReport update(const LightingInput& input, const Progress& progress) override {
        Stopwatch whole;
        const LpvSettings settings = settingsOf(input.scene.technique);
        Inputs now{surfacesOf(input.scene, settings), settings, emissionOf(input.scene, settings),
                   sourcesOf(input.scene)};
        LightingReport report{.converged = true};
        report.skipped = m_inputs == now;
        Cost cost;
        if (!report.skipped) {
            m_inputs.reset(); // a cancelled update starts anew
            if (relight(input, now, progress, cost)) {
                m_inputs = std::move(now);
                report.bounces = 1;
            } else {
                report.converged = report.whole = false;
            }
        }
        describe(cost, report);
        report.totalMs = whole.lap();
        return report;
    }

    const IndirectField* field() const override { return &m_field; }

    std::shared_ptr<const LightSnapshot> snapshot() const override {
        if (!m_inputs)
            return nullptr;
        LitLattice lit{m_lattice, CellLight(m_lattice.size), {}, *m_blockers, {}, 0};
        addInjected(m_emitters, glm::vec3(1), m_lattice, {}, lit.injected);
        for (const Source& source : m_inputs->sources) {
            const InjectedLight& light = *injectionOf(source.shape);
            addInjected(light.parts, source.colour, m_lattice, {}, lit.injected);
            for (const ShownTexel& texel : light.texels)
                lit.texels.push_back({texel, texel.reflected * source.colour});
            lit.allTexels += light.allTexels;
        }
        const std::size_t count = m_lattice.cells();
        lit.sum.resize(count);
        for (std::size_t c = 0; c < count; ++c)
            for (std::size_t i = 0; i < lit.sum[c].size(); ++i)
                lit.sum[c][i] = glm::vec3(m_field.grid[i * count + c]) / m_factors[i > 0];
        return std::make_shared<const LpvSnapshot>(std::move(lit));
    }

    /// Each light's row is what that light gives alone. Cells whose lobes point away from each
    /// other lose less to the clamp together, so the sum of these may differ from the light of all.
    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override {
        Explanation e;
        if (!m_inputs)
            return e;
        IndirectField alone = m_field;
        const auto valueAlone = [&](const CellLight& cells) {
            writeField(propagate(cells, &*m_blockers, m_inputs->settings.rounds), alone);
            return valueOf(reading, alone);
        };
        CellLight together(m_lattice.size);
        addInjected(m_emitters, glm::vec3(1), m_lattice, {}, together);
        if (!m_emitters.empty())
            addRow(e.byOrigin, {.kind = LightRowKind::Others,
                                .label = "Emissive surfaces",
                                .value = valueAlone(together)});
        for (const Source& source : m_inputs->sources) {
            CellLight cells(m_lattice.size);
            for (CellLight* sum : {&cells, &together})
                addInjected(injectionOf(source.shape)->parts, source.colour, m_lattice,
                            options.black, *sum);
            addRow(e.byOrigin, {.kind = LightRowKind::Light,
                                .label = scene.lights[source.index].name,
                                .index = source.index,
                                .value = valueAlone(cells)});
        }
        const glm::vec3 all = valueAlone(together);
        if (e.byOrigin.size() > 1)
            addRow(e.byOrigin, {.kind = LightRowKind::Remainder,
                                .label = "Lights together, beyond each alone",
                                .value = all - totalOf(e.byOrigin)});
        if (options.black.empty())
            addRow(e.bySender, {.kind = LightRowKind::Others,
                                .label = "All surfaces (cells do not tell them apart)",
                                .value = all});
        e.bounces = 1;
        return e;
    }

private:
    /// Everything that the field depends on.
    struct Inputs {
        Surfaces surfaces;
        LpvSettings settings;
        std::vector<Emission> emission; ///< by material
        std::vector<Source> sources;
        bool operator==(const Inputs&) const = default;
    };
    struct Cost {
        double mapMs = 0, blockerMs = 0, propagationMs = 0, fieldMs = 0;
        std::uint64_t rays = 0, traced = 0, rounds = 0;
    };

    const InjectedLight* injectionOf(const Light& shape) const {
        const auto it = std::ranges::find(m_lights, shape, &InjectedLight::shape);
        return it == m_lights.end() ? nullptr : &*it;
    }

    /// False if cancelled.
    bool relight(const LightingInput& input, const Inputs& now, const Progress& progress,
                 Cost& cost) {
        Stopwatch clock;
        if (m_surfaces != now.surfaces) {
            m_surfaces = now.surfaces;
            m_lights.clear();
            m_emission.clear();
            m_emitters.clear();
            m_lattice = latticeOver(input.scene.bounds, now.settings.resolution);
            m_blockers = blockersOf(surfacePieces(input.scene, m_lattice.cell * 0.5f), m_lattice);
        }
        cost.blockerMs = clock.lap();
        std::erase_if(m_lights, [&](const InjectedLight& kept) {
            return std::ranges::none_of(input.scene.lights, [&](const Light& light) {
                return unitLight(light) == kept.shape;
            });
        });
        if (m_emission != now.emission) {
            m_emission = now.emission;
            m_emitters = m_emission.empty() ? std::vector<InjectedInstance>()
                                            : injectEmitters(input.scene, m_lattice);
        }
        CellLight cells(m_lattice.size);
        addInjected(m_emitters, glm::vec3(1), m_lattice, {}, cells);
        for (const Source& source : now.sources) {
            if (!injectionOf(source.shape)) {
                InjectedLight light = injectLight(*input.trace, input.scene, source.shape,
                                                  now.settings.mapSize, m_lattice, progress);
                if (progress.cancelled())
                    return false;
                cost.rays += light.rays;
                ++cost.traced;
                m_lights.push_back(std::move(light));
            }
            addInjected(injectionOf(source.shape)->parts, source.colour, m_lattice, {}, cells);
        }
        cost.mapMs = clock.lap();
        const bool dark = now.sources.empty() && m_emitters.empty();
        cost.rounds = dark ? 0 : now.settings.rounds;
        const CellLight sum = propagate(cells, &*m_blockers, std::uint32_t(cost.rounds), progress);
        if (progress.cancelled())
            return false;
        cost.propagationMs = clock.lap();
        m_field.gridSize = m_lattice.size;
        m_field.gridBounds = m_lattice.bounds();
        m_factors = fieldFactors(now.settings.fluxLookup, m_lattice.cell);
        writeField(sum, m_field);
        ++m_field.version;
        cost.fieldMs = clock.lap();
        return true;
    }

    void writeField(const CellLight& sum, IndirectField& field) const {
        const glm::uvec3 size = m_lattice.size;
        const std::size_t count = m_lattice.cells();
        field.grid.resize(4 * count);
        parallelRanges(std::size_t(size.y) * size.z, 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row)
                for (std::uint32_t x = 0; x < size.x; ++x) {
                    const Lobe lobe = sum.lobe({x, row % size.y, row / size.y});
                    for (std::size_t i = 0; i < lobe.size(); ++i)
                        field.grid[i * count + row * size.x + x] =
                            glm::vec4(lobe[i] * m_factors[i > 0], 0);
                }
        });
    }

    void describe(const Cost& cost, LightingReport& report) const {
        report.steps = {
            {"blockers", "Geometry volume", "Surfaces that block light, summed in cells",
             cost.blockerMs},
            {"shadow_maps", "Reflective shadow maps",
             "Rays from lights whose map is out of date; what they hit and what emits, summed in "
             "cells",
             cost.mapMs},
            {"propagation", "Propagation", "Light moves from cell to cell", cost.propagationMs},
            {"field", "Field", "What the viewport samples", cost.fieldMs}};
        const std::size_t planes = 4 * 12; // three volumes of light and the blockers
        const std::size_t bytes = PaddedCells{m_lattice.size}.count() * planes * sizeof(float) +
                                  m_field.grid.size() * sizeof(glm::vec4);
        report.counters = {
            {"cells", "Cells", "Cells of the lattice", double(m_lattice.cells())},
            {"rounds", "Rounds", "Rounds of propagation that ran", double(cost.rounds)},
            {"lights_traced", "Lights traced",
             "Lights whose shadow map was cast: they or an object moved", double(cost.traced)},
            {"shadow_rays", "Shadow map rays", "Rays cast for shadow maps", double(cost.rays)},
            {"bytes", "Memory", "Volumes of light and blockers, and the field", double(bytes),
             CounterUnit::Bytes}};
    }

    IndirectField m_field;
    std::array<float, 2> m_factors{};   ///< of the field's bands
    std::optional<Inputs> m_inputs;     ///< of the field; none before the first update
    std::optional<Surfaces> m_surfaces; ///< of what follows
    Lattice m_lattice;
    std::optional<FaceBlockers> m_blockers;
    std::vector<Emission> m_emission; ///< of m_emitters
    std::vector<InjectedInstance> m_emitters;
    std::vector<InjectedLight> m_lights; ///< each shape once
};

} // namespace

constinit const Technique kLpvTechnique = {
    .name = "lpv",
    .label = "Light propagation volumes",
    .summary = "One bounce of lights, carried from cell to cell of a lattice. Needs no bake. The "
               "sky gives no light, and that of emissive surfaces is not reflected",
    .source = "Kaplanyan, Dachsbacher. Cascaded Light Propagation Volumes for Real-Time Indirect "
              "Illumination. 2010",
    .settings = kSettings,
    .overlays = kLpvOverlays,
    .precomputation = nullptr,
    .light = [](const Prepared&) {
        return std::unique_ptr<Lighting>(std::make_unique<LpvLighting>());
    }};

} // namespace limn
