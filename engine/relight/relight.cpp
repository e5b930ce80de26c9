// SPDX-License-Identifier: MIT
#include "engine/relight/relight.h"

#include "engine/bake/cluster_tree.h"
#include "engine/core/parallel.h"
#include "engine/relight/cache_light.h"
#include "engine/relight/surfel_light.h"
#include "engine/relight/surfel_material.h"
#include "engine/relight/surfel_read.h"
#include "engine/scene/receiver_bands.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr double kConverged = 1e-4; // of the total radiosity, per bounce

class Timer {
public:
    /// Milliseconds since the last call, or since construction.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double ms = std::chrono::duration<double, std::milli>(now - m_last).count();
        m_last = now;
        return ms;
    }

private:
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

} // namespace

struct Relighter::State {
    std::shared_ptr<const Bake> bake;
    LitBands lit = LitBands::Needed;
    int bands = 0; ///< that the caches are lit in
    /// Of all bounces but the last one, which need irradiance only; of the last one; and of what
    /// is seen.
    LightBands innerBands, bounceBands, finalBands;
    std::vector<std::uint16_t> halfs; ///< of links in fewer bands than stored; empty: as stored
    std::vector<std::uint32_t> everyLink, beforeSky; ///< ends of each cache's links
    std::uint64_t skyLinks = 0;                      ///< between the two
    bool started = false, converged = false;

    std::vector<Material> materials; ///< that albedo and emitted belong to
    std::vector<glm::vec3> albedo;   ///< per surfel
    std::vector<glm::vec3> emitted;  ///< pi L_e per surfel [W m^-2]
    Sky sky;
    bool blackSky = true;
    SurfelLight direct;
    std::vector<glm::vec3> indirect;  ///< irradiance per surfel [W m^-2]
    std::vector<glm::vec4> radiosity; ///< per node
    std::vector<glm::vec3> sh;        ///< bands^2 per cache
    std::vector<glm::vec3> innerSh;   ///< of lightmap caches, in innerBands
    IndirectField field;

    void setBands(int count);
    bool updateMaterials(const Scene& scene);
    bool updateSky(const Scene& scene);
    double lightSurfels();
    void lightLightmapCaches(LinkEnds ends, LightBands in, std::vector<glm::vec3>& out);
    void writeField();
};

Relighter::Relighter(std::shared_ptr<const Bake> bake, LitBands lit)
    : m_state(std::make_unique<State>()) {
    State& s = *m_state;
    s.bake = std::move(bake);
    s.lit = lit;
    s.everyLink = allLinks(s.bake->caches);
    s.beforeSky = linksBeforeSky(s.bake->caches, s.bake->tree);
    for (std::size_t c = 0; c < s.everyLink.size(); ++c)
        s.skyLinks += s.everyLink[c] - s.beforeSky[c];
    s.indirect.assign(s.bake->surfels.size(), glm::vec3(0));
    s.radiosity.assign(s.bake->tree.size(), glm::vec4(0));
    s.field.lightmapWidth = s.bake->lightmap.width;
    s.field.lightmapHeight = s.bake->lightmap.height;
    s.field.gridSize = s.bake->gridSize;
    s.field.gridBounds = s.bake->gridBounds;
    const int most = int(s.bake->settings.bands);
    s.setBands(lit == LitBands::All ? most : std::min(most, kIrradianceBands));
}

Relighter::~Relighter() = default;
const IndirectField& Relighter::field() const {
    return m_state->field;
}
const Bake& Relighter::bake() const {
    return *m_state->bake;
}
const std::vector<glm::vec4>& Relighter::radiosity() const {
    return m_state->radiosity;
}
const std::vector<glm::vec3>& Relighter::cacheSh() const {
    return m_state->sh;
}

/// Makes room for them, black.
void Relighter::State::setBands(int count) {
    bands = count;
    const int chroma = int(chromaBandsOf(bake->settings));
    finalBands = {bands, std::min(chroma, bands)};
    // A surface gets half of its irradiance from the second band: without its colour every bounce
    // would grey the light.
    bounceBands = {bands, std::max(finalBands.chroma, 2)};
    innerBands.luma = std::min(bands, kIrradianceBands);
    innerBands.chroma = std::min(bounceBands.chroma, innerBands.luma);
    const std::size_t n = std::size_t(bands * bands);
    sh.assign(bake->caches.size() * n, glm::vec3(0));
    field.bands = std::uint32_t(bands);
    field.lightmap.assign(std::size_t(field.lightmapWidth) * field.lightmapHeight * n,
                          glm::vec4(0));
    field.grid.assign(std::size_t(field.gridSize.x) * field.gridSize.y * field.gridSize.z * n,
                      glm::vec4(0));
}

bool Relighter::State::updateMaterials(const Scene& scene) {
    if (started && materials == scene.materials)
        return false;
    const int needed = receiverBands(scene, int(bake->settings.bands));
    if (lit == LitBands::Needed && (!started || needed != bands)) {
        setBands(needed);
        halfs = bands < int(bake->settings.bands) ? firstHalfs(bake->caches, bands)
                                                  : std::vector<std::uint16_t>();
    }
    surfelMaterials(bake->surfels, scene, albedo, emitted, materials);
    materials = scene.materials;
    return true;
}

bool Relighter::State::updateSky(const Scene& scene) {
    if (started && sky == scene.sky)
        return false;
    sky = scene.sky;
    const ClusterTree& tree = bake->tree;
    const std::vector<glm::vec3> cells = skyRadiosity(tree, sky);
    for (std::size_t c = 0; c < cells.size(); ++c)
        radiosity[tree.surfels + c] = glm::vec4(cells[c], 0);
    blackSky = std::ranges::all_of(cells, [](glm::vec3 c) { return c == glm::vec3(0); });
    return true;
}

/// B = albedo (E_direct + E_indirect) + pi L_e. Returns the change of the total over the total.
double Relighter::State::lightSurfels() {
    const Surfels& s = bake->surfels;
    double change = 0, total = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const glm::vec3 b = albedo[i] * (direct.irradiance[i] + indirect[i]) + emitted[i];
        const glm::vec3 d = glm::abs(b - glm::vec3(radiosity[i]));
        change += double(d.x + d.y + d.z) * s.area[i];
        total += double(b.x + b.y + b.z) * s.area[i];
        radiosity[i] = glm::vec4(b, 0);
    }
    return total > 0 ? change / total : (change > 0 ? 1 : 0);
}

void Relighter::State::writeField() {
    const Caches& caches = bake->caches;
    const auto coefficients = std::size_t(bands * bands);
    const std::size_t texels = std::size_t(field.lightmapWidth) * field.lightmapHeight;
    const std::size_t cells = std::size_t(field.gridSize.x) * field.gridSize.y * field.gridSize.z;
    for (std::size_t c = 0; c < caches.size(); ++c) {
        const bool lightmap = c < caches.lightmapCount;
        std::vector<glm::vec4>& out = lightmap ? field.lightmap : field.grid;
        const std::size_t stride = lightmap ? texels : cells;
        for (std::size_t i = 0; i < coefficients; ++i)
            out[i * stride + caches.texel[c]] = glm::vec4(sh[c * coefficients + i], 0);
    }
    ++field.version;
}

/// Valid and invalid ones.
void Relighter::State::lightLightmapCaches(LinkEnds ends, LightBands in,
                                           std::vector<glm::vec3>& out) {
    const std::uint32_t count = bake->caches.lightmapCount;
    out.resize(std::max(out.size(), count * std::size_t(in.luma * in.luma)));
    lightCaches(bake->caches, ends, radiosity, in, 0, count, out, halfs);
    fillInvalidCaches(bake->caches, in.luma, 0, count, out);
}

RelightStats Relighter::relight(const Scene& scene, const TraceScene& trace, std::uint32_t bounces,
                                const Progress& progress) {
    State& s = *m_state;
    RelightStats stats;
    Timer total, timer;
    const bool materialsChanged = s.updateMaterials(scene);
    const bool skyChanged = s.updateSky(scene);
    const bool directChanged = updateSurfelLight(s.bake->surfels, scene, trace, s.direct);
    stats.lightsTraced = s.direct.lightsTraced;
    stats.shadowRays = s.direct.raysTraced;
    stats.lightsOff = std::uint32_t(scene.lights.size() - s.direct.lights.size());
    stats.bandsLit = std::uint32_t(s.bands);
    stats.bandsSkipped = s.bake->settings.bands - stats.bandsLit;
    stats.directMs = timer.lap();
    if (s.started && s.converged && !materialsChanged && !skyChanged && !directChanged) {
        stats.converged = stats.skipped = true;
        stats.totalMs = total.lap();
        return stats;
    }
    s.started = true;
    s.converged = false;
    const LinkEnds ends = s.blackSky ? s.beforeSky : s.everyLink;
    stats.skyLinksSkipped = s.blackSky ? s.skyLinks : 0;
    const Caches& caches = s.bake->caches;
    const auto all = std::uint32_t(caches.size());
    for (bool last = bounces == 0; !last;) {
        // A changed sky alone changes no surfel before the caches have seen it: it takes two rounds
        // to settle.
        s.converged = s.lightSurfels() < kConverged && !(skyChanged && stats.bounces < 2);
        ++stats.bounces;
        last = s.converged || stats.bounces == bounces || progress.cancelled();
        stats.surfelLightMs += timer.lap();
        pullRadiosity(s.bake->tree, s.radiosity);
        stats.pullMs += timer.lap();
        // Only the last bounce is seen in more bands than surfels read.
        const bool whole = last || s.bands <= s.innerBands.luma;
        const LightBands in = whole ? s.bounceBands : s.innerBands;
        std::vector<glm::vec3>& sh = whole ? s.sh : s.innerSh;
        s.lightLightmapCaches(ends, in, sh);
        stats.cacheLightMs += timer.lap();
        readCaches(s.bake->surfels, sh, in.luma, s.indirect);
        stats.surfelReadMs += timer.lap();
    }
    if (s.finalBands.chroma < s.bounceBands.chroma)
        dropChroma(s.finalBands, 0, caches.lightmapCount, s.sh);
    lightCaches(caches, ends, s.radiosity, s.finalBands, caches.lightmapCount, all, s.sh, s.halfs);
    fillInvalidCaches(caches, s.bands, caches.lightmapCount, all, s.sh);
    stats.cacheLightMs += timer.lap();
    s.writeField();
    stats.fieldMs = timer.lap();
    stats.converged = s.converged;
    stats.totalMs = total.lap();
    return stats;
}

} // namespace limn
