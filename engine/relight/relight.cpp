// SPDX-License-Identifier: MIT
#include "engine/relight/relight.h"

#include "engine/core/parallel.h"
#include "engine/relight/bouncing.h"
#include "engine/relight/cache_light.h"
#include "engine/relight/dimming.h"
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

bool needsGrid(const Scene& scene, const LightmapLayout& layout) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (i >= layout.instances.size() || layout.instances[i].uv.empty())
            return true;
    return false;
}

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
    LinkEnds ends;                                   ///< the ones in use
    bool started = false;
    Convergence convergence;

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
    bool gridLit = false; ///< the field has a grid

    std::uint64_t blockers = 0; ///< hash of those that `dimmed` belongs to; 0: none
    BlockerShapes shapes;
    std::vector<SenderPlace> places; ///< empty until needed
    DimmedLinks dimmed;
    std::vector<std::uint32_t> dimmedEnds; ///< of its links
    std::vector<std::uint32_t> otherEnds;  ///< of the bake's; dimmed caches read none of these
    std::vector<glm::vec3> dimmedSh;       ///< as sh, per dimmed cache

    bool updateDimming(const Scene& scene);
    void chooseEnds();
    void lightRange(LightBands in, bool grid, std::vector<glm::vec3>& out);

    void setBands(int count);
    bool updateMaterials(const Scene& scene);
    bool updateSky(const Scene& scene);
    double lightSurfels();
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
    finalBands = limn::finalBands(bake->settings, bands);
    bounceBands = limn::bounceBands(bake->settings, bands);
    innerBands.luma = std::min(bands, kIrradianceBands);
    innerBands.chroma = std::min(bounceBands.chroma, innerBands.luma);
    const std::size_t n = std::size_t(bands * bands);
    sh.assign(bake->caches.size() * n, glm::vec3(0));
    field.bands = std::uint32_t(bands);
    field.lightmap.assign(std::size_t(field.lightmapWidth) * field.lightmapHeight * n,
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

bool Relighter::State::updateDimming(const Scene& scene) {
    const std::uint64_t now = dimsLinks(scene) ? hashBlockers(scene) : 0;
    if (now == blockers)
        return false;
    blockers = now;
    if (places.empty() && now != 0)
        places = senderPlaces(bake->surfels, bake->tree);
    dimmed =
        dimLinks(*bake, places, now != 0 ? sceneBlockers(scene, shapes) : std::vector<Blocker>());
    return true;
}

void Relighter::State::chooseEnds() {
    otherEnds.clear();
    if (dimmed.cache.empty())
        return;
    otherEnds = blackSky ? beforeSky : everyLink;
    for (const std::uint32_t c : dimmed.cache)
        otherEnds[c] = bake->caches.linkBegin[c];
    dimmedEnds = blackSky ? dimmed.beforeSky : allLinks(dimmed.links);
}

/// Lights the lightmap's caches, or the grid's, valid and invalid ones.
void Relighter::State::lightRange(LightBands in, bool grid, std::vector<glm::vec3>& out) {
    const Caches& caches = bake->caches;
    const std::uint32_t begin = grid ? caches.lightmapCount : 0,
                        end = grid ? std::uint32_t(caches.size()) : caches.lightmapCount;
    const auto coefficients = std::size_t(in.luma * in.luma);
    out.resize(std::max(out.size(), end * coefficients));
    lightCaches(caches, otherEnds.empty() ? ends : LinkEnds(otherEnds), radiosity, in, begin, end,
                out, halfs);
    const auto all = std::uint32_t(dimmed.cache.size());
    const std::uint32_t first = grid ? dimmed.lightmapCount : 0,
                        last = grid ? all : dimmed.lightmapCount;
    if (first < last) {
        dimmedSh.resize(std::max(dimmedSh.size(), last * coefficients));
        lightCaches(dimmed.links, dimmedEnds, radiosity, in, first, last, dimmedSh);
        for (std::size_t k = first; k < last; ++k)
            std::copy_n(dimmedSh.begin() + std::ptrdiff_t(k * coefficients), coefficients,
                        out.begin() + std::ptrdiff_t(dimmed.cache[k] * coefficients));
    }
    fillInvalidCaches(caches, in.luma, begin, end, out);
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
    const std::size_t written = gridLit ? caches.size() : caches.lightmapCount;
    field.gridSize = gridLit ? bake->gridSize : glm::uvec3(0);
    const std::size_t cells = std::size_t(field.gridSize.x) * field.gridSize.y * field.gridSize.z;
    field.grid.resize(cells * coefficients, glm::vec4(0));
    field.gridDepth =
        gridLit ? std::shared_ptr<const std::vector<std::uint16_t>>(bake, &bake->gridDepth)
                : nullptr;
    for (std::size_t c = 0; c < written; ++c) {
        const bool lightmap = c < caches.lightmapCount;
        std::vector<glm::vec4>& out = lightmap ? field.lightmap : field.grid;
        const std::size_t stride = lightmap ? texels : cells;
        for (std::size_t i = 0; i < coefficients; ++i)
            out[i * stride + caches.texel[c]] = glm::vec4(sh[c * coefficients + i], 0);
    }
    ++field.version;
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
    const bool dimmingChanged = s.updateDimming(scene);
    stats.cachesDimmed = std::uint32_t(s.dimmed.cache.size());
    stats.linksDimmed = s.dimmed.dimmed;
    stats.dimMs = dimmingChanged ? timer.lap() : 0;
    const Caches& caches = s.bake->caches;
    const bool grid = caches.size() > caches.lightmapCount && needsGrid(scene, s.bake->lightmap);
    stats.gridCachesSkipped = grid ? 0 : std::uint32_t(caches.size()) - caches.lightmapCount;
    const bool gridMissing = grid && !s.gridLit;
    s.gridLit = grid;
    if (materialsChanged || directChanged || gridMissing)
        s.convergence.lightChanged();
    if (skyChanged || dimmingChanged)
        s.convergence.skyChanged();
    s.started = true;
    if (s.convergence.reached()) {
        stats.converged = stats.skipped = true;
        stats.totalMs = total.lap();
        return stats;
    }
    s.ends = s.blackSky ? s.beforeSky : s.everyLink;
    s.chooseEnds();
    stats.skyLinksSkipped = s.blackSky ? s.skyLinks : 0;
    for (bool last = bounces == 0; !last;) {
        s.convergence.addRound(s.lightSurfels());
        ++stats.bounces;
        last = s.convergence.reached() || stats.bounces == bounces || progress.cancelled();
        stats.surfelLightMs += timer.lap();
        pullRadiosity(s.bake->tree, s.radiosity);
        stats.pullMs += timer.lap();
        // Only the last bounce is seen in more bands than surfels read.
        const bool whole = last || s.bands <= s.innerBands.luma;
        const LightBands in = whole ? s.bounceBands : s.innerBands;
        std::vector<glm::vec3>& sh = whole ? s.sh : s.innerSh;
        s.lightRange(in, false, sh);
        stats.cacheLightMs += timer.lap();
        readCaches(s.bake->surfels, sh, in.luma, s.indirect);
        stats.surfelReadMs += timer.lap();
    }
    if (s.finalBands.chroma < s.bounceBands.chroma)
        dropChroma(s.finalBands, 0, caches.lightmapCount, s.sh);
    if (grid)
        s.lightRange(s.finalBands, true, s.sh);
    stats.cacheLightMs += timer.lap();
    s.writeField();
    stats.fieldMs = timer.lap();
    stats.converged = s.convergence.reached();
    stats.totalMs = total.lap();
    return stats;
}

} // namespace limn
