// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <memory>

namespace limn::render {

/// NearGeometry of the scene on the device: descriptor set 1 of near.frag. It is made when a
/// picture first needs it.
class NearSurfaces {
public:
    explicit NearSurfaces(gpu::Device& device);

    /// Copies the scene for prepare(), unless `version` is that of the last call.
    void take(const Scene& scene, std::shared_ptr<const LightmapLayout> layout,
              std::uint64_t version);

    /// Uploads the geometry of the last scene taken, unless that is already there.
    void prepare();

    /// Whether there are any surfaces that fit the device's limits.
    bool any() const { return m_any; }

    VkDescriptorSetLayout layout() const { return m_setLayout.handle; }
    VkDescriptorSet set() const { return m_set; }

private:
    gpu::Device& m_device;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::Buffer m_nodeBuffer, m_triangleBuffer;
    bool m_any = false;
    Scene m_scene;
    std::shared_ptr<const LightmapLayout> m_lightmap;
    std::uint64_t m_version = ~std::uint64_t(0);
    bool m_stale = false;
};

} // namespace limn::render
