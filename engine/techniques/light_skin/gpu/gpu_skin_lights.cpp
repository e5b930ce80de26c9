// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/gpu/gpu_skin_lights.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/uploader.h"
#include "engine/rsm/gpu/rsm_maps.h"
#include "shaders/light_skin/skin_choose.comp.h"
#include "shaders/light_skin/skin_gather.comp.h"
#include "shaders/light_skin/skin_importance.comp.h"
#include "shaders/light_skin/skin_samples.comp.h"
#include "shaders/light_skin/skin_sums.comp.h"
#include "shaders/light_skin/skin_texels.comp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/ext/matrix_double4x4.hpp>
#include <glm/matrix.hpp>

namespace limn {

using shared::GpuSkinStep;

namespace {

constexpr VkDescriptorType kStepBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array<VkDescriptorType, SKIN_STEP_BINDINGS> kStepTypes = {
    kRsmTypes[0], kRsmTypes[1], kRsmTypes[2], kStepBuffer, kStepBuffer, kStepBuffer,
    kStepBuffer,  kStepBuffer,  kStepBuffer,  kStepBuffer, kStepBuffer};
constexpr std::uint32_t kStepLanes = 32; ///< of a workgroup

static_assert(sizeof(CacheSums) == SKIN_SUMS * sizeof(float));
static_assert(SKIN_SEEN_SHARE == double(kSeenShare));

/// Makes the buffer large enough for `count` items.
void ensure(gpu::Device& device, gpu::Buffer& buffer, std::size_t count, std::size_t itemBytes,
            const char* name) {
    const VkDeviceSize bytes = std::max<std::size_t>(count, 1) * itemBytes;
    if (buffer.size < bytes)
        buffer = {device,
                  {.size = bytes,
                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                   .name = name}};
}

/// Texels of the raster, views that are not drawn among them.
std::size_t texelsOf(const std::vector<DrawnRsmView>& views) {
    const std::size_t side = views[0].view.size;
    return (views.back().index + std::size_t(1)) * side * side;
}

template <class T>
gpu::Buffer uploadedItems(gpu::Device& device, const std::vector<T>& items, const char* name) {
    gpu::Uploader uploader(device);
    return uploader.buffer(std::as_bytes(std::span(items)),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                           name);
}

} // namespace

GpuSkinLights::GpuSkinLights(gpu::Device& device, Viewport& viewport)
    : m_device(device), m_viewport(viewport), m_setLayout(gpu::createSetLayout(device, kStepTypes)),
      m_pool(gpu::createDescriptorPool(device, 1, kStepTypes)),
      m_set(gpu::allocateSet(device, m_pool, m_setLayout)),
      m_layout(
          gpu::createPipelineLayout(device, std::array{m_setLayout.handle}, 128, "light skin")) {
    const auto pipeline = [&](gpu::Spirv shader, const char* name,
                              std::vector<std::uint32_t> constants = {}) {
        constants.insert(constants.begin(), kStepLanes);
        return gpu::createComputePipeline(device, shader, m_layout.handle, constants, name);
    };
    m_readTexels =
        gpu::createComputePipeline(device, kSkinTexelsComp, m_layout.handle, {}, "virtual lights");
    m_findSamples = pipeline(kSkinSamplesComp, "view samples", {0});
    m_seeCaches = pipeline(kSkinSamplesComp, "seen caches", {1});
    m_measure = pipeline(kSkinImportanceComp, "importance");
    m_sumColumns = pipeline(kSkinSumsComp, "sums of columns", {0});
    m_sumAlong = pipeline(kSkinSumsComp, "sums along columns", {1});
    m_choose = pipeline(kSkinChooseComp, "choice of lights");
    m_gather = pipeline(kSkinGatherComp, "gathering");
}

Result<std::unique_ptr<GpuSkinLights>> GpuSkinLights::create(gpu::Device& device,
                                                             Viewport& viewport) {
    if (const auto enough = device.checkStorageBuffers(SKIN_STEP_BINDINGS - RSM_BINDINGS); !enough)
        return tl::make_unexpected(enough.error());
    return std::unique_ptr<GpuSkinLights>(new GpuSkinLights(device, viewport));
}

/// What a step does not read is bound to a buffer all the same.
void GpuSkinLights::bindBuffers(const MappedLights* lights, const gpu::Buffer* draws) {
    ensure(m_device, m_importance, 1, sizeof(float), "importance");
    const auto bind = [&](std::uint32_t binding, const gpu::Buffer& buffer) {
        gpu::writeBuffer(m_device, m_set, binding, kStepBuffer,
                         buffer ? buffer.handle : m_importance.handle);
    };
    bind(SKIN_STEP_TEXELS, lights ? lights->texels : m_importance);
    bind(SKIN_STEP_IMPORTANCE, m_importance);
    bind(SKIN_STEP_SUMS, m_sums);
    bind(SKIN_STEP_SAMPLES, m_samples);
    bind(SKIN_STEP_CHOSEN, m_chosen);
    bind(SKIN_STEP_CACHES, m_caches);
    bind(SKIN_STEP_RECEIVED, m_received);
    bind(SKIN_STEP_DRAWS, draws ? *draws : m_draws);
}

MappedLights GpuSkinLights::cast(const Light& light, const Bounds& bounds, std::uint32_t size) {
    const std::size_t most =
        m_device.properties.limits.maxStorageBufferRange / sizeof(shared::GpuVirtualLight);
    std::vector<DrawnRsmView> views = drawnRsmViews(light, bounds, size);
    while (!views.empty() && texelsOf(views) > most && size > 1)
        views = drawnRsmViews(light, bounds, size /= 2);
    if (views.empty())
        return {};
    const std::uint32_t side = views[0].view.size;
    MappedLights mapped{.columns = (views.back().index + 1) * side,
                        .rows = side,
                        .views = std::uint32_t(views.size())};
    ensure(m_device, mapped.texels, mapped.count(), sizeof(shared::GpuVirtualLight),
           "virtual lights");
    std::vector<SurfaceMapView> drawn;
    for (const DrawnRsmView& view : views)
        drawn.push_back(view.drawn);
    m_viewport.drawSurfaceMaps(
        drawn, glm::uvec2(side), [&](VkCommandBuffer cmd, const SurfaceMap& map, std::size_t k) {
            if (k == 0) {
                writeRsmImages(m_device, m_set, map);
                bindBuffers(&mapped);
                m_mapBytes = map.bytes;
                // Views that see nothing are not drawn.
                vkCmdFillBuffer(cmd, mapped.texels.handle, 0, VK_WHOLE_SIZE, 0);
                gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kComputeWrite);
            }
            const shared::GpuSkinMap constants{.view = views[k].shaders,
                                               .column = views[k].index * side,
                                               .turned = views[k].turned ? 1U : 0U};
            vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_readTexels.handle);
            vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1,
                                    &m_set, 0, nullptr);
            vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof constants,
                               &constants);
            const std::uint32_t lanes = gpu::groups(side, SKIN_MAP_LANES);
            vkCmdDispatch(cmd, lanes, lanes, 1);
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
            ++m_dispatches;
        });
    return mapped;
}

/// Draws the view and lets a shader find or see the samples.
void GpuSkinLights::lookAt(const Viewpoint& view, const Bounds& bounds,
                           const gpu::Pipeline& pipeline, float near) {
    const glm::uvec2 size = sampledPixels(view);
    const SurfaceMapView map = surfaceMapOf(view.camera, float(size.x) / float(size.y), bounds);
    const shared::GpuSkinView constants{.fromClip = glm::mat4(glm::inverse(glm::dmat4(map.toClip))),
                                        .size = size,
                                        .samples = m_sampleCount,
                                        .eye = view.camera.eye,
                                        .near = near};
    m_viewport.readSurfaces(
        view.camera, size, [&](VkCommandBuffer cmd, const SurfaceMap& images, std::size_t) {
            writeRsmImages(m_device, m_set, images);
            bindBuffers(nullptr);
            m_dispatches += gpu::dispatch(m_device, cmd, pipeline.handle, m_layout.handle, m_set,
                                          std::as_bytes(std::span(&constants, 1)),
                                          gpu::groups(m_sampleCount, kStepLanes));
        });
}

void GpuSkinLights::findSamples(const Viewpoint& view, const Bounds& bounds, std::uint32_t count) {
    ensure(m_device, m_samples, count, sizeof(shared::GpuViewSample), "view samples");
    m_sampleCount = count;
    lookAt(view, bounds, m_findSamples, 0);
}

void GpuSkinLights::findSeenCaches(const LightCaches& caches, const Viewpoint& view,
                                   const Bounds& bounds) {
    const CachesInView candidates = cachesInView(caches, view);
    std::vector<shared::GpuViewSample> items;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        items.push_back({.position = candidates.caches.position[i],
                         .found = 0,
                         .normal = candidates.caches.normal[i],
                         .pixel = candidates.pixel[i].x | candidates.pixel[i].y << 16});
    m_sampleCount = std::uint32_t(items.size());
    if (!items.empty()) {
        m_samples = uploadedItems(m_device, items, "caches in view");
        lookAt(view, bounds, m_seeCaches, candidates.near);
    }
    setSamples(m_sampleCount > 0 ? readSamples() : ViewSamples{}); // hidden ones cost nothing
}

void GpuSkinLights::setSamples(const ViewSamples& samples) {
    std::vector<shared::GpuViewSample> items;
    for (std::size_t i = 0; i < samples.size(); ++i)
        items.push_back({.position = samples.position[i], .found = 1, .normal = samples.normal[i]});
    m_sampleCount = std::uint32_t(items.size());
    if (items.empty())
        items.resize(1);
    m_samples = uploadedItems(m_device, items, "view samples");
}

void GpuSkinLights::setCaches(const LightCaches& caches, std::span<const float> exponents) {
    std::vector<shared::GpuGatheringCache> items;
    for (std::size_t c = 0; c < caches.size(); ++c)
        items.push_back({.position = caches.position[c],
                         .exponent = exponents.empty() ? 0 : exponents[c],
                         .normal = caches.normal[c]});
    m_cacheCount = std::uint32_t(items.size());
    if (items.empty())
        items.resize(1);
    m_caches = uploadedItems(m_device, items, "gathering caches");
}

void GpuSkinLights::makeRoom(const MappedLights& lights, const GatherOptions& options) {
    const std::uint32_t batch = options.all ? std::min(lights.count(), SKIN_BATCH)
                                            : std::min(lights.count(), options.count);
    ensure(m_device, m_chosen, batch, sizeof(shared::GpuChosenLight), "chosen lights");
    ensure(m_device, m_received, m_cacheCount, sizeof(CacheSums), "light of caches");
    if (options.all)
        return;
    gpu::Buffer& draws = options.draws ? *options.draws : m_draws;
    ensure(m_device, draws, options.count, sizeof(shared::GpuLightDraw), "draws of lights");
    ensure(m_device, m_importance, lights.count(), sizeof(float), "importance");
    ensure(m_device, m_sums, 3 * (std::size_t(lights.count()) + lights.columns), sizeof(float),
           "sums of importance");
}

void GpuSkinLights::record(VkCommandBuffer cmd, const gpu::Pipeline& pipeline,
                           const GpuSkinStep& step, std::size_t groups) {
    m_dispatches += gpu::dispatch(m_device, cmd, pipeline.handle, m_layout.handle, m_set,
                                  std::as_bytes(std::span(&step, 1)), groups);
}

void GpuSkinLights::recordChoice(VkCommandBuffer cmd, const MappedLights& lights,
                                 GpuSkinStep step) {
    if (step.all == 0) {
        record(cmd, m_measure, step, gpu::groups(lights.count(), kStepLanes));
        record(cmd, m_sumColumns, step, gpu::groups(lights.columns, kStepLanes));
        record(cmd, m_sumAlong, step, 1);
    }
    record(cmd, m_choose, step, gpu::groups(step.count, kStepLanes));
}

bool GpuSkinLights::gather(const MappedLights& lights, const GatherOptions& options,
                           std::vector<CacheSums>& sums, const Progress& progress) {
    sums.assign(m_cacheCount, {});
    if (lights.count() == 0 || m_cacheCount == 0)
        return !progress.cancelled();
    GatherOptions chosen = options;
    chosen.all |= lights.count() <= options.count;
    makeRoom(lights, chosen);
    bindBuffers(&lights, chosen.draws);
    GpuSkinStep step{
        .columns = lights.columns,
        .rows = lights.rows,
        .samples = m_sampleCount,
        .count = options.count,
        .defensive = std::uint32_t(std::lround(double(options.defence) * double(options.count))),
        .all = chosen.all ? 1U : 0U,
        .eye = options.eye ? *options.eye : glm::vec3(0),
        .nearest = options.nearest,
        .caches = m_cacheCount,
        .epsilon = kProxyEpsilon / std::max(options.diagonal * options.diagonal, 1e-30f),
        .block = options.part.block,
        .blocks = options.part.blocks};
    const std::uint32_t end = chosen.all ? lights.count() : 1; // of batches
    while (step.first < end) {
        progress.at("light caches", float(step.first) / float(end));
        if (progress.cancelled())
            return false;
        if (chosen.all)
            step.count = std::min(lights.count() - step.first, SKIN_BATCH);
        m_device.immediate("light caches", [&](VkCommandBuffer cmd) {
            recordChoice(cmd, lights, step);
            record(cmd, m_gather, step, m_cacheCount);
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
        });
        step.first += chosen.all ? step.count : 1;
        step.add = 1;
    }
    std::vector<CacheSums> all(m_received.size / sizeof(CacheSums));
    gpu::readBuffer(m_device, m_received, std::as_writable_bytes(std::span(all)));
    std::copy_n(all.begin(), sums.size(), sums.begin());
    return true;
}

ViewSamples GpuSkinLights::readSamples() const {
    std::vector<shared::GpuViewSample> items(m_samples.size / sizeof(shared::GpuViewSample));
    gpu::readBuffer(m_device, m_samples, std::as_writable_bytes(std::span(items)));
    items.resize(m_sampleCount);
    ViewSamples samples;
    for (const shared::GpuViewSample& item : items)
        if (item.found > 0) {
            samples.position.push_back(item.position);
            samples.normal.push_back(item.normal);
        }
    return samples;
}

std::uint64_t GpuSkinLights::bytes() const {
    std::uint64_t bytes = m_mapBytes;
    for (const gpu::Buffer* buffer :
         {&m_importance, &m_sums, &m_samples, &m_chosen, &m_caches, &m_received, &m_draws})
        bytes += buffer->size;
    return bytes;
}

} // namespace limn
