// SPDX-License-Identifier: MIT
#include "engine/relight_gpu/gpu_relight.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/timestamps.h"
#include "engine/relight/bouncing.h"
#include "engine/relight_gpu/relight_steps.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::uint32_t kMostSteps = 4;

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// One array of the inputs as it is on the GPU.
struct Sent {
    std::vector<glm::vec3> values;
    const gpu::Buffer* buffer = nullptr;
};

} // namespace

struct GpuRelighter::State {
    State(gpu::Device& d, std::shared_ptr<const Bake> b, RelightBuffers made)
        : device(d), bake(std::move(b)), buffers(std::move(made)), times(d, kMostSteps) {}

    gpu::Device& device;
    std::shared_ptr<const Bake> bake;
    RelightBuffers buffers;
    std::optional<RelightSteps> steps; ///< in the field's bands
    gpu::Timestamps times;

    bool started = false;
    Convergence convergence;
    Sent direct, albedo, emitted;
    std::vector<glm::vec3> sky;                 ///< as sent
    std::uint64_t skyLinksSkipped = 0;          ///< per bounce
    std::optional<std::uint64_t> lightsVersion; ///< of the lights that E_direct came from
    std::uint64_t fieldVersion = 0;

    bool setBands(std::uint32_t bands);
    std::vector<shared::GpuCache> cachesUnder(bool blackSky);
    bool upload(const SurfelInputs& inputs, GpuRelightStats& stats);
    bool lightSurfels(const ShadowedLights& lights, GpuRelightStats& stats);
    double bounce(GpuRelightStats& stats);
    void writeField(GpuRelightStats& stats);
    std::vector<glm::vec3> readColors(const gpu::Buffer& buffer, std::size_t count) const;
};

static Result<void> checkBindings(const gpu::Device& device) {
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    const std::uint32_t most =
        std::min(limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers);
    if (most < RelightSteps::kStorageBuffers)
        return fail(fmt::format("{}: {} storage buffers can be bound at once, {} are needed",
                                device.properties.deviceName, most, RelightSteps::kStorageBuffers));
    return {};
}

GpuRelighter::GpuRelighter(std::unique_ptr<State> state) : m_state(std::move(state)) {}
GpuRelighter::~GpuRelighter() = default;

Result<std::unique_ptr<GpuRelighter>> GpuRelighter::create(gpu::Device& device,
                                                           std::shared_ptr<const Bake> bake) {
    if (const auto bindings = checkBindings(device); !bindings)
        return tl::make_unexpected(bindings.error());
    auto buffers = createRelightBuffers(device, *bake, RelightSteps::kItemLanes);
    if (!buffers)
        return tl::make_unexpected(buffers.error());
    auto state = std::make_unique<State>(device, std::move(bake), std::move(*buffers));
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

/// True if the field is another one, black.
bool GpuRelighter::State::setBands(std::uint32_t bands) {
    if (bands == 0)
        bands = bake->settings.bands;
    if (steps && buffers.field->bands == bands)
        return false;
    makeRelitField(device, *bake, bands, buffers);
    steps.emplace(device, *bake, buffers, bounceBands(bake->settings, int(bands)),
                  finalBands(bake->settings, int(bands)));
    return true;
}

/// As they are read under a black sky, where links to nothing else are passed over, or under
/// another.
std::vector<shared::GpuCache> GpuRelighter::State::cachesUnder(bool blackSky) {
    const Caches& caches = bake->caches;
    const std::vector<std::uint32_t> all = allLinks(caches);
    const std::vector<std::uint32_t> ends = blackSky ? linksBeforeSky(caches, bake->tree) : all;
    skyLinksSkipped = 0;
    for (std::size_t c = 0; c < all.size(); ++c)
        skyLinksSkipped += all[c] - ends[c];
    return packCaches(caches, ends);
}

/// True if lights or materials had changed.
bool GpuRelighter::State::upload(const SurfelInputs& inputs, GpuRelightStats& stats) {
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
        lightsVersion.reset();
    }
    changed |= sendIfNew(emitted, inputs.emitted);
    assert(inputs.sky.size() == bake->tree.skyCells);
    if (!started || !std::ranges::equal(sky, inputs.sky)) {
        sky.assign(inputs.sky.begin(), inputs.sky.end());
        send(buffers.radiosity, bake->tree.surfels, padded(sky));
        const bool black = std::ranges::all_of(sky, [](glm::vec3 c) { return c == glm::vec3(0); });
        if (black != (skyLinksSkipped > 0))
            send(buffers.caches, 0, cachesUnder(black));
        convergence.skyChanged();
    }
    if (cmd)
        device.submit(cmd);
    stats.uploadMs = msSince(start);
    return changed;
}

/// True if the lights had changed.
bool GpuRelighter::State::lightSurfels(const ShadowedLights& lights, GpuRelightStats& stats) {
    if (lightsVersion == lights.version)
        return false;
    lightsVersion = lights.version;
    direct.values.clear(); // what was sent is overwritten
    device.immediate("light surfels", [&](VkCommandBuffer cmd) {
        times.begin(cmd);
        steps->recordDirect(cmd, lights);
        times.mark(cmd);
    });
    stats.directMs = times.steps()[0];
    return true;
}

/// One iteration. Returns the change of the surfels' total radiosity over that total.
double GpuRelighter::State::bounce(GpuRelightStats& stats) {
    device.immediate("bounce", [&](VkCommandBuffer cmd) {
        gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite); // after inputs were sent
        times.begin(cmd);
        steps->recordSurfels(cmd);
        times.mark(cmd);
        steps->recordPull(cmd);
        times.mark(cmd);
        steps->recordLightmapCaches(cmd);
        times.mark(cmd);
        steps->recordIndirect(cmd);
        times.mark(cmd);
        gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
    });
    const std::vector<double> ms = times.steps();
    stats.surfelLightMs += ms[0] + ms[3];
    stats.pullMs += ms[1];
    stats.cacheLightMs += ms[2];
    ++stats.bounces;
    double change = 0, total = 0;
    const auto* groups = static_cast<const glm::vec2*>(buffers.change.mapped);
    for (std::size_t g = 0; g < buffers.change.size / sizeof(glm::vec2); ++g) {
        change += double(groups[g].x);
        total += double(groups[g].y);
    }
    return total > 0 ? change / total : (change > 0 ? 1 : 0);
}

void GpuRelighter::State::writeField(GpuRelightStats& stats) {
    device.immediate("field", [&](VkCommandBuffer cmd) {
        times.begin(cmd);
        steps->recordFinalCaches(cmd);
        steps->recordField(cmd);
        times.mark(cmd);
    });
    stats.fieldMs = times.steps()[0];
    ++fieldVersion;
}

GpuRelightStats GpuRelighter::relight(const SurfelInputs& inputs, std::uint32_t bounces,
                                      const Progress& progress) {
    State& s = *m_state;
    GpuRelightStats stats;
    const auto start = Clock::now();
    bool changed = s.setBands(inputs.bands);
    const std::uint64_t dispatchesBefore = s.steps->dispatches;
    changed |= s.upload(inputs, stats);
    if (inputs.lights)
        changed |= s.lightSurfels(*inputs.lights, stats);
    s.started = true;
    if (changed)
        s.convergence.lightChanged();
    stats.skipped = s.convergence.reached();
    for (std::uint32_t k = 0; k < bounces && !s.convergence.reached(); ++k) {
        s.convergence.addRound(s.bounce(stats));
        if (progress.cancelled())
            break;
    }
    if (!stats.skipped)
        s.writeField(stats);
    stats.converged = s.convergence.reached();
    stats.skyLinksSkipped = stats.skipped ? 0 : s.skyLinksSkipped;
    stats.dispatches = std::uint32_t(s.steps->dispatches - dispatchesBefore);
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
    IndirectField out;
    out.bands = s.buffers.field->bands;
    out.lightmapWidth = s.bake->lightmap.width;
    out.lightmapHeight = s.bake->lightmap.height;
    out.gridSize = s.bake->gridSize;
    out.gridBounds = s.bake->gridBounds;
    out.version = s.fieldVersion;
    out.lightmap.resize(std::size_t(out.lightmapWidth) * out.lightmapHeight * out.coefficients());
    if (!out.lightmap.empty())
        gpu::readImage(s.device, s.buffers.field->lightmap,
                       VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, out.lightmapWidth,
                       out.lightmapHeight, std::as_writable_bytes(std::span(out.lightmap)),
                       out.coefficients());
    if (!s.bake->gridDepth.empty())
        out.gridDepth = {s.bake, &s.bake->gridDepth};
    out.grid.resize(std::size_t(out.gridSize.x) * out.gridSize.y * out.gridSize.z *
                    out.coefficients());
    if (!out.grid.empty())
        gpu::readBuffer(s.device, s.buffers.field->grid,
                        std::as_writable_bytes(std::span(out.grid)));
    return out;
}

} // namespace limn
