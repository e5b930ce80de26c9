// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/gpu/gpu_bounces.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/storage_maker.h"
#include "engine/rsm/gpu/rsm_maps.h"
#include "engine/techniques/photon_lattices/photon.h"
#include "engine/techniques/photon_lattices/photon_paths.h"
#include "shaders/photon_lattices/photon_bounce.comp.h"

#include <array>
#include <span>

namespace limn {

using shared::GpuBounce;
using shared::GpuPhotonMap;

namespace {

constexpr VkDescriptorType kImage = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array kTypes = {kRsmTypes[0], kRsmTypes[1], kRsmTypes[2], kImage, kBuffer, kBuffer};
static_assert(kTypes.size() == PHOTON_MAP_BINDINGS && PHOTON_START_PAIRS == kStartPairs);
static_assert(PHOTON_DIFFUSE == std::uint32_t(PhotonEvent::Diffuse) &&
              PHOTON_SPECULAR == std::uint32_t(PhotonEvent::Specular) &&
              PHOTON_TRANSMITTED == std::uint32_t(PhotonEvent::Transmitted));

/// Transmission, index of refraction and whether it is a thin sheet, of each instance.
std::vector<glm::vec4> glassOf(const Scene& scene) {
    std::vector<glm::vec4> glass;
    for (const Instance& instance : scene.instances) {
        const Material& m = scene.materialOf(instance);
        glass.emplace_back(m.transmission, m.ior, m.thickness == 0 ? 1.f : 0.f, 0);
    }
    return glass;
}

} // namespace

GpuBounces::GpuBounces(gpu::Device& device, Viewport& viewport)
    : m_device(device), m_viewport(viewport), m_setLayout(gpu::createSetLayout(device, kTypes)),
      m_pool(gpu::createDescriptorPool(device, 1, kTypes)),
      m_set(gpu::allocateSet(device, m_pool, m_setLayout)),
      m_layout(gpu::createPipelineLayout(device, std::array{m_setLayout.handle},
                                         sizeof(GpuPhotonMap), "photons' bounces")),
      m_pipeline(gpu::createComputePipeline(device, kPhotonBounceComp, m_layout.handle, {},
                                            "photons' bounces")) {}

void GpuBounces::bind(const SurfaceMap& map) {
    writeRsmImages(m_device, m_set, map);
    gpu::writeTexture(m_device, m_set, PHOTON_MAP_RECEIVER, map.receiver, map.sampler);
    gpu::writeBuffer(m_device, m_set, PHOTON_MAP_GLASS, kBuffer, m_glass.handle);
    gpu::writeBuffer(m_device, m_set, PHOTON_MAP_BOUNCES, kBuffer, m_bounces.handle);
    m_mapBytes = map.bytes;
}

std::optional<std::vector<GpuBounce>> GpuBounces::bounce(const Scene& scene, const Light& light,
                                                         std::uint32_t side) {
    const std::vector<DrawnRsmView> views = drawnRsmViews(light, scene.bounds, side);
    if (views.empty() || scene.instances.empty())
        return std::vector<GpuBounce>();
    const std::uint32_t texels = views[0].view.size * views[0].view.size;
    std::vector<GpuBounce> bounces(std::size_t(views.back().index + 1) * texels);
    {
        gpu::StorageMaker maker(m_device, "Fewer photons need less");
        m_glass = maker.filled(glassOf(scene), "glass of instances");
        // Views that are not drawn stay dark.
        m_bounces = maker.filled(bounces, "photons' bounces");
    } // sends them
    if (!m_bounces || !m_glass)
        return std::nullopt;
    std::vector<SurfaceMapView> drawn;
    for (const DrawnRsmView& view : views)
        drawn.push_back(view.drawn);
    m_viewport.drawSurfaceMaps(
        drawn, glm::uvec2(views[0].view.size),
        [&](VkCommandBuffer cmd, const SurfaceMap& map, std::size_t k) {
            if (k == 0)
                bind(map);
            const GpuPhotonMap constants{.view = views[k].shaders,
                                         .viewIndex = views[k].index,
                                         .turned = views[k].turned ? 1U : 0U,
                                         .pad0 = 0,
                                         .pad1 = 0};
            vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_pipeline.handle);
            vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1,
                                    &m_set, 0, nullptr);
            vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof constants,
                               &constants);
            const std::uint32_t groups = gpu::groups(views[k].view.size, PHOTON_MAP_LANES);
            vkCmdDispatch(cmd, groups, groups, 1);
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
        });
    m_dispatches += views.size();
    m_views += views.size();
    gpu::readBuffer(m_device, m_bounces, std::as_writable_bytes(std::span(bounces)));
    return bounces;
}

} // namespace limn
