// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_lighting.h"

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/field/grid_placement.h"
#include "engine/techniques/sparse_probes/relight_rays.h"
#include "engine/techniques/sparse_probes/sparse_overlay.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <glm/common.hpp>

namespace limn {

SparseLighting::SparseLighting(std::shared_ptr<const SparseBake> bake, const Scene& scene)
    : m_bake(std::move(bake)), m_points(pointsOf(scene, m_bake->receivers)),
      m_areas(areasOf(m_bake->receivers)), m_directions(relightDirections(m_bake->sparse.rays)),
      m_basis(relightBasis(m_directions, int(m_bake->sparse.bands))) {
    const std::size_t n = m_bake->receivers.size();
    m_irradiance.assign(n, glm::vec3(0));
    m_radiance.assign(n, glm::vec3(0));
    m_probes.assign(m_bake->probes.size() * 3 * m_bake->coefficients(), 0);
    m_field.lightmapWidth = m_bake->lightmap.width;
    m_field.lightmapHeight = m_bake->lightmap.height;
    m_field.gridBounds = m_bake->gridBounds;
}

/// Takes over what changed in the scene.
void SparseLighting::followScene(const LightingInput& input) {
    const Scene& scene = input.scene;
    const bool directChanged =
        updateDirectIrradiance(m_points.position, m_points.normal, scene, *input.trace, m_direct);
    const bool materialsChanged = updateReceiverMaterials(m_bake->receivers, scene, m_materials);
    const bool skyChanged = !m_started || m_sky != scene.sky;
    if (skyChanged) {
        m_sky = scene.sky;
        m_skyAtProbes = gatherSky(*m_bake, m_directions, m_basis, m_sky);
    }
    const bool clamp = clampsParts(scene.technique),
               clampChanged = std::exchange(m_clampParts, clamp) != clamp;
    m_started = true;
    if (noteChanges(skyChanged || clampChanged, directChanged || materialsChanged, scene.relight,
                    m_convergence))
        std::ranges::fill(m_irradiance, glm::vec3(0));
}

/// The radiance that receivers send, and how much it changed.
RoundChange SparseLighting::lightReceivers() {
    const std::size_t n = m_radiance.size();
    std::vector<float> change(n);
    parallelRanges(n, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            const glm::vec3 next = m_materials.albedo[r] / std::numbers::pi_v<float> *
                                       (m_direct.irradiance[r] + m_irradiance[r]) +
                                   m_materials.emission[r];
            const glm::vec3 d = glm::abs(next - m_radiance[r]);
            change[r] = d.x + d.y + d.z;
            m_radiance[r] = next;
        }
    });
    RoundChange round; // summed in order, whatever the number of threads
    for (std::size_t r = 0; r < n; ++r) {
        const glm::vec3 sent = m_radiance[r];
        const float sum = sent.x + sent.y + sent.z;
        const double flux =
            double(std::numbers::pi_v<float>) * double(m_areas.share[r]) * m_areas.total;
        round.change += flux * double(change[r]);
        round.total += flux * double(sum);
        round.relative += double(m_areas.share[r]) * double(relativeChange(change[r], sum));
    }
    return round;
}

/// Writes the irradiance as constant radiance, of which every normal reads the same irradiance.
void SparseLighting::writeField(bool grid) {
    m_field.bands = grid ? kIrradianceBands : 2;
    m_field.gridSize = grid ? m_bake->gridSize : glm::uvec3(0);
    if (grid)
        fillGrid(*m_bake, m_probes, m_field);
    else
        m_field.grid.clear();
    const std::size_t texels = std::size_t(m_field.lightmapWidth) * m_field.lightmapHeight;
    m_field.lightmap.resize(texels * m_field.coefficients()); // all but the first layer stay 0
    for (std::size_t r = 0; r < m_irradiance.size(); ++r)
        m_field.lightmap[m_bake->receivers.texel[r]] =
            glm::vec4(m_irradiance[r] * kRadiancePerIrradiance, 0);
    ++m_field.version;
}

std::shared_ptr<const LightSnapshot> SparseLighting::snapshot() const {
    return std::make_shared<const SparseSnapshot>(m_probes);
}

LightingReport SparseLighting::report(const Times& times, std::uint32_t bounces,
                                      bool skipped) const {
    LightingReport report;
    report.steps = {
        {"direct", "Direct light", "Shadow rays from texels to lights", times.direct},
        {"radiosity", "Radiosity", "What texels reflect and emit", times.radiosity},
        {"sparse_probes", "Probes", "Harmonics of what probes see", times.probes},
        {"receivers", "Receivers", "Irradiance of texels, from probes", times.receivers},
        {"field", "Field", "Lightmap and grid that the viewport samples", times.field}};
    const auto counter = [](const char* id, const char* label, const char* tooltip, double value) {
        return LightingCounter{id, label, tooltip, value};
    };
    const double floats =
        double(m_probes.size() + m_skyAtProbes.size()) +
        3 * double(m_irradiance.size() + m_radiance.size() + m_materials.albedo.size() +
                   m_materials.emission.size() + m_direct.irradiance.size()) +
        double(m_direct.lights.size() * m_irradiance.size());
    const double field = double(m_field.lightmap.size() + m_field.grid.size()) * sizeof(glm::vec4);
    report.counters = {
        counter("probes", "Probes", "In the open air", double(m_bake->probes.size())),
        counter("receivers", "Receivers", "Lightmap texels", double(m_irradiance.size())),
        counter("lights_traced", "Lights traced",
                "Lights whose shadows were traced, because they or an object moved",
                double(m_direct.lightsTraced)),
        counter("shadow_rays", "Shadow rays", "Traced by this update", double(m_direct.raysTraced)),
        counter("probe_updates", "Probe updates", "Probes lit by this update, in all its bounces",
                double(bounces) * double(m_bake->probes.size())),
        {"light_bytes", "Memory", "Light of texels and probes, and the field", 4 * floats + field,
         CounterUnit::Bytes}};
    report.totalMs = times.direct + times.radiosity + times.probes + times.receivers + times.field;
    report.bounces = bounces;
    report.converged = m_convergence.reached();
    report.diverges = m_convergence.grows();
    report.skipped = skipped;
    return report;
}

LightingReport SparseLighting::update(const LightingInput& input, const Progress& progress) {
    Times times;
    Stopwatch watch;
    followScene(input);
    times.direct = watch.lap();
    std::uint32_t bounces = 0;
    while (bounces < input.bounces && !m_convergence.reached() && !progress.cancelled()) {
        const RoundChange change = lightReceivers();
        times.radiosity += watch.lap();
        gatherProbes(*m_bake, m_basis, m_radiance, m_skyAtProbes, m_probes);
        times.probes += watch.lap();
        gatherReceivers(*m_bake, m_probes, m_clampParts ? NotNegative::Parts : NotNegative::Sum,
                        m_irradiance);
        times.receivers += watch.lap();
        m_convergence.addRound(change);
        ++bounces;
    }
    const bool grid = m_bake->gridSize != glm::uvec3(0) &&
                      (input.unread || needsGrid(input.scene, m_bake->lightmap));
    const bool gridMissing = grid && m_field.grid.empty();
    const bool skipped = bounces == 0 && !gridMissing && m_field.version > 0;
    if (!skipped)
        writeField(grid);
    times.field = watch.lap();
    return report(times, bounces, skipped);
}

} // namespace limn
