// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/volume_pass.h"

#include "engine/core/log.h"
#include "engine/gpu/uploader.h"
#include "shaders/radiance_volumes/volume_light.frag.h"

#include <array>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::array<VkDescriptorType, VOLUME_BINDINGS> kPassTypes = {
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

} // namespace

shared::GpuCacheGrids gpuCacheGrids(const CacheGrids& grids,
                                    const std::optional<GlossyMapShape>& glossy, glm::vec3 eye) {
    shared::GpuCacheGrids out{.eye = eye,
                              .count = std::uint32_t(grids.grids.size()),
                              .transition = grids.transition,
                              .tile = glossy ? glossy->tile : 0};
    for (std::size_t g = 0; g < grids.grids.size(); ++g) {
        const CacheGrid& grid = grids.grids[g];
        out.grid[g] = {.lower = grid.lower,
                       .cell = grid.cell,
                       .nodes = grid.nodes,
                       .first = std::uint32_t(grids.firstNode(g)),
                       .decisionLower = grid.decision.lower,
                       .decisionUpper = grid.decision.upper};
    }
    return out;
}

VolumePass::VolumePass(gpu::Device& device, Viewport& viewport,
                       std::shared_ptr<const GpuVolume> volume)
    : m_volume(std::move(volume)),
      m_grids(gpu::Uploader(device).buffer(std::as_bytes(std::span(&m_volume->grids, 1)),
                                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "grids of caches")),
      m_set(device, viewport.lightPipelines().of(
                        {kVolumeLightFrag, kPassTypes, {m_volume->bands}, "radiance volumes"})) {
    const auto bind = [&](std::uint32_t binding, const gpu::Buffer& buffer) {
        m_set.bind(binding, buffer ? buffer : m_grids); // what is empty is not read
    };
    bind(VOLUME_GRIDS, m_grids);
    bind(VOLUME_ADDRESS, m_volume->address ? *m_volume->address : m_grids);
    bind(VOLUME_HARMONICS, m_volume->harmonics);
    bind(VOLUME_GLOSSY, m_volume->glossy);
}

void VolumePass::record(const LightPassFrame& frame) {
    if (m_volume->harmonics)
        m_set.draw(frame);
}

std::shared_ptr<LightPass> uploadVolumePart(gpu::Device& device, Viewport& viewport,
                                            const IndirectField& field) {
    const auto* part = dynamic_cast<const VolumePart*>(field.parts[0].get());
    if (!part || part->light.harmonics.empty())
        return nullptr;
    const std::uint64_t limit = device.properties.limits.maxStorageBufferRange;
    auto volume = std::make_shared<GpuVolume>();
    volume->bands = part->bands;
    gpu::Uploader uploader(device);
    const auto upload = [&](const auto& values, const char* name) {
        const auto bytes = std::as_bytes(std::span(values));
        if (bytes.empty())
            return gpu::Buffer();
        if (bytes.size() > limit) {
            logWarning(fmt::format("{} of {} MiB are more than this device can bind", name,
                                   bytes.size() >> 20));
            return gpu::Buffer();
        }
        return uploader.buffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, name);
    };
    gpu::Buffer address = upload(part->caches->address, "addresses of caches");
    volume->harmonics = upload(part->light.harmonics, "light of caches");
    volume->glossy = upload(part->light.glossy, "maps of caches");
    uploader.flush();
    if (!address || !volume->harmonics)
        return nullptr;
    volume->address = std::make_shared<const gpu::Buffer>(std::move(address));
    volume->grids =
        gpuCacheGrids(part->caches->grids, volume->glossy ? part->glossy : std::nullopt, part->eye);
    volume->grids.clamped = part->clamped ? 1 : 0;
    return std::make_shared<VolumePass>(device, viewport, std::move(volume));
}

} // namespace limn
