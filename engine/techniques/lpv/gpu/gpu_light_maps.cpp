// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/gpu/gpu_light_maps.h"

#include "engine/gpu/barrier.h"
#include "engine/lattice/cell_lobes.h"
#include "engine/rsm/reflective_shadow_map.h"
#include "shaders/lpv/lpv_collect.comp.h"
#include "shaders/lpv/lpv_map.comp.h"
#include "shaders/shared/gpu_lpv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

using shared::GpuLpvMap;

namespace {

constexpr VkDescriptorType kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                           kTexture = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
constexpr std::array kTypes = {kTexture, kTexture, kTexture, kBuffer, kBuffer, kBuffer};
static_assert(kTypes.size() == LPV_MAP_BINDINGS);
static_assert(std::uint32_t(LightKind::Directional) == LPV_LIGHT_SUN &&
              std::uint32_t(LightKind::Point) == LPV_LIGHT_POINT &&
              std::uint32_t(LightKind::Spot) == LPV_LIGHT_SPOT &&
              std::uint32_t(LightKind::Rectangle) == LPV_LIGHT_RECTANGLE);

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kNear = 1e-5f; // near plane, of the distance of the farthest corner of the scene

/// Moves a point off a surface by more than positions there are rounded.
glm::vec3 clearOf(glm::vec3 p, glm::vec3 normal, const Bounds& bounds) {
    const float coordinate = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return p + normal * (0x1p-19f * coordinate + 0x1p-20f * glm::length(bounds.size()));
}

/// Distances of the scene's farthest corner, along the view and in all.
struct Reach {
    float along = 0, distance = 0;
};

Reach reachOf(const RsmView& view, const Bounds& bounds) {
    Reach reach;
    for (int k = 0; k < 8; ++k) {
        const glm::vec3 corner((k & 1) ? bounds.upper.x : bounds.lower.x,
                               (k & 2) ? bounds.upper.y : bounds.lower.y,
                               (k & 4) ? bounds.upper.z : bounds.lower.z);
        reach.along = std::max(reach.along, glm::dot(corner - view.origin, view.forward));
        reach.distance = std::max(reach.distance, glm::length(corner - view.origin));
    }
    return reach;
}

/// The distance of which a view's depths are a share, as GpuLpvMap::depthUnit.
float depthUnit(const RsmView& view, const Bounds& bounds) {
    const Reach reach = reachOf(view, bounds);
    return view.parallel ? 1.01f * reach.along : std::max(kNear * reach.distance, 1e-11f);
}

/// The projection whose texels are those of the view. Depth is 1 - distance / unit of a parallel
/// view and unit / distance of others.
glm::mat4 toClip(const RsmView& view, float unit) {
    const auto row = [&](glm::vec3 axis, float at0) {
        return glm::vec4(axis, at0 - glm::dot(axis, view.origin));
    };
    const glm::vec4 x = row(view.right / glm::dot(view.right, view.right), 0),
                    y = row(view.up / glm::dot(view.up, view.up), 0);
    const glm::vec4 z = view.parallel ? row(-view.forward / unit, 1) : glm::vec4(0, 0, 0, unit);
    const glm::vec4 w = view.parallel ? glm::vec4(0, 0, 0, 1) : row(view.forward, 0);
    return glm::transpose(glm::mat4(x, y, z, w));
}

/// Integers per unit of a lobe: a power of two by which not even all that a light can send, in one
/// cell, exceeds 2^30.
float integersPerUnit(const std::vector<RsmView>& views) {
    float largest = views[0].area() * float(views.size());
    if (!views[0].parallel)
        largest = std::min(largest, 4 * kPi * float((views.size() + 5) / 6));
    const float lobe = 1.1f * largest * views[0].power * kCosineSlope / kPi;
    return lobe > 0 ? std::exp2(std::floor(30 - std::log2(lobe))) : 0;
}

GpuLpvMap constantsOf(const Light& light, const RsmView& view, float unit, float scale,
                      const Lattice& lattice) {
    const float cosOuter = std::cos(light.outerAngle),
                cosInner = std::max(std::cos(light.innerAngle), cosOuter + 1e-4f);
    return {.origin = view.origin,
            .power = view.power,
            .forward = view.forward,
            .texelArea = view.texelArea(),
            .right = view.right,
            .depthUnit = unit,
            .up = view.up,
            .mapSize = view.size,
            .direction = light.direction,
            .kind = std::uint32_t(light.kind),
            .range = light.range,
            .cosOuter = cosOuter,
            .spotScale = 1 / (cosInner - cosOuter),
            .scale = scale,
            .lower = lattice.lower,
            .cell = lattice.cell,
            .size = lattice.size,
            .parallel = view.parallel};
}

} // namespace

GpuLightMaps::GpuLightMaps(gpu::Device& device, Viewport& viewport)
    : m_device(device), m_viewport(viewport),
      m_count(device,
              {.size = sizeof(std::uint32_t),
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               .memory = gpu::MemoryKind::Readback,
               .name = "lit cells"}),
      m_setLayout(gpu::createSetLayout(device, kTypes)),
      m_pool(gpu::createDescriptorPool(device, 1, kTypes)),
      m_set(gpu::allocateSet(device, m_pool, m_setLayout)),
      m_layout(gpu::createPipelineLayout(device, std::array{m_setLayout.handle}, sizeof(GpuLpvMap),
                                         "reflective shadow maps")) {
    const auto pipeline = [&](gpu::Spirv shader, std::uint32_t lists, const char* name) {
        return gpu::createComputePipeline(device, shader, m_layout.handle, std::array{lists}, name);
    };
    m_map = pipeline(kLpvMapComp, 0, "inject map");
    m_countCells = pipeline(kLpvCollectComp, 0, "count lit cells");
    m_listCells = pipeline(kLpvCollectComp, 1, "list lit cells");
}

void GpuLightMaps::makeRoom(const Lattice& lattice) {
    const VkDeviceSize bytes = lattice.cells() * 12 * sizeof(std::int32_t);
    if (m_sums.size == bytes)
        return;
    m_sums = {m_device,
              {.size = bytes,
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               .name = "sums of a map"}};
    m_device.immediate("clear sums", [&](VkCommandBuffer cmd) {
        vkCmdFillBuffer(cmd, m_sums.handle, 0, VK_WHOLE_SIZE, 0);
        gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kComputeWrite);
    });
}

void GpuLightMaps::record(VkCommandBuffer cmd, const gpu::Pipeline& step,
                          const GpuLpvMap& constants) {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, step.handle);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1, &m_set, 0,
                            nullptr);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof constants, &constants);
    ++m_dispatches;
}

void GpuLightMaps::recordMap(VkCommandBuffer cmd, const GpuLpvMap& constants) {
    record(cmd, m_map, constants);
    const std::uint32_t side = gpu::groups(constants.mapSize, LPV_MAP_LANES);
    vkCmdDispatch(cmd, side, side, 1);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kComputeWrite);
}

void GpuLightMaps::recordCollect(VkCommandBuffer cmd, const gpu::Pipeline& step,
                                 const GpuLpvMap& constants) {
    gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kTransferWrite);
    vkCmdFillBuffer(cmd, m_count.handle, 0, VK_WHOLE_SIZE, 0);
    gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite);
    record(cmd, step, constants);
    const glm::uvec3 size = constants.size;
    vkCmdDispatch(cmd, gpu::groups(size.x, LPV_GROUP_X), gpu::groups(size.y, LPV_GROUP_Y),
                  gpu::groups(size.z, LPV_GROUP_Z));
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
}

MappedLight GpuLightMaps::cast(const Light& light, const Bounds& bounds, std::uint32_t size,
                               const Lattice& lattice) {
    std::vector<RsmView> views = rsmViews(light, bounds, size, [&](glm::vec3 p, glm::vec3 normal) {
        return clearOf(p, normal, bounds);
    });
    if (light.kind == LightKind::Rectangle) // sends nothing behind itself
        std::erase_if(views, [&](const RsmView& view) {
            return glm::dot(view.forward, light.direction) < -0.99f;
        });
    MappedLight mapped{.views = std::uint32_t(views.size())};
    const float scale = views.empty() ? 0 : integersPerUnit(views);
    if (!(scale > 0) || !std::isfinite(scale))
        return mapped;
    makeRoom(lattice);
    std::vector<SurfaceMapView> drawn;
    std::vector<GpuLpvMap> constants;
    for (RsmView& view : views) {
        if (glm::dot(glm::cross(view.right, view.up), view.forward) > 0)
            std::swap(view.right, view.up); // the same texels, in another order
        const float unit = depthUnit(view, bounds);
        drawn.push_back({toClip(view, unit)});
        constants.push_back(constantsOf(light, view, unit, scale, lattice));
    }
    m_viewport.drawSurfaceMaps(
        drawn, views[0].size, [&](VkCommandBuffer cmd, const SurfaceMap& map, std::size_t k) {
            if (k == 0) {
                const std::array images = {map.albedo, map.surface, map.depth};
                for (std::uint32_t binding = 0; binding < images.size(); ++binding)
                    gpu::writeTexture(m_device, m_set, binding, images[binding], map.sampler);
                gpu::writeBuffer(m_device, m_set, LPV_MAP_SUMS, kBuffer, m_sums.handle);
                gpu::writeBuffer(m_device, m_set, LPV_MAP_COUNT, kBuffer, m_count.handle);
                // Counting does not write lobes.
                gpu::writeBuffer(m_device, m_set, LPV_MAP_LOBES, kBuffer, m_sums.handle);
                m_mapBytes = map.bytes;
            }
            recordMap(cmd, constants[k]);
            if (k + 1 == views.size())
                recordCollect(cmd, m_countCells, constants[k]);
        });
    mapped.count = *static_cast<const std::uint32_t*>(m_count.mapped);
    if (mapped.count == 0)
        return mapped;
    mapped.cells = {m_device,
                    {.size = mapped.count * sizeof(shared::GpuCellLobe),
                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                     .name = "injected lobes"}};
    gpu::writeBuffer(m_device, m_set, LPV_MAP_LOBES, kBuffer, mapped.cells.handle);
    m_device.immediate("list lit cells", [&](VkCommandBuffer cmd) {
        recordCollect(cmd, m_listCells, constants.back());
    });
    return mapped;
}

} // namespace limn
