// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/render/light_pass.h"
#include "engine/render/viewport.h"
#include "engine/techniques/probes/gpu/gpu_marched_maps.h"

#include <memory>

namespace limn {

/// Draws what glossy surfaces reflect of what probes see, as MarchedPart finds it. The picture's
/// field has the grid of these probes.
class MarchedPass : public LightPass {
public:
    /// `maps` may change later; must not be null. Device and viewport outlive the object.
    MarchedPass(gpu::Device& device, Viewport& viewport,
                std::shared_ptr<const GpuMarchedMaps> maps);

    void record(const LightPassFrame& frame) override;
    bool reflects() const override { return true; }
    std::uint64_t bytes() const override { return m_maps->bytes(); }

private:
    std::shared_ptr<const GpuMarchedMaps> m_maps;
    LightPassSet m_set;
};

/// The pass for a field with a MarchedPart, which it uploads. Null, after a warning, if the device
/// cannot bind the maps.
std::shared_ptr<LightPass> uploadMarchedPart(gpu::Device& device, Viewport& viewport,
                                             const IndirectField& field);

} // namespace limn
