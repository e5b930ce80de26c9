// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/render/viewport.h"
#include "engine/techniques/illuminance/gpu/gpu_relight.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <memory>

namespace limn {

/// The live runtime on the viewport's device: surfels are lit by the shadow maps that the viewport
/// draws, and it samples the field where that was written. Nothing passes through the CPU but
/// materials that changed. One thread uses it and the viewport; the device outlives it.
class ViewportRelighter {
public:
    /// Uploads the bake. Fails as GpuRelighter::create().
    static Result<std::unique_ptr<ViewportRelighter>> create(gpu::Device& device,
                                                             std::shared_ptr<const Bake> bake);

    /// Brings the bounced light of `viewport` up to date with the lights and the objects it shows,
    /// and with the materials and the sky of `scene`, whose instances are those of the bake; as
    /// Relighter::relight(). Call after setScene() and setLighting(). Waits for the GPU.
    /// directMs: shadow maps and lights onto the surfels. surfelReadMs is part of surfelLightMs.
    /// Steps are in the GPU's time, totalMs is from call to return. No ray is traced.
    RelightStats relight(Viewport& viewport, const Scene& scene, std::uint32_t bounces,
                         const Progress& progress = {}, const CacheFlags* seen = nullptr);

    const GpuRelighter& gpu() const { return *m_gpu; }

private:
    explicit ViewportRelighter(std::unique_ptr<GpuRelighter> gpu) : m_gpu(std::move(gpu)) {}

    std::unique_ptr<GpuRelighter> m_gpu;
    std::vector<Material> m_materials; ///< that albedo and emitted belong to
    std::vector<glm::vec3> m_albedo, m_emitted;
};

} // namespace limn
