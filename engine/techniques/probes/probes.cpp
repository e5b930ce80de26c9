// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probes.h"

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/techniques/probes/marched_part.h"
#include "engine/techniques/probes/probe_inputs.h"
#include "engine/techniques/probes/probe_light.h"
#include "engine/techniques/probes/probe_overlay.h"
#include "engine/techniques/probes/probe_planes.h"
#include "engine/techniques/probes/probe_settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

class ProbeLighting : public Lighting {
public:
    LightingReport update(const LightingInput& input, const Progress& progress) override;
    const IndirectField* field() const override { return &m_field; }
    std::shared_ptr<const LightSnapshot> snapshot() const override;
    glm::vec3 reflectedFrom(std::uint32_t origin, const FieldReading& reading) const;
    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override;

private:
    /// Durations of an update's steps [ms].
    struct Times {
        double maps = 0, light = 0, field = 0, reflections = 0;
    };

    void followScene(const Scene& scene, bool reflections);
    void keepTexels(bool keep);
    bool isStale(std::uint32_t probe, std::uint32_t origin) const;
    bool isStale(std::uint32_t probe) const; ///< any of its origins
    std::uint32_t countStale() const;
    void refresh(const LightingInput& input, std::uint32_t maxProbes, const Progress& progress,
                 Times& times);
    bool bounceIsDue(const Scene& scene);
    void writeField();
    void writeReflections(const Scene& scene);
    LightingReport report(const Times& times, std::uint32_t bounces) const;

    ProbeInputs m_inputs; ///< that the editions stand for
    ProbeMaps m_maps;
    std::vector<float> m_solidAngles;
    ProbeLight m_light;
    /// Editions of the maps and the origins that are wanted, and those that each probe has.
    std::uint32_t m_mapEdition = 0;
    std::vector<std::uint32_t> m_editions, m_probeMaps, m_probeEditions;
    std::vector<std::uint32_t> m_probePlanes; ///< per probe: edition of the map of its planes
    std::vector<glm::vec3> m_colors;          ///< per light, in the field: colour times strength
    std::uint32_t m_next = 0;                 ///< probe to be looked at first
    std::uint64_t m_rays = 0;                 ///< of the last update
    std::uint32_t m_refreshed = 0;            ///< probes, in the last update
    std::uint32_t m_updates = 0;              ///< that refreshed any probe
    std::vector<std::uint32_t> m_refreshedBy; ///< per probe: the last such update; 0: none
    double m_before = 0;                      ///< sum of the mean radiance when a bounce began
    bool m_bouncing = false;                  ///< light bounces more than once
    bool m_smooth = false;                    ///< weights, GridMoments::smooth
    bool m_momentsChanged = false;            ///< since the field was written
    bool m_fieldStale = false;                ///< a sum of the same parts would be another
    bool m_lacksReflections = false;          ///< which the document asks for
    IndirectField m_field;
};

/// Factor of light that was computed for a colour and a strength of 1; 0 if the light is off.
glm::vec3 weightOf(const Light& light) {
    return shines(light) ? light.color * light.strength : glm::vec3(0);
}

/// Marks as stale what depends on whatever changed in the scene.
void ProbeLighting::followScene(const Scene& scene, bool reflections) {
    const ProbeSettings settings = probeSettingsOf(scene.technique);
    ProbeInputs now = inputsOf(scene, settings, m_inputs);
    if (!sameLattice(now, m_inputs)) {
        m_maps = emptyMaps(now.grid, now.side);
        m_solidAngles = m_maps.map.solidAngles();
        m_probeMaps.assign(now.grid.count(), 0);
        m_refreshedBy.assign(now.grid.count(), 0);
        m_probePlanes.assign(now.grid.count(), 0);
        m_field.grid.clear();
        m_field.parts.clear();
        m_fieldStale = true;
        m_light.parts.clear();
        m_next = 0;
    }
    if (m_light.parts.empty() || now.lights.size() != m_inputs.lights.size()) {
        m_light.lights = std::uint32_t(now.lights.size());
        m_light.parts.assign(std::size_t(now.grid.count()) * m_light.origins(), {});
        m_light.texels.assign(m_light.origins(), {});
        m_editions.assign(m_light.origins(), 1);
        m_probeEditions.assign(m_light.parts.size(), 0);
    }
    keepTexels(reflections && settings.reflections && now.glossy);
    m_lacksReflections = !reflections && settings.reflections && now.glossy;
    if (!sameSurfaces(now, m_inputs))
        ++m_mapEdition;
    for (std::uint32_t l = 0; l < std::min(now.lights.size(), m_inputs.lights.size()); ++l)
        if (now.lights[l] != m_inputs.lights[l])
            ++m_editions[l];
    if (now.materials != m_inputs.materials || now.materialOf != m_inputs.materialOf)
        for (std::uint32_t o = 0; o <= m_light.emitters(); ++o)
            ++m_editions[o];
    if (now.sky != m_inputs.sky)
        ++m_editions[m_light.sky()];
    if (std::exchange(m_bouncing, settings.bounces) && !settings.bounces)
        for (std::uint32_t p = 0; p < now.grid.count(); ++p) {
            m_light.part(p, m_light.bounced()) = {};
            m_light.texels[m_light.bounced()].clear();
            m_fieldStale = true;
        }
    m_fieldStale |= std::exchange(m_smooth, settings.smooth) != settings.smooth;
    std::vector<glm::vec3> colors;
    for (const Light& light : scene.lights)
        colors.push_back(weightOf(light));
    m_fieldStale |= colors != m_colors;
    m_colors = std::move(colors);
    m_inputs = std::move(now);
}

/// Begins to keep the radiance of texels, for which all light is recomputed, or ends it.
void ProbeLighting::keepTexels(bool keep) {
    if (std::exchange(m_light.keepsTexels, keep) == keep)
        return;
    if (keep) {
        std::ranges::fill(m_probeEditions, 0U);
        return;
    }
    for (std::vector<glm::vec3>& texels : m_light.texels)
        texels = {};
    m_field.parts.clear();
    m_fieldStale = true;
}

/// Whether an origin of a probe must be recomputed. Light that nothing sends is left for later.
bool ProbeLighting::isStale(std::uint32_t probe, std::uint32_t origin) const {
    const bool dark = origin < m_light.lights ? !m_inputs.shining[origin]
                                              : origin == m_light.bounced() && !m_bouncing;
    if (dark)
        return false;
    return m_probeMaps[probe] != m_mapEdition ||
           m_probeEditions[std::size_t(probe) * m_light.origins() + origin] != m_editions[origin];
}

bool ProbeLighting::isStale(std::uint32_t probe) const {
    for (std::uint32_t o = 0; o < m_light.origins(); ++o)
        if (isStale(probe, o))
            return true;
    return false;
}

std::uint32_t ProbeLighting::countStale() const {
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < m_maps.grid.count(); ++p)
        count += isStale(p) ? 1 : 0;
    return count;
}

/// Refreshes up to `maxProbes` stale probes in turn.
void ProbeLighting::refresh(const LightingInput& input, std::uint32_t maxProbes,
                            const Progress& progress, Times& times) {
    const std::uint32_t count = m_maps.grid.count();
    const ProbeScene in{input.scene, *input.trace, m_maps, m_solidAngles, m_field};
    Stopwatch watch;
    std::vector<std::uint32_t> origins; // that are stale
    std::uint32_t left = maxProbes;
    for (std::uint32_t k = 0; k < count && left > 0 && !progress.cancelled(); ++k) {
        const std::uint32_t p = m_next;
        m_next = (m_next + 1) % count;
        origins.clear();
        for (std::uint32_t o = 0; o < m_light.origins(); ++o)
            if (isStale(p, o))
                origins.push_back(o);
        if (origins.empty())
            continue;
        watch.lap();
        if (m_probeMaps[p] != m_mapEdition) {
            traceProbe(input.scene, *input.trace, p, m_maps);
            m_rays += m_maps.map.texels();
            m_probeMaps[p] = m_mapEdition;
            m_momentsChanged = true;
            // Origins that are left for later are of the map before.
            for (std::uint32_t o = 0; o < m_light.origins(); ++o)
                m_probeEditions[std::size_t(p) * m_light.origins() + o] = 0;
        }
        times.maps += watch.lap();
        m_rays += lightProbe(in, p, origins, m_light);
        for (const std::uint32_t o : origins)
            m_probeEditions[std::size_t(p) * m_light.origins() + o] = m_editions[o];
        times.light += watch.lap();
        m_updates += m_refreshed == 0 ? 1 : 0;
        m_refreshedBy[p] = m_updates;
        ++m_refreshed;
        --left;
        progress.at("probes", float(k + 1) / float(count));
    }
}

/// Whether the light changed since the last bounce by more than the document tolerates. If so, the
/// next bounce is marked as stale.
bool ProbeLighting::bounceIsDue(const Scene& scene) {
    if (!m_bouncing)
        return false;
    double sum = 0;
    for (std::uint32_t p = 0; p < m_maps.grid.count(); ++p)
        for (int c = 0; c < 3; ++c)
            sum += m_maps.inSolid[p] ? 0. : double(m_field.grid[p][c]);
    const bool due = std::abs(sum - m_before) > double(scene.relight.tolerance) / 100 * sum;
    m_before = sum;
    if (due)
        ++m_editions[m_light.bounced()];
    return due;
}

/// Sums the origins.
void ProbeLighting::writeField() {
    const std::uint32_t count = m_maps.grid.count();
    m_field.gridSize = m_maps.grid.size;
    m_field.gridBounds = m_maps.grid.bounds;
    m_field.grid.assign(std::size_t(count) * m_field.coefficients(), glm::vec4(0));
    for (std::uint32_t p = 0; p < count; ++p)
        for (std::size_t i = 0; i < m_field.coefficients(); ++i) {
            glm::vec3 sum(0);
            for (std::uint32_t o = 0; o < m_light.origins(); ++o)
                sum += m_light.part(p, o)[i] * (o < m_light.lights ? m_colors[o] : glm::vec3(1));
            m_field.grid[i * count + p] = glm::vec4(sum, 0);
        }
    if (m_momentsChanged || !m_field.gridMoments || m_field.gridMoments->smooth != m_smooth) {
        auto moments = std::make_shared<GridMoments>(m_maps.moments);
        moments->smooth = m_smooth;
        m_field.gridMoments = std::move(moments);
        m_momentsChanged = false;
    }
    m_fieldStale = false;
    ++m_field.version;
}

/// Sums the origins in the texels of the maps, and follows surfaces that moved.
void ProbeLighting::writeReflections(const Scene& scene) {
    const std::size_t texels = m_maps.map.texels();
    const MarchedMaps* before = marchedMapsOf(m_field.parts);
    auto maps = std::make_shared<MarchedMaps>(
        before ? *before : emptyMarchedMaps(m_maps.grid.size, m_maps.grid.bounds, m_maps.map.side));
    parallelRanges(m_maps.grid.count(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (m_probeMaps[p] == m_mapEdition && m_probePlanes[p] != m_mapEdition) {
                writePlanes(scene, m_maps, std::uint32_t(p), *maps);
                m_probePlanes[p] = m_mapEdition;
            }
            glm::vec3* sums = maps->radiance[0].data() + p * texels;
            std::fill_n(sums, texels, glm::vec3(0));
            for (std::uint32_t o = 0; o < m_light.origins(); ++o) {
                if (m_light.texels[o].empty())
                    continue;
                const glm::vec3 weight = o < m_light.lights ? m_colors[o] : glm::vec3(1);
                for (std::size_t t = 0; t < texels; ++t)
                    sums[t] += weight * m_light.texels[o][p * texels + t];
            }
            updateLevels(*maps, p);
        }
    });
    m_field.parts = {std::make_shared<const MarchedPart>(std::move(maps))};
}

LightingReport ProbeLighting::report(const Times& times, std::uint32_t bounces) const {
    const std::uint32_t stale = countStale();
    LightingReport report;
    report.steps = {{"probe_maps", "Maps", "Rays from probes that see moved surfaces", times.maps},
                    {"probe_light", "Light of maps",
                     "Shadow rays from what probes see, and projection onto harmonics",
                     times.light},
                    {"probe_field", "Field", "Sum of all lights at the probes", times.field}};
    if (m_light.keepsTexels)
        report.steps.push_back({"probe_reflections", "Reflections",
                                "Planes and radiance of the maps that reflections are marched "
                                "through",
                                times.reflections});
    const auto solid =
        std::accumulate(m_maps.inSolid.begin(), m_maps.inSolid.end(), std::uint32_t(0));
    const double bytes = double(m_maps.hits.size() * sizeof(ProbeHit) +
                                m_light.parts.size() * sizeof(ProbeHarmonics) +
                                m_maps.moments.texels.size() * sizeof(glm::vec2));
    report.counters = {
        {"probes", "Probes", "Probes of the lattice", double(m_maps.grid.count())},
        {"probes_in_solids", "Probes in solids", "Their light is not used", double(solid)},
        {"probes_refreshed", "Refreshed", "Probes that this update lit anew", double(m_refreshed)},
        {"probes_stale", "Stale", "Probes whose light is still of an earlier scene", double(stale)},
        {"rays", "Rays", "Traced by this update", double(m_rays)},
        {"probe_bytes", "Memory", "Maps, moments and light of the probes", bytes,
         CounterUnit::Bytes}};
    if (m_light.keepsTexels) {
        const MarchedMaps* maps = marchedMapsOf(m_field.parts);
        std::size_t reflections = maps ? maps->bytes() : 0;
        for (const std::vector<glm::vec3>& texels : m_light.texels)
            reflections += texels.size() * sizeof(glm::vec3);
        report.counters.push_back({"reflection_bytes", "Memory of reflections",
                                   "Radiance of the maps' texels, by light and in sum, and planes",
                                   double(reflections), CounterUnit::Bytes});
    }
    if (m_lacksReflections)
        report.lacks = kLacksReflections;
    report.totalMs = times.maps + times.light + times.field + times.reflections;
    report.bounces = bounces;
    report.whole = report.converged = stale == 0;
    return report;
}

LightingReport ProbeLighting::update(const LightingInput& input, const Progress& progress) {
    m_rays = m_refreshed = 0;
    followScene(input.scene, input.reflections);
    if (m_maps.grid.count() == 0) {
        LightingReport nothing;
        nothing.converged = nothing.skipped = true;
        return nothing;
    }
    // A view gets its light a few probes at a time; anything else wants all of it.
    const std::uint32_t maxProbes =
        input.view ? probeSettingsOf(input.scene.technique).perUpdate : ~0U;
    Times times;
    std::uint32_t bounces = 0;
    bool written = false;
    do {
        refresh(input, maxProbes, progress, times);
        if (m_refreshed == 0 && !m_fieldStale)
            break;
        Stopwatch watch;
        writeField();
        times.field += watch.lap();
        written = true;
        if (progress.cancelled() || countStale() > 0)
            break;
        ++bounces;
    } while (bounceIsDue(input.scene) && bounces < std::max(input.bounces, 1U) && !input.view);
    if (written && m_light.keepsTexels) {
        Stopwatch watch;
        writeReflections(input.scene);
        times.reflections = watch.lap();
    }
    LightingReport result = report(times, bounces);
    result.skipped = !written;
    return result;
}

std::shared_ptr<const LightSnapshot> ProbeLighting::snapshot() const {
    const std::uint32_t count = m_maps.grid.count();
    if (m_field.grid.empty())
        return nullptr;
    LitProbes lit{m_maps, std::vector<ProbeHarmonics>(count), std::vector<ProbeAge>(count)};
    for (std::uint32_t p = 0; p < count; ++p) {
        for (std::size_t i = 0; i < lit.light[p].size(); ++i)
            lit.light[p][i] = glm::vec3(m_field.grid[i * count + p]);
        lit.ages[p] = {.updates = m_updates - m_refreshedBy[p],
                       .stale = isStale(p),
                       .lit = m_refreshedBy[p] > 0};
    }
    return std::make_shared<const ProbeSnapshot>(std::move(lit));
}

/// The share of an origin in what a reading looks up in the maps, which are the field's only part.
glm::vec3 ProbeLighting::reflectedFrom(std::uint32_t origin, const FieldReading& reading) const {
    glm::vec3 sum(0);
    const MarchedMaps* all = marchedMapsOf(m_field.parts);
    if (!all || m_light.texels[origin].empty())
        return sum;
    std::map<std::uint32_t, MarchedMaps> probes; // of one probe each, of this origin's radiance
    const std::size_t texels = m_maps.map.texels();
    for (const FieldReading::PartNumber& number : reading.partNumbers) {
        const MarchedTexel texel = marchedTexel(*all, number.index);
        const auto [known, isNew] = probes.try_emplace(texel.probe);
        if (isNew) {
            known->second = emptyMarchedMaps(glm::uvec3(1), m_maps.grid.bounds, m_maps.map.side);
            std::copy_n(m_light.texels[origin].data() + texel.probe * texels, texels,
                        known->second.radiance[0].data());
            updateLevels(known->second, 0);
        }
        sum += number.weight * known->second.radiance[texel.level][texel.texel];
    }
    return sum;
}

Explanation ProbeLighting::explain(const Scene& scene, const FieldReading& reading,
                                   const ExplainOptions& options) const {
    if (!options.black.empty() || m_colors.size() != scene.lights.size())
        return {};
    const auto valueOf = [&](std::uint32_t origin) {
        glm::vec3 sum(0);
        for (const FieldReading::Entry& entry : reading.entries)
            for (std::size_t i = 0; i < m_field.coefficients(); ++i)
                sum += entry.weight[i] * m_light.part(entry.index, origin)[i];
        return sum + reflectedFrom(origin, reading);
    };
    Explanation result;
    LightRow sky{.kind = LightRowKind::Sky, .label = "Sky", .value = valueOf(m_light.sky())};
    LightRow surfaces{.label = "Surfaces"};
    const auto add = [&](LightRow row) {
        surfaces.value += row.value;
        if (row.value != glm::vec3(0))
            addRow(result.byOrigin, std::move(row));
    };
    for (std::uint32_t l = 0; l < m_light.lights; ++l)
        add({.kind = LightRowKind::Light,
             .label = scene.lights[l].name,
             .index = l,
             .value = valueOf(l) * m_colors[l]});
    add({.label = "Emissive surfaces", .value = valueOf(m_light.emitters())});
    add({.kind = LightRowKind::Remainder,
         .label = "More than one bounce",
         .value = valueOf(m_light.bounced())});
    addRow(result.byOrigin, sky);
    addRow(result.bySender, std::move(surfaces));
    addRow(result.bySender, std::move(sky));
    result.bounces = 1;
    return result;
}

} // namespace

constinit const Technique kProbesTechnique = {
    .name = "probes",
    .label = "Light field probes",
    .summary = "A lattice of probes keeps what it sees and is lit anew, a few probes at a time, "
               "when light changes. Needs no bake",
    .source = "McGuire, Mara, Nowrouzezahrai, Luebke. Real-Time Global Illumination using "
              "Precomputed Light Field Probes. 2017",
    .settings = kProbeSettings,
    .overlays = kProbeOverlays,
    .precomputation = nullptr,
    .light = [](const Prepared&) {
        return std::unique_ptr<Lighting>(std::make_unique<ProbeLighting>());
    }};

} // namespace limn
