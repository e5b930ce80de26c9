// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/viewport_relighter.h"

#include "engine/field/grid_placement.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"

#include <chrono>

namespace limn {

Result<std::unique_ptr<ViewportRelighter>>
ViewportRelighter::create(gpu::Device& device, std::shared_ptr<const Bake> bake) {
    auto gpu = GpuRelighter::create(device, std::move(bake));
    if (!gpu)
        return tl::make_unexpected(gpu.error());
    return std::unique_ptr<ViewportRelighter>(new ViewportRelighter(std::move(*gpu)));
}

RelightStats ViewportRelighter::relight(Viewport& viewport, const Scene& scene,
                                        std::uint32_t bounces, const Progress& progress,
                                        const CacheFlags* seen) {
    const auto start = std::chrono::steady_clock::now();
    const Bake& bake = *m_gpu->bake();
    if (m_albedo.size() != bake.surfels.size() || m_materials != scene.materials) {
        surfelMaterials(bake.surfels, scene, m_albedo, m_emitted, m_materials);
        m_materials = scene.materials;
    }
    const std::vector<glm::vec3> sky = skyRadiosity(bake.tree, scene.sky);
    const ShadowedLights lights = viewport.shadowedLights();
    const auto maxBands = int(bake.settings.bands);
    const auto bands = std::uint32_t(receiverBands(scene, maxBands));
    const GpuRelightStats g = m_gpu->relight({.direct = {},
                                              .albedo = m_albedo,
                                              .emitted = m_emitted,
                                              .sky = sky,
                                              .lights = &lights,
                                              .bands = bands,
                                              .settings = scene.relight,
                                              .grid = needsGrid(scene, bake.lightmap),
                                              .occluders = &scene},
                                             bounces, progress, seen);
    viewport.setIndirect(m_gpu->field());
    const ViewportStats& drawn = viewport.stats();
    RelightStats stats = g;
    stats.directMs += g.uploadMs + drawn.relightShadowMs;
    stats.bandsLit = bands;
    stats.bandsSkipped = std::uint32_t(maxBands) - bands;
    stats.lightsOff = drawn.lightsOff;
    const std::chrono::duration<double, std::milli> total =
        std::chrono::steady_clock::now() - start;
    stats.totalMs = total.count();
    return stats;
}

} // namespace limn
