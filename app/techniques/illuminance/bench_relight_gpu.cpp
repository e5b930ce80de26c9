// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_relight_gpu.h"

#include "engine/field/grid_placement.h"
#include "engine/gpu/device.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/techniques/illuminance/gpu/gpu_relight.h"
#include "engine/techniques/illuminance/relight/surfel_light.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"

#include <chrono>

namespace limn {

Result<GpuRuns> relightOnGpu(const std::string& device, const TraceScene& trace,
                             const std::shared_ptr<const Bake>& bake, LitBands wanted,
                             std::uint32_t bounces, int runs,
                             const std::function<Scene(int k)>& sceneAt) {
    const auto made = gpu::createDevice({.name = device});
    if (!made)
        return tl::make_unexpected(made.error());
    const auto relighter = GpuRelighter::create(**made, bake);
    if (!relighter)
        return tl::make_unexpected(relighter.error());
    GpuRuns result{(*made)->properties.deviceName, {}};
    const Scene scene = sceneAt(0);
    const std::vector<glm::vec3> sky = skyRadiosity(bake->tree, scene.sky);
    const auto maxBands = int(bake->settings.bands);
    const auto bands =
        std::uint32_t(wanted == LitBands::All ? maxBands : receiverBands(scene, maxBands));
    DirectIrradiance light;
    std::vector<glm::vec3> albedo, emitted;
    surfelMaterials(bake->surfels, scene, albedo, emitted);
    for (int k = 0; k <= runs; ++k) {
        const Scene lit = sceneAt(k);
        const TraceScene moved(lit, trace);
        const auto start = std::chrono::steady_clock::now();
        updateDirectIrradiance(bake->surfels, lit, moved, light);
        const std::chrono::duration<double, std::milli> traced =
            std::chrono::steady_clock::now() - start;
        const GpuRelightStats g = (*relighter)
                                      ->relight({.direct = light.irradiance,
                                                 .albedo = albedo,
                                                 .emitted = emitted,
                                                 .sky = sky,
                                                 .bands = bands,
                                                 .settings = lit.relight,
                                                 .grid = needsGrid(lit, bake->lightmap),
                                                 .occluders = &lit},
                                                bounces);
        RelightStats r = g;
        r.directMs = traced.count() + g.uploadMs;
        r.totalMs += traced.count();
        r.bandsLit = bands;
        r.bandsSkipped = bake->settings.bands - bands;
        r.shadowRays = light.raysTraced;
        if (k > 0) // the first uploads everything
            result.runs.push_back(r);
    }
    return result;
}

} // namespace limn
