// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/light_pass.h"
#include "engine/render/viewport.h"
#include "engine/techniques/light_skin/skin_part.h"

#include <memory>

namespace limn {

/// Light caches of a scene with their lists, as skin_light.frag reads them.
struct GpuSkin {
    gpu::Buffer caches, lists, cubes, instances;

    std::uint64_t bytes() const { return caches.size + lists.size + cubes.size + instances.size; }
};
std::shared_ptr<const GpuSkin> uploadSkin(gpu::Device& device, const LightCaches& caches);

/// Draws the light that a SkinPart holds. Lists are always those of cubes: surface images do not
/// tell triangles.
class SkinPass : public LightPass {
public:
    /// `proxies`: an array of shared::GpuSkinProxies, one of each cache. Neither pointer is null.
    /// `glossy`: they hold glossy light for the eye of the pictures. Device and viewport outlive
    /// the object.
    SkinPass(gpu::Device& device, Viewport& viewport, std::shared_ptr<const GpuSkin> skin,
             std::shared_ptr<const gpu::Buffer> proxies, bool glossy);

    void record(const LightPassFrame& frame) override;
    std::uint64_t bytes() const override { return m_skin->bytes() + m_proxies->size; }

private:
    std::shared_ptr<const GpuSkin> m_skin;
    std::shared_ptr<const gpu::Buffer> m_proxies;
    LightPassSet m_set;
};

/// The proxies of a part.
gpu::Buffer uploadProxies(gpu::Device& device, const SkinPart::Light& light);

/// The pass for a field with a SkinPart, which it uploads.
std::shared_ptr<LightPass> uploadSkinPart(gpu::Device& device, Viewport& viewport,
                                          const IndirectField& field);

} // namespace limn
