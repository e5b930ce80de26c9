// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/render/viewport.h"
#include "engine/techniques/illuminance/gpu/gpu_relight.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <memory>

namespace limn {

/// Relights a bake on the viewport's device, at run time. Surfels are lit by the shadow maps that
/// the viewport draws, and the viewport samples the field where it was written. Only materials that
/// changed pass through the CPU. One thread uses it and the viewport; the device must outlive the
/// object.
class ViewportRelighter {
public:
    /// Uploads the bake. Fails as GpuRelighter::create() does.
    static Result<std::unique_ptr<ViewportRelighter>> create(gpu::Device& device,
                                                             std::shared_ptr<const Bake> bake);

    /// Brings the bounced light of `viewport` up to date with the lights and the objects it shows,
    /// and with the materials and the sky of `scene`, whose instances are those of the bake; as
    /// Relighter::relight(). Call after setScene() and setLighting(). Waits for the GPU. directMs
    /// covers shadow maps and lights onto the surfels, and surfelLightMs includes surfelReadMs.
    /// Steps are measured in GPU time, totalMs from call to return. No ray is traced.
    RelightStats relight(Viewport& viewport, const Scene& scene, std::uint32_t bounces,
                         const Progress& progress = {}, const CacheFlags* seen = nullptr);

    const GpuRelighter& gpu() const { return *m_gpu; }

private:
    explicit ViewportRelighter(std::unique_ptr<GpuRelighter> gpu) : m_gpu(std::move(gpu)) {}

    std::unique_ptr<GpuRelighter> m_gpu;
    std::vector<Material> m_materials; ///< the materials of m_albedo and m_emitted
    std::vector<glm::vec3> m_albedo, m_emitted;
};

} // namespace limn
