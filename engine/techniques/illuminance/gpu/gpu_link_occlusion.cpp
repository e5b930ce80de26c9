// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/gpu_link_occlusion.h"

#include "engine/core/parallel.h"
#include "engine/gpu/barrier.h"
#include "shaders/illuminance/relight_links.comp.h"
#include "shaders/shared/gpu_relight.h"

#include <algorithm>
#include <array>
#include <bit>

namespace limn {

namespace {

constexpr std::uint32_t kLanes = 64;
constexpr std::size_t kStagingBytes = 2 << 20; // larger updates are split
constexpr std::size_t kLinksAtOnce = 1024;     // per task

/// Number of words of a link that occlusion changes. relight_buffers packs harmonics as pairs of
/// halfs.
std::size_t changingWords(const Bake& bake) {
    const std::size_t coefficients = std::size_t(bake.settings.bands) * bake.settings.bands;
    return bake.caches.shNode.empty() ? 1 : (coefficients + 1) / 2;
}

} // namespace

GpuLinkOcclusion::GpuLinkOcclusion(gpu::Device& device, const Bake& bake, const gpu::Buffer& links)
    : m_device(device), m_bake(bake), m_links(links), m_words(changingWords(bake)) {}

void GpuLinkOcclusion::makePipeline() {
    m_staging = {m_device,
                 {.size = kStagingBytes,
                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                  .memory = gpu::MemoryKind::Upload,
                  .name = "occluded links"}};
    constexpr std::array kTypes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                   VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    m_setLayout = gpu::createSetLayout(m_device, kTypes);
    m_pool = gpu::createDescriptorPool(m_device, 1, kTypes);
    m_set = gpu::allocateSet(m_device, m_pool, m_setLayout);
    gpu::writeBuffer(m_device, m_set, 0, kTypes[0], m_links.handle);
    gpu::writeBuffer(m_device, m_set, 1, kTypes[1], m_staging.handle);
    m_layout = gpu::createPipelineLayout(m_device, std::array{m_setLayout.handle},
                                         sizeof(shared::GpuRelightRange), "occlude links");
    const std::uint32_t stride =
        m_bake.caches.shNode.empty() ? RELIGHT_CONE_WORDS : 1 + std::uint32_t(m_words);
    const std::array constants = {kLanes, std::uint32_t(m_words), stride};
    m_pipeline = gpu::createComputePipeline(m_device, kRelightLinksComp, m_layout.handle, constants,
                                            "occlude links");
}

/// Writes changed links [begin, end) to the staging buffer: the link, then its new words.
void GpuLinkOcclusion::fill(std::size_t begin, std::size_t end) {
    const HiddenLinks& hidden = m_occlusion.hidden;
    const Caches& caches = m_bake.caches;
    const std::size_t coefficients =
        caches.shNode.empty() ? 0 : caches.shCoefficients.size() / caches.shNode.size();
    parallelRanges(end - begin, kLinksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t k = hidden.changed[begin + i];
            const float share = openShare(m_bake, hidden, k);
            auto* out = static_cast<std::uint32_t*>(m_staging.mapped) + i * (1 + m_words);
            *out++ = k;
            if (coefficients == 0) {
                Link link = caches.links[k];
                link.transport = occludedHalf(link.transport, share);
                *out = std::bit_cast<std::array<std::uint32_t, RELIGHT_CONE_WORDS>>(link).back();
                continue;
            }
            const std::uint16_t* halfs = &caches.shCoefficients[k * coefficients];
            for (std::size_t c = 0; c < coefficients; c += 2) {
                const std::uint32_t low = occludedHalf(halfs[c], share),
                                    high = c + 1 < coefficients ? occludedHalf(halfs[c + 1], share)
                                                                : 0U;
                *out++ = low | high << 16;
            }
        }
    });
}

std::optional<std::uint64_t> GpuLinkOcclusion::update(const Scene* scene) {
    const Scene none;
    if (!updateLinkOcclusion(m_bake, scene ? *scene : none, m_occlusion))
        return std::nullopt;
    const std::size_t changed = m_occlusion.hidden.changed.size();
    if (changed > 0 && !m_pipeline)
        makePipeline();
    const std::size_t bytes = (1 + m_words) * sizeof(std::uint32_t), room = kStagingBytes / bytes;
    for (std::size_t begin = 0; begin < changed; begin += room) {
        const std::size_t end = std::min(begin + room, changed);
        fill(begin, end);
        m_device.immediate("occlude links", [&](VkCommandBuffer cmd) {
            const auto words = std::uint32_t((end - begin) * m_words);
            const shared::GpuRelightRange range{.begin = 0, .end = words};
            gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite);
            vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_pipeline.handle);
            vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1,
                                    &m_set, 0, nullptr);
            vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof range, &range);
            vkCmdDispatch(cmd, (words + kLanes - 1) / kLanes, 1, 1);
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
        });
    }
    return changed * bytes;
}

} // namespace limn
