// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/gpu_relight.h"

#include "engine/field/field_packing.h"
#include "engine/gpu/barrier.h"
#include "engine/gpu/storage_maker.h"
#include "engine/gpu/timestamps.h"
#include "engine/render/point_irradiance.h"
#include "engine/techniques/illuminance/gpu/gpu_link_occlusion.h"
#include "engine/techniques/illuminance/gpu/relight_steps.h"
#include "engine/techniques/illuminance/relight/bounce_extrapolation.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <optional>
#include <utility>

namespace limn {

namespace {

constexpr std::uint32_t kBounceSteps = 4, kMaxSteps = kBounceSteps * RelightBuffers::kBounces + 1;

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Copy of one input array as it is on the GPU.
struct Sent {
    std::vector<glm::vec3> values;
    const gpu::Buffer* buffer = nullptr;
};

/// Caches that are lit now, and caches that are written into the field after that.
struct FieldWork {
    CacheList light, write;
    bool grid = false; ///< the grid is lit and written
};

/// What one submission does, in this order.
struct Work {
    const ShadowedLights* lights = nullptr; ///< light surfels
    std::uint32_t bounces = 0;              ///< kBounces at most
    CacheList read, last;                   ///< caches that bounces light, and that the last lights
    bool lastIsRead = true;                 ///< surfels read what the last bounce lit
    std::optional<FieldWork> field;
};

} // namespace

struct GpuRelighter::State {
    State(gpu::Device& d, std::shared_ptr<const Bake> b, RelightBuffers made)
        : device(d), bake(std::move(b)), buffers(std::move(made)), times(d, kMaxSteps),
          surfelIrradiance(d, {.points = buffers.lightPoints.handle,
                               .stride = 1,
                               .together = bake->surfels.litAtEach(),
                               .irradiance = buffers.direct.handle,
                               .count = std::uint32_t(bake->surfels.size())}),
          occlusion(d, *bake, buffers.links) {}

    gpu::Device& device;
    std::shared_ptr<const Bake> bake;
    RelightBuffers buffers;
    std::optional<RelightSteps> steps; ///< in the field's bands
    gpu::Timestamps times;
    PointIrradiance surfelIrradiance;
    GpuLinkOcclusion occlusion;

    bool started = false;
    Convergence convergence;
    BounceExtrapolation ahead;         ///< while nothing changes
    std::vector<float> seenShare;      ///< seenShares()
    std::vector<glm::vec3> irradiance; ///< bounced, of surfels, as on the device; empty: not read
    std::vector<glm::vec4> radiosity;  ///< the same
    Sent direct, albedo, emitted;
    std::vector<glm::vec3> sky;          ///< as sent
    bool blackSky = false;               ///< as assumed by the caches that were sent
    std::vector<std::uint32_t> linkEnds; ///< of their links
    LinkCounts links;                    ///< of this call
    std::uint64_t fieldVersion = 0;
    float brightest = 0;   ///< radiosity of surfels at the last bounce [W m^-2]
    float fieldScale = 0;  ///< scale of the values in the field; 0: nothing written yet
    CacheFlags everyCache; ///< of the lightmap

    /// Lists of the lightmap's caches: those that surfels read, those to write into the field, and
    /// the other ones to light.
    enum List { kRead, kLit, kRest };
    std::array<std::vector<std::uint32_t>, RelightBuffers::kCacheLists> lists; ///< as sent
    std::vector<std::uint32_t> order;                                          ///< working space
    CacheFlags read;
    CacheFlags current;   ///< caches for which the field holds the light of the last pull
    bool unread = false;  ///< surfels have not read that light yet
    bool putsOff = false; ///< the last bounce of this call lights `lit` alone
    const ShadowedLights* newLights = nullptr; ///< of this call, which surfels are to be lit by
    CacheFlags lit, unlit;    ///< caches that this call lights; of those, the ones still to be lit
    bool gridLit = false;     ///< the field has a grid
    bool gridMissing = false; ///< and has had it since this call

    std::uint64_t dispatches() const { return steps->dispatches + surfelIrradiance.dispatches; }
    bool takeInputs(const SurfelInputs& inputs, bool newBands, GpuRelightStats& stats);
    CacheList list(List which, const CacheFlags& flags);
    void lightRest();
    bool setBands(std::uint32_t bands);
    void countLinks(const CacheFlags& lightmap, bool grid);
    bool upload(const SurfelInputs& inputs, GpuRelightStats& stats, bool& skyChanged);
    bool occlude(const Scene* scene, GpuRelightStats& stats);
    void record(VkCommandBuffer cmd, const Work& work);
    void run(const Work& work, GpuRelightStats& stats);
    RoundChange changeOf(std::uint32_t bounce);
    bool looksAhead() const;
    void beginAhead();
    void endAhead();
    void releaseAhead();
    Work nextBounces(std::uint32_t count, bool grid);
    FieldWork fieldWork(const CacheFlags& write, bool grid);
    float brightestCoefficient() const;
    void finishField(const Work& before, bool grid, GpuRelightStats& stats);
    std::vector<glm::vec3> readColors(const gpu::Buffer& buffer, std::size_t count) const;
};

GpuRelighter::GpuRelighter(std::unique_ptr<State> state) : m_state(std::move(state)) {}
GpuRelighter::~GpuRelighter() = default;

Result<std::unique_ptr<GpuRelighter>> GpuRelighter::create(gpu::Device& device,
                                                           std::shared_ptr<const Bake> bake) {
    if (const auto bindings = device.checkStorageBuffers(RelightSteps::kStorageBuffers); !bindings)
        return tl::make_unexpected(bindings.error());
    auto buffers = createRelightBuffers(device, *bake, RelightSteps::kItemLanes);
    if (!buffers)
        return tl::make_unexpected(buffers.error());
    auto state = std::make_unique<State>(device, std::move(bake), std::move(*buffers));
    state->linkEnds = allLinks(state->bake->caches);
    state->read = cachesRead(state->bake->surfels, state->bake->caches);
    state->seenShare = seenShares(state->bake->tree);
    state->setBands(0);
    state->direct.buffer = &state->buffers.direct;
    state->albedo.buffer = &state->buffers.albedo;
    state->emitted.buffer = &state->buffers.emitted;
    return std::unique_ptr<GpuRelighter>(new GpuRelighter(std::move(state)));
}

static std::vector<glm::vec4> padded(std::span<const glm::vec3> values) {
    std::vector<glm::vec4> out(values.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = glm::vec4(values[i], 0);
    return out;
}

/// Returns true if the field was replaced by a black one.
bool GpuRelighter::State::setBands(std::uint32_t bands) {
    if (bands == 0)
        bands = bake->settings.bands;
    if (steps && buffers.field->bands == bands)
        return false;
    const LightBands final = finalBands(bake->settings, int(bands));
    makeRelitField(device, *bake, bands, std::uint32_t(final.chroma), buffers);
    fieldScale = 0;
    current.assign(bake->caches.lightmapCount, 0);
    unread = gridLit = false;
    steps.emplace(device, *bake, buffers, bounceBands(bake->settings, int(bands)), final);
    return true;
}

/// Counts the links of the caches that are to be lit.
void GpuRelighter::State::countLinks(const CacheFlags& lightmap, bool grid) {
    const Caches& caches = bake->caches;
    for (std::size_t c = 0; c < caches.size(); ++c) {
        if (c < lightmap.size() ? lightmap[c] == 0 : !grid)
            continue;
        links.links += caches.linkBegin[c + 1] - caches.linkBegin[c];
        links.skipped += caches.linkBegin[c + 1] - linkEnds[c];
    }
}

/// Returns true if lights or materials had changed.
bool GpuRelighter::State::upload(const SurfelInputs& inputs, GpuRelightStats& stats,
                                 bool& skyChanged) {
    const auto start = Clock::now();
    VkCommandBuffer cmd = VK_NULL_HANDLE;
    const auto send = [&](const gpu::Buffer& to, std::size_t first, const auto& v) {
        if (v.empty())
            return;
        if (!cmd)
            cmd = device.begin("relight inputs");
        const auto bytes = std::as_bytes(std::span(v));
        gpu::updateBuffer(device, cmd, to, first * sizeof v[0], bytes);
        stats.bytesUploaded += bytes.size();
    };
    const auto sendIfNew = [&](Sent& sent, std::span<const glm::vec3> values) {
        assert(values.size() == bake->surfels.size());
        if (started && std::ranges::equal(sent.values, values))
            return false;
        sent.values.assign(values.begin(), values.end());
        send(*sent.buffer, 0, padded(values));
        return true;
    };
    bool changed = sendIfNew(albedo, inputs.albedo);
    if (!inputs.lights) {
        changed |= sendIfNew(direct, inputs.direct);
        surfelIrradiance.forget();
    }
    changed |= sendIfNew(emitted, inputs.emitted);
    assert(inputs.sky.size() == bake->tree.skyCells);
    if (!started || !std::ranges::equal(sky, inputs.sky)) {
        sky.assign(inputs.sky.begin(), inputs.sky.end());
        send(buffers.radiosity, bake->tree.surfels, padded(sky));
        const bool black = std::ranges::all_of(sky, [](glm::vec3 c) { return c == glm::vec3(0); });
        if (black != blackSky) { // links to sky alone are skipped
            blackSky = black;
            linkEnds = black ? linksBeforeSky(bake->caches, bake->tree) : allLinks(bake->caches);
            send(buffers.caches, 0, packCaches(bake->caches, linkEnds));
        }
        convergence.skyChanged();
        skyChanged = true;
    }
    if (cmd)
        device.submit(cmd);
    stats.uploadMs = msSince(start);
    return changed;
}

/// Returns true if the occlusion of some link changed.
bool GpuRelighter::State::occlude(const Scene* scene, GpuRelightStats& stats) {
    const auto start = Clock::now();
    const std::optional<std::uint64_t> sent = occlusion.update(scene);
    stats.cachesOccluded = occlusion.hidden().caches;
    stats.linksOccluded = occlusion.hidden().links;
    stats.bytesUploaded += sent.value_or(0);
    stats.occlusionMs = sent ? msSince(start) : 0;
    if (sent.value_or(0) == 0)
        return false;
    convergence.skyChanged();
    return true;
}

/// Uploads the caches of `flags` as a list.
CacheList GpuRelighter::State::list(List which, const CacheFlags& flags) {
    const std::uint32_t lightmap = bake->caches.lightmapCount;
    const auto begin =
        std::uint32_t(bake->caches.size()) - lightmap + std::uint32_t(which) * lightmap;
    order.clear();
    for (std::uint32_t c = 0; c < lightmap; ++c)
        if (flags[c] != 0)
            order.push_back(c);
    const CacheList result{begin, begin + std::uint32_t(order.size())};
    if (order == lists[which] || order.empty())
        return result;
    const VkCommandBuffer cmd = device.begin("list of caches");
    gpu::updateBuffer(device, cmd, buffers.order, begin * sizeof order[0],
                      std::as_bytes(std::span(order)));
    device.submit(cmd);
    std::swap(lists[which], order);
    return result;
}

/// Lights the caches that were postponed.
void GpuRelighter::State::lightRest() {
    unlit = read;
    removeFrom(unlit, current);
    const CacheList rest = list(kRest, unlit);
    countLinks(unlit, false);
    device.immediate("rest of the last bounce", [&](VkCommandBuffer cmd) {
        gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite);
        steps->recordLightmapCaches(cmd, rest);
        steps->recordIndirect(cmd);
    });
    irradiance.clear();
    unread = false;
}

void GpuRelighter::State::record(VkCommandBuffer cmd, const Work& work) {
    gpu::memoryBarrier(cmd, gpu::kAllWrites,
                       gpu::kComputeWrite); // after inputs and lists were sent
    if (work.lights)
        surfelIrradiance.record(cmd, *work.lights);
    times.begin(cmd);
    for (std::uint32_t k = 0; k < work.bounces; ++k) {
        const bool last = k + 1 == work.bounces;
        steps->recordSurfels(cmd, k);
        times.mark(cmd);
        steps->recordPull(cmd);
        times.mark(cmd);
        steps->recordLightmapCaches(cmd, last ? work.last : work.read);
        times.mark(cmd);
        if (!last || work.lastIsRead)
            steps->recordIndirect(cmd);
        times.mark(cmd);
    }
    if (work.field) {
        if (work.field->light.end > work.field->light.begin)
            steps->recordLightmapCaches(cmd, work.field->light);
        steps->recordFinalCaches(cmd, work.field->write, work.field->grid);
        steps->recordField(cmd, work.field->write, work.field->grid, fieldScale);
        times.mark(cmd);
    }
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
}

/// Submits, waits, and adds up the times.
void GpuRelighter::State::run(const Work& work, GpuRelightStats& stats) {
    device.immediate("relight", [&](VkCommandBuffer cmd) { record(cmd, work); });
    if (work.lights) {
        surfelIrradiance.finish();
        direct.values.clear(); // the uploaded values are overwritten
        stats.lightsTraced = surfelIrradiance.lightsComputed;
        stats.directMs = surfelIrradiance.ms;
    }
    const std::span<const double> ms = times.steps();
    for (std::uint32_t k = 0; k < work.bounces; ++k) {
        const std::span<const double> bounce = ms.subspan(std::size_t(kBounceSteps) * k);
        stats.surfelLightMs += bounce[0] + bounce[3];
        stats.pullMs += bounce[1];
        stats.cacheLightMs += bounce[2];
    }
    stats.bounces += work.bounces;
    if (work.field)
        stats.fieldMs += ms.back();
}

/// The change of a bounce of the latest submission. Sets `brightest`.
RoundChange GpuRelighter::State::changeOf(std::uint32_t bounce) {
    RoundChange round;
    const std::size_t groups = buffers.change.size / sizeof(glm::vec4) / RelightBuffers::kBounces;
    const auto* begin = static_cast<const glm::vec4*>(buffers.change.mapped) + bounce * groups;
    brightest = 0;
    for (const glm::vec4& group : std::span(begin, groups)) {
        brightest = std::max(brightest, group.w);
        round += {double(group.x), double(group.y), double(group.z)};
    }
    return round;
}

/// Upper bound on the coefficients. The integral of |Y_i| is below sqrt(4 pi), so light of
/// radiosity B from all around, of radiance B / pi, gives a coefficient of at most 1.13 B.
float GpuRelighter::State::brightestCoefficient() const {
    float maximum = brightest;
    for (const glm::vec3& c : sky)
        maximum = std::max({maximum, c.x, c.y, c.z});
    return 1.13f * maximum;
}

/// Whether the next bounce is one of those that are extrapolated, as by Relighter. The CPU does
/// that: most light rests before, and what is left moves a few megabytes a bounce.
bool GpuRelighter::State::looksAhead() const {
    return convergence.rounds() + 1 >= BounceExtrapolation::kPlain && !convergence.restarts();
}

void GpuRelighter::State::beginAhead() {
    if (irradiance.empty())
        irradiance = readColors(buffers.indirect, bake->surfels.size());
    ahead.begin(irradiance);
}

/// Replaces what surfels have read by what they will read.
void GpuRelighter::State::endAhead() {
    irradiance = readColors(buffers.indirect, bake->surfels.size());
    radiosity.resize(bake->surfels.size());
    gpu::readBuffer(device, buffers.radiosity, std::as_writable_bytes(std::span(radiosity)));
    ahead.end({albedo.values, radiosity, bake->surfels.area, seenShare}, irradiance);
    const VkCommandBuffer cmd = device.begin("irradiance of later bounces");
    gpu::updateBuffer(device, cmd, buffers.indirect, 0,
                      std::as_bytes(std::span<const glm::vec4>(padded(irradiance))));
    device.submit(cmd);
}

void GpuRelighter::State::releaseAhead() {
    ahead.release();
    irradiance = std::vector<glm::vec3>();
    radiosity = std::vector<glm::vec4>();
}

/// Bounces of one submission, of `count` that are still wanted: as many as are expected to be
/// needed, less a fourth, because none after the last needed one would be of use. The field follows
/// where those are all.
Work GpuRelighter::State::nextBounces(std::uint32_t count, bool grid) {
    const std::uint32_t expected = convergence.expectedRounds();
    const bool alone = looksAhead();
    Work work;
    work.bounces = alone ? 1 : std::min({count, RelightBuffers::kBounces, expected - expected / 4});
    if (!alone && !convergence.restarts())
        work.bounces =
            std::min(work.bounces, BounceExtrapolation::kPlain - 1 - convergence.rounds());
    const bool ends = work.bounces == count;
    unread = putsOff && ends && !alone;
    work.lastIsRead = !unread;
    const CacheFlags& last = unread ? lit : read;
    for (std::uint32_t k = 0; k < work.bounces; ++k)
        countLinks(k + 1 < work.bounces ? read : last, false);
    work.read = list(kRead, read);
    work.last = unread ? list(kLit, lit) : work.read;
    unlit = lit;
    removeFrom(unlit, last);
    if (ends && fieldScale > 0)
        work.field = fieldWork(lit, grid);
    return work;
}

/// Lights the caches that are to be lit and writes `write` and, if `grid` is true, the grid.
FieldWork GpuRelighter::State::fieldWork(const CacheFlags& write, bool grid) {
    const FieldWork work = {list(kRest, unlit), list(kLit, write), grid};
    countLinks(unlit, grid);
    unlit.assign(unlit.size(), 0);
    return work;
}

/// Writes the field, unless `before` has. Where the scale has to change, which happens only after
/// another bounce, it also rewrites all that was lit before.
void GpuRelighter::State::finishField(const Work& before, bool grid, GpuRelightStats& stats) {
    const bool rescaled = !scaleServes(fieldScale, brightestCoefficient());
    Work work{.lights = newLights};
    newLights = nullptr;
    if (rescaled) {
        fieldScale = limn::fieldScale(brightestCoefficient());
        everyCache.assign(bake->caches.lightmapCount, 1);
        work.field = fieldWork(everyCache, gridLit);
    } else if (!before.field) {
        work.field = fieldWork(lit, grid);
    }
    if (work.field)
        run(work, stats);
    buffers.field->scale = fieldScale;
    ++fieldVersion;
}

/// Applies changes of the inputs. Returns true if there were any.
bool GpuRelighter::State::takeInputs(const SurfelInputs& inputs, bool newBands,
                                     GpuRelightStats& stats) {
    bool skyChanged = false;
    bool surfelsChanged = upload(inputs, stats, skyChanged) || newBands;
    newLights =
        inputs.lights && !surfelIrradiance.isCurrent(*inputs.lights) ? inputs.lights : nullptr;
    surfelsChanged |= newLights != nullptr;
    const bool occlusionChanged = occlude(inputs.occluders, stats);
    const auto gridCaches = std::uint32_t(bake->caches.size()) - bake->caches.lightmapCount;
    const bool grid = inputs.grid && gridCaches > 0;
    stats.gridCachesSkipped = grid ? 0 : gridCaches;
    gridMissing = grid && !gridLit;
    gridLit = grid;
    const bool settingsChanged = convergence.applySettings(inputs.settings);
    started = true;
    if (surfelsChanged || gridMissing)
        convergence.lightChanged();
    const bool changed =
        surfelsChanged || skyChanged || occlusionChanged || gridMissing || settingsChanged;
    if (changed)
        ahead.clear();
    if (changed && convergence.restarts()) {
        irradiance.clear();
        gpu::clearBuffers(device, {buffers.indirect.handle});
        unread = false;
    }
    return changed;
}

GpuRelightStats GpuRelighter::relight(const SurfelInputs& inputs, std::uint32_t bounces,
                                      const Progress& progress, const CacheFlags* seen) {
    State& s = *m_state;
    GpuRelightStats stats;
    const auto start = Clock::now();
    s.links = {};
    const Caches& caches = s.bake->caches;
    const bool newBands = s.setBands(inputs.bands);
    const std::uint64_t dispatchesBefore = s.dispatches();
    const bool changed = s.takeInputs(inputs, newBands, stats);
    const bool bouncing = bounces > 0 && !s.convergence.reached();
    if (bouncing) {
        if (s.unread && !changed)
            s.lightRest();
        s.current.assign(s.current.size(), 0);
    }
    CacheFlags& lit = s.lit;
    setMissing(caches, s.current, seen, lit);
    s.unlit = lit;
    s.putsOff = seen != nullptr && bounces > 1 && !s.steps->dropsChroma();
    const bool grid = s.gridLit && (bouncing || s.gridMissing);
    Work work;
    while (bouncing && stats.bounces < bounces && !s.convergence.reached()) {
        work = s.nextBounces(bounces - stats.bounces, grid);
        work.lights = std::exchange(s.newLights, nullptr);
        const bool ahead = s.looksAhead();
        if (ahead)
            s.beginAhead();
        else
            s.irradiance.clear();
        s.run(work, stats);
        for (std::uint32_t k = 0; k < work.bounces; ++k)
            if (const RoundChange round = s.changeOf(k); !s.convergence.reached())
                s.ahead.addRound(round, s.convergence);
        if (ahead && !s.convergence.reached())
            s.endAhead();
        if (progress.cancelled())
            break;
    }
    stats.converged = s.convergence.reached();
    if (stats.converged)
        s.releaseAhead();
    stats.passedOn = s.convergence.passedOn();
    stats.grows = s.convergence.grows();
    stats.skipped = stats.converged && !bouncing && std::ranges::count(lit, 1) == 0;
    if (!stats.skipped) {
        s.finishField(work, grid, stats);
        for (std::size_t c = 0; c < lit.size(); ++c)
            s.current[c] |= lit[c];
    }
    stats.cachesUnseen = std::uint32_t(std::ranges::count(s.current, 0));
    stats.cachesUnread = std::uint32_t(std::ranges::count(s.read, 0));
    stats.links = s.links.links;
    stats.linksSkipped = s.links.skipped;
    stats.dispatches = std::uint32_t(s.dispatches() - dispatchesBefore);
    stats.totalMs = msSince(start);
    return stats;
}

const std::shared_ptr<const Bake>& GpuRelighter::bake() const {
    return m_state->bake;
}
std::shared_ptr<const GpuField> GpuRelighter::field() const {
    return m_state->buffers.field;
}
std::uint64_t GpuRelighter::fieldVersion() const {
    return m_state->fieldVersion;
}

std::vector<glm::vec3> GpuRelighter::State::readColors(const gpu::Buffer& buffer,
                                                       std::size_t count) const {
    if (count == 0)
        return {};
    std::vector<glm::vec4> colors(count);
    gpu::readBuffer(device, buffer, std::as_writable_bytes(std::span(colors)));
    return {colors.begin(), colors.end()};
}

std::vector<glm::vec3> GpuRelighter::readRadiosity() const {
    return m_state->readColors(m_state->buffers.radiosity, m_state->bake->tree.size());
}

std::vector<glm::vec3> GpuRelighter::readCacheSh() const {
    const std::uint32_t bands = m_state->buffers.field->bands;
    return m_state->readColors(m_state->buffers.sh, m_state->bake->caches.size() * bands * bands);
}

IndirectField GpuRelighter::readField() const {
    const State& s = *m_state;
    IndirectField out = limn::readField(s.device, *s.buffers.field);
    if (s.bake->lightmap.width == 0) { // the image is there nevertheless
        out.lightmapWidth = out.lightmapHeight = 0;
        out.lightmap.clear();
    }
    if (!s.gridLit) {
        out.gridSize = glm::uvec3(0);
        out.grid.clear();
    }
    if (s.gridLit && !s.bake->gridDepth.empty())
        out.gridDepth = {s.bake, &s.bake->gridDepth};
    out.version = s.fieldVersion;
    return out;
}

} // namespace limn
