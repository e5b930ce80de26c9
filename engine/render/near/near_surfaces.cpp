// SPDX-License-Identifier: MIT
#include "engine/render/near/near_surfaces.h"

#include "engine/core/log.h"
#include "engine/gpu/uploader.h"
#include "engine/render/near/near_geometry.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace limn::render {

static constexpr std::array kTypes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                      VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

NearSurfaces::NearSurfaces(gpu::Device& device)
    : m_device(device), m_setLayout(gpu::createSetLayout(device, kTypes)) {}

void NearSurfaces::take(const Scene& scene, std::shared_ptr<const LightmapLayout> layout,
                        std::uint64_t version) {
    if (version == m_version)
        return;
    m_scene = scene;
    m_lightmap = std::move(layout);
    m_version = version;
    m_stale = true;
}

void NearSurfaces::prepare() {
    if (!m_stale)
        return;
    m_stale = m_any = false;
    if (!m_lightmap)
        return;
    const auto refuse = [](const std::string& why) {
        logWarning(why + ": light from near surfaces is as the lightmap has it");
    };
    const auto bound = m_device.checkStorageBuffers(gpu::kStorageBuffers + kTypes.size());
    if (!bound)
        return refuse(bound.error().message);
    const NearGeometry geometry = nearGeometry(m_scene, *m_lightmap);
    if (geometry.nodes.empty())
        return;
    const auto nodes = std::as_bytes(std::span(geometry.nodes)),
               triangles = std::as_bytes(std::span(geometry.triangles));
    const std::size_t maxBytes = m_device.properties.limits.maxStorageBufferRange;
    if (std::max(nodes.size(), triangles.size()) > maxBytes)
        return refuse(fmt::format("{} triangles are more than this device can bind",
                                  geometry.triangles.size()));
    gpu::Uploader uploader(m_device);
    m_nodeBuffer = uploader.buffer(nodes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "near nodes");
    m_triangleBuffer =
        uploader.buffer(triangles, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "near triangles");
    uploader.flush();
    m_pool = gpu::createDescriptorPool(m_device, 1, kTypes); // frames in flight use the old one
    m_set = gpu::allocateSet(m_device, m_pool, m_setLayout);
    gpu::writeBuffer(m_device, m_set, 0, kTypes[0], m_nodeBuffer.handle);
    gpu::writeBuffer(m_device, m_set, 1, kTypes[1], m_triangleBuffer.handle);
    m_any = true;
}

} // namespace limn::render
