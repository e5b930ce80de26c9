// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/relight.h"

#include "engine/core/flush_denormals.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/field/grid_placement.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/techniques/illuminance/relight/bounce_extrapolation.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"
#include "engine/techniques/illuminance/relight/light_basis.h"
#include "engine/techniques/illuminance/relight/occlusion/link_occlusion.h"
#include "engine/techniques/illuminance/relight/surfel_light.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"
#include "engine/techniques/illuminance/relight/surfel_read.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

struct Relighter::State {
    std::shared_ptr<const Bake> bake;
    LitBands lit = LitBands::Needed;
    int bands = 0; ///< number in which the caches are lit
    /// Bands of all bounces but the last, which need irradiance only; of the last one; and of what
    /// is seen.
    LightBands innerBands, bounceBands, finalBands;
    std::vector<std::uint16_t> halfs; ///< of links, in fewer bands than stored; empty: as stored
    std::vector<std::uint32_t> everyLink, beforeSky; ///< ends of each cache's links
    LinkEnds ends;                                   ///< the ones in use
    LinkCounts links;                                ///< of this call
    bool started = false;
    Convergence convergence;
    BounceExtrapolation ahead; ///< while nothing changes

    std::vector<Material> materials; ///< materials of `albedo` and `emitted`
    std::vector<float> seenShare;    ///< per surfel
    std::vector<glm::vec3> albedo;   ///< per surfel
    std::vector<glm::vec3> emitted;  ///< pi L_e per surfel [W m^-2]; empty: nothing emits
    Sky sky;
    bool blackSky = true;
    DirectIrradiance direct;
    std::vector<glm::vec3> indirect;  ///< irradiance per surfel [W m^-2]
    std::vector<glm::vec4> radiosity; ///< per node, as withLuma
    std::vector<glm::vec3> sh;        ///< bands^2 per cache
    std::vector<glm::vec3> innerSh;   ///< of lightmap caches, in innerBands; see inner()
    IndirectField field;
    bool unreadGrid = false;  ///< it is lit in any case
    bool gridLit = false;     ///< the field has a grid
    bool gridMissing = false; ///< and has had it since this call

    CacheRuns gridRuns;       ///< the grid's caches
    CacheFlags read;          ///< by surfels
    CacheRuns readRuns;       ///< the same
    CacheFlags current;       ///< caches for which the field holds the light of the last pull
    CacheFlags missing, rest; ///< working space
    CacheRuns someRuns;       ///< the same
    std::vector<RoundChange> blockChange; ///< the same
    bool unread = false; ///< surfels have not read that light yet; inner() has it for `current`

    LinkOcclusion occlusion;
    OccludedLinks occluded; ///< by it

    LightBasis basis;
    std::vector<WeightedSource> sources; ///< of the light in `sh`; kept while the basis holds any
    bool summed = false; ///< `sh` is a sum of the basis, which surfels have not read yet

    bool colorsApart() const;
    bool sumSources(const Scene& scene, RelightStats& stats);
    void readSum();

    void light(LightBands in, const CacheRuns& runs, std::vector<glm::vec3>& out);
    std::vector<glm::vec3>& inner();
    void keepInner(const CacheFlags& which);
    void lightRest();
    void readInner();
    void readBounce();
    void lightSeen(const CacheFlags& which, bool newLight);

    std::uint32_t gridCaches() const {
        return std::uint32_t(bake->caches.size()) - bake->caches.lightmapCount;
    }
    bool wantsGrid(const Scene& scene) const {
        return gridCaches() > 0 && (unreadGrid || needsGrid(scene, bake->lightmap));
    }
    void setBands(int count);
    bool takeScene(const Scene& scene, const TraceScene& trace, RelightStats& stats);
    bool updateMaterials(const Scene& scene);
    bool updateSky(const Scene& scene);
    RoundChange lightSurfels();
    void beginBounce();
    void writeField(const CacheFlags& which, bool grid);
    std::uint64_t bytes() const;
};

Relighter::Relighter(std::shared_ptr<const Bake> bake, LitBands lit)
    : m_state(std::make_unique<State>()) {
    State& s = *m_state;
    s.bake = std::move(bake);
    s.lit = lit;
    s.seenShare = seenShares(s.bake->tree);
    s.everyLink = allLinks(s.bake->caches);
    s.beforeSky = linksBeforeSky(s.bake->caches, s.bake->tree);
    s.read = cachesRead(s.bake->surfels, s.bake->caches);
    setRuns(s.read, s.readRuns);
    s.gridRuns = runsOf(s.bake->caches.lightmapCount, std::uint32_t(s.bake->caches.size()));
    s.indirect.assign(s.bake->surfels.size(), glm::vec3(0));
    s.radiosity.assign(s.bake->tree.size(), glm::vec4(0));
    s.field.lightmapWidth = s.bake->lightmap.width;
    s.field.lightmapHeight = s.bake->lightmap.height;
    s.field.continues = true;
    s.field.gridBounds = s.bake->gridBounds;
    const int maxBands = int(s.bake->settings.bands);
    s.setBands(lit == LitBands::All ? maxBands : std::min(maxBands, kIrradianceBands));
}

Relighter::~Relighter() = default;
void Relighter::lightUnreadGrid(bool light) {
    m_state->unreadGrid = light;
}
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
RelightState Relighter::state() const {
    const State& s = *m_state;
    const LinkHalfs halfs = s.halfs.empty() ? s.bake->caches.shCoefficients : s.halfs;
    return {.bake = *s.bake,
            .links = s.occluded.cones.links.empty() ? s.bake->caches : s.occluded.cones,
            .halfs = s.occluded.halfs.empty() ? halfs : LinkHalfs(s.occluded.halfs),
            .ends = s.ends,
            .bands = s.bands,
            .inner = s.innerBands,
            .chroma = s.finalBands.chroma,
            .maxBounces = s.convergence.settings().maxBounces,
            .radiosity = s.radiosity,
            .albedo = s.albedo,
            .emitted = s.emitted,
            .indirect = s.indirect,
            .direct = s.direct};
}

/// Allocates the caches' SH in `count` bands, black.
void Relighter::State::setBands(int count) {
    bands = count;
    finalBands = limn::finalBands(bake->settings, bands);
    bounceBands = limn::bounceBands(bake->settings, bands);
    innerBands.luma = std::min(bands, kIrradianceBands);
    innerBands.chroma = std::min(bounceBands.chroma, innerBands.luma);
    const std::size_t n = std::size_t(bands * bands);
    sh.assign(bake->caches.size() * n, glm::vec3(0));
    innerSh.clear();
    current.assign(bake->caches.lightmapCount, 0);
    unread = false;
    occluded = {}; // its links have the old number of bands
    occlusion.hidden = {};
    occlusion.blockers = 0;
    field.bands = std::uint32_t(bands);
    field.chromaBands = std::uint32_t(finalBands.chroma);
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
    if (std::ranges::all_of(emitted, [](glm::vec3 e) { return e == glm::vec3(0); }))
        emitted = std::vector<glm::vec3>(); // frees the memory
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
        radiosity[tree.surfels + c] = withLuma(cells[c]);
    blackSky = std::ranges::all_of(cells, [](glm::vec3 c) { return c == glm::vec3(0); });
    return true;
}

/// Lights both valid and invalid caches.
void Relighter::State::light(LightBands in, const CacheRuns& runs, std::vector<glm::vec3>& out) {
    const Caches& caches = bake->caches;
    const auto coefficients = std::size_t(in.luma * in.luma);
    if (runs.empty())
        return;
    out.resize(std::max(out.size(), runs.back().end * coefficients));
    const LinkCounts counts =
        lightCaches(occluded.cones.links.empty() ? caches : occluded.cones, ends, radiosity, in,
                    runs, out, occluded.halfs.empty() ? halfs : occluded.halfs);
    links.links += counts.links;
    links.skipped += counts.skipped;
    continueCaches(caches, in.luma, runs, out);
    fillInvalidCaches(caches, in.luma, runs, out);
}

/// The SH that surfels read, in innerBands: `sh` itself, unless that has more bands or is to lose
/// colour.
std::vector<glm::vec3>& Relighter::State::inner() {
    const bool same = bands == innerBands.luma && finalBands.chroma >= bounceBands.chroma;
    return same ? sh : innerSh;
}

/// Copies `sh` of the caches in `which` to inner().
void Relighter::State::keepInner(const CacheFlags& which) {
    std::vector<glm::vec3>& out = inner();
    if (&out == &sh)
        return;
    const auto from = std::size_t(bands * bands),
               to = std::size_t(innerBands.luma * innerBands.luma);
    out.resize(which.size() * to);
    parallelRanges(which.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            if (which[c] != 0)
                std::copy_n(sh.begin() + std::ptrdiff_t(c * from), to,
                            out.begin() + std::ptrdiff_t(c * to));
    });
}

/// Lights the caches that surfels read and that do not have the light of the last pull yet.
void Relighter::State::lightRest() {
    rest = read;
    removeFrom(rest, current);
    setRuns(rest, someRuns);
    light(innerBands, someRuns, inner());
    unread = false;
}

void Relighter::State::readInner() {
    readCaches(bake->surfels, inner(), innerBands.luma, indirect);
}

/// Lets surfels read the bounce that began last.
void Relighter::State::readBounce() {
    readInner();
    ahead.end({albedo, radiosity, bake->surfels.area, seenShare}, indirect);
}

/// Lights the caches in `which` for the field, in all bands. `newLight`: surfels have not read the
/// light of the last pull.
void Relighter::State::lightSeen(const CacheFlags& which, bool newLight) {
    setRuns(which, someRuns);
    light(bounceBands, someRuns, sh);
    for (std::size_t c = 0; c < which.size(); ++c)
        current[c] |= which[c];
    unread |= newLight;
    if (unread)
        keepInner(which);
    if (finalBands.chroma < bounceBands.chroma)
        dropChroma(finalBands, someRuns, sh);
}

/// B = albedo (E_direct + E_indirect) + pi L_e.
RoundChange Relighter::State::lightSurfels() {
    constexpr std::size_t kBlock = 1024; // sums are the same for any number of threads
    const Surfels& s = bake->surfels;
    const auto lightBlock = [&](std::size_t begin, std::size_t end) {
        RoundChange sum;
        for (std::size_t i = begin; i < end; ++i) {
            glm::vec3 b = albedo[i] * (direct.irradiance[i] + indirect[i]);
            if (!emitted.empty())
                b += emitted[i];
            const glm::vec3 d = glm::abs(b - glm::vec3(radiosity[i]));
            sum.change += double(d.x + d.y + d.z) * s.area[i];
            sum.total += double(b.x + b.y + b.z) * s.area[i];
            sum.relative += double(relativeChange(d.x + d.y + d.z, b.x + b.y + b.z) * seenShare[i]);
            radiosity[i] = withLuma(b);
        }
        return sum;
    };
    blockChange.resize((s.size() + kBlock - 1) / kBlock);
    parallelRanges(blockChange.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            blockChange[k] = lightBlock(k * kBlock, std::min((k + 1) * kBlock, s.size()));
    });
    RoundChange round;
    for (const RoundChange& block : blockChange)
        round += block;
    return round;
}

/// Lights the surfels for another bounce. Most scenes rest, and light moves on, before bounces are
/// extrapolated.
void Relighter::State::beginBounce() {
    ahead.addRound(lightSurfels(), convergence);
    if (convergence.rounds() >= BounceExtrapolation::kPlain && !convergence.restarts())
        ahead.begin(indirect);
}

void Relighter::State::writeField(const CacheFlags& which, bool grid) {
    const Caches& caches = bake->caches;
    const auto coefficients = std::size_t(bands * bands);
    const auto write = [&](std::size_t c, std::vector<glm::vec4>& out, std::size_t stride) {
        placeCache(caches, sh, c, coefficients, stride, out);
    };
    const std::size_t texels = std::size_t(field.lightmapWidth) * field.lightmapHeight;
    for (std::size_t c = 0; c < which.size(); ++c)
        if (which[c] != 0)
            write(c, field.lightmap, texels);
    field.gridSize = gridLit ? bake->gridSize : glm::uvec3(0);
    const std::size_t cells = field.cells();
    field.grid.resize(cells * coefficients, glm::vec4(0));
    field.gridDepth =
        gridLit ? std::shared_ptr<const std::vector<std::uint16_t>>(bake, &bake->gridDepth)
                : nullptr;
    for (std::size_t c = caches.lightmapCount; grid && c < caches.size(); ++c)
        write(c, field.grid, cells);
    ++field.version;
}

/// What is kept between two calls, without the bake and what is as small as the materials.
std::uint64_t Relighter::State::bytes() const {
    const auto sizeOf = [](const auto&... arrays) {
        return (0 + ... + (arrays.size() * sizeof(arrays[0])));
    };
    std::uint64_t sum =
        sizeOf(halfs, everyLink, beforeSky, seenShare, albedo, emitted, indirect, radiosity, sh,
               innerSh, field.lightmap, field.grid, read, current, missing, rest,
               occluded.cones.links, occluded.cones.linkBegin, occluded.cones.linkExponent,
               occluded.halfs, occlusion.places, direct.irradiance) +
        basis.bytes() + ahead.bytes();
    for (const DirectIrradiance::PerLight& light : direct.lights)
        sum += sizeOf(light.share, light.open);
    return sum;
}

/// Applies the changes in `scene`. Returns true if there were any.
bool Relighter::State::takeScene(const Scene& scene, const TraceScene& trace, RelightStats& stats) {
    Stopwatch timer;
    const bool materialsChanged = updateMaterials(scene);
    const bool skyChanged = updateSky(scene);
    const bool directChanged = updateDirectIrradiance(bake->surfels, scene, trace, direct);
    stats.lightsTraced = direct.lightsTraced;
    stats.shadowRays = direct.raysTraced;
    stats.lightsOff = std::uint32_t(scene.lights.size() - direct.lights.size());
    stats.bandsLit = std::uint32_t(bands);
    stats.bandsSkipped = bake->settings.bands - stats.bandsLit;
    stats.directMs = timer.lap();
    const bool moved = updateLinkOcclusion(*bake, scene, occlusion);
    if (moved)
        occludeLinks(*bake, occlusion, halfs, occluded);
    stats.cachesOccluded = occlusion.hidden.caches;
    stats.linksOccluded = occlusion.hidden.links;
    stats.occlusionMs = moved ? timer.lap() : 0;
    const bool occlusionChanged = moved && !occlusion.hidden.changed.empty();
    const bool grid = wantsGrid(scene);
    stats.gridCachesSkipped = grid ? 0 : gridCaches();
    gridMissing = grid && !gridLit;
    gridLit = grid;
    if (materialsChanged || directChanged || gridMissing || summed)
        convergence.lightChanged();
    if (skyChanged || occlusionChanged)
        convergence.skyChanged();
    const bool settingsChanged = convergence.applySettings(scene.relight);
    const bool changed = materialsChanged || skyChanged || directChanged || occlusionChanged ||
                         gridMissing || settingsChanged;
    if (changed || summed)
        ahead.clear();
    if (changed && convergence.restarts()) {
        std::ranges::fill(indirect, glm::vec3(0));
        unread = false;
    }
    ends = blackSky ? beforeSky : everyLink;
    started = true;
    stats.cachesUnread = std::uint32_t(std::ranges::count(read, 0));
    return changed;
}

/// Whether colours of light do not mix: no band is made grey.
bool Relighter::State::colorsApart() const {
    return finalBands.chroma == bands && innerBands.chroma == innerBands.luma;
}

/// Lights the scene by its sources' light, if nothing but their weights has changed. Returns
/// whether it did.
bool Relighter::State::sumSources(const Scene& scene, RelightStats& stats) {
    Stopwatch timer;
    if (!basis.holdFor(scene))
        return false;
    std::vector<WeightedSource> now = lightSources(scene, colorsApart());
    const bool changed = now != sources;
    std::swap(sources, now);
    if (!changed || (wantsGrid(scene) && !gridLit) || !basis.sum(sources, sh))
        return false;
    summed = true;
    unread = false;
    current.assign(current.size(), 1);
    stats.basisMs = timer.lap();
    writeField(current, gridLit);
    stats.fieldMs = timer.lap();
    stats.summed = true;
    stats.sourcesKept = std::uint32_t(basis.kept());
    stats.bandsLit = std::uint32_t(bands);
    stats.bandsSkipped = bake->settings.bands - stats.bandsLit;
    stats.gridCachesSkipped = gridLit ? 0 : gridCaches();
    stats.cachesOccluded = occlusion.hidden.caches;
    stats.linksOccluded = occlusion.hidden.links;
    stats.bytes = bytes();
    return true;
}

/// Lets surfels read the sum of sources' light.
void Relighter::State::readSum() {
    summed = false;
    keepInner(current);
    readInner();
}

std::optional<LightSource> Relighter::wantedSource(const Scene& scene) {
    State& s = *m_state;
    if (s.summed || !s.convergence.reached() || s.convergence.grows() || s.convergence.restarts() ||
        std::ranges::count(s.current, 0) > 0)
        return {};
    s.basis.holdFor(scene);
    s.sources = lightSources(scene, s.colorsApart());
    if (!s.basis.hasSum(s.sources))
        s.basis.setSum(scene, s.sources, s.sh, std::size_t(s.bands * s.bands));
    return s.basis.wanted();
}

void Relighter::keepSource(const LightSource& source, std::span<const glm::vec3> light) {
    m_state->basis.keep(source, light);
}

std::uint64_t Relighter::sourcesGeneration() const {
    return m_state->basis.generation();
}

RelightStats Relighter::relight(const Scene& scene, const TraceScene& trace, std::uint32_t bounces,
                                const Progress& progress, const CacheFlags* seen) {
    const FlushDenormals flush;
    State& s = *m_state;
    RelightStats stats;
    Stopwatch total;
    s.links = {};
    if (s.sumSources(scene, stats)) {
        stats.totalMs = total.lap();
        return stats;
    }
    const bool changed = s.takeScene(scene, trace, stats);
    Stopwatch timer;
    const bool bouncing = bounces > 0 && !s.convergence.reached();
    if (bouncing && s.summed) {
        s.readSum();
        stats.surfelReadMs += timer.lap();
    }
    if (bouncing) {
        if (s.unread && !changed) {
            s.lightRest();
            stats.cacheLightMs += timer.lap();
            s.readBounce();
            stats.surfelReadMs += timer.lap();
        }
        s.current.assign(s.current.size(), 0);
    }
    for (bool last = !bouncing; !last;) {
        s.beginBounce();
        ++stats.bounces;
        last = s.convergence.reached() || stats.bounces == bounces || progress.cancelled();
        stats.surfelLightMs += timer.lap();
        pullRadiosity(s.bake->tree, s.radiosity);
        stats.pullMs += timer.lap();
        if (last)
            break;
        s.light(s.innerBands, s.readRuns, s.inner());
        stats.cacheLightMs += timer.lap();
        s.readBounce();
        stats.surfelReadMs += timer.lap();
    }
    CacheFlags& lit = s.missing;
    setMissing(s.bake->caches, s.current, seen, lit);
    stats.converged = s.convergence.reached();
    stats.passedOn = s.convergence.passedOn();
    stats.grows = s.convergence.grows();
    stats.skipped = stats.converged && !bouncing && std::ranges::count(lit, 1) == 0;
    if (!stats.skipped) {
        const bool grid = s.gridLit && (bouncing || s.gridMissing);
        s.lightSeen(lit, bouncing);
        if (grid)
            s.light(s.finalBands, s.gridRuns, s.sh);
        if (bouncing && (seen == nullptr || stats.bounces < 2))
            s.lightRest();
        stats.cacheLightMs += timer.lap();
        if (bouncing && !s.unread)
            s.readBounce();
        stats.surfelReadMs += timer.lap();
        s.writeField(lit, grid);
        stats.fieldMs = timer.lap();
    }
    stats.cachesUnseen = std::uint32_t(std::ranges::count(s.current, 0));
    stats.sourcesKept = std::uint32_t(s.basis.kept());
    stats.links = s.links.links;
    stats.linksSkipped = s.links.skipped;
    if (stats.converged)
        s.ahead.release();
    stats.bytes = s.bytes();
    stats.totalMs = total.lap();
    return stats;
}

} // namespace limn
