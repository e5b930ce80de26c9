// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/device_illuminance.h"

#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/illuminance_snapshot.h"
#include "engine/techniques/illuminance/relight/emitted_field.h"
#include "engine/techniques/illuminance/relight/relight_report.h"

namespace limn {

Result<std::unique_ptr<DeviceIlluminance>>
DeviceIlluminance::create(gpu::Device& device, Viewport& viewport, std::shared_ptr<const Bake> bake,
                          std::shared_ptr<const Scene> baked) {
    auto relighter = ViewportRelighter::create(device, std::move(bake));
    if (!relighter)
        return tl::make_unexpected(relighter.error());
    return std::unique_ptr<DeviceIlluminance>(
        new DeviceIlluminance(viewport, std::move(*relighter), std::move(baked)));
}

LightingReport DeviceIlluminance::update(const LightingInput& input, const Progress& progress) {
    const Bake& bake = *m_relighter->gpu().bake();
    const CacheFlags* seen = input.view ? &seenFrom(m_seen, *m_baked, bake, *input.view) : nullptr;
    LightingReport report =
        reportOf(m_relighter->relight(m_viewport, input.scene, input.bounces, progress, seen));
    report.lacks = m_leftOut.lackOf(bake, *m_baked, input.scene);
    return report;
}

std::shared_ptr<const IndirectField> DeviceIlluminance::emittedField(const Scene& scene) const {
    return std::make_shared<const IndirectField>(
        limn::emittedField(m_relighter->gpu().bake(), scene));
}

std::shared_ptr<const LightSnapshot> DeviceIlluminance::snapshot() const {
    const GpuRelighter& gpu = m_relighter->gpu();
    LitBake lit;
    for (const glm::vec3 b : gpu.readRadiosity())
        lit.radiosity.emplace_back(b, 0);
    lit.cacheSh = gpu.readCacheSh();
    lit.bands = int(gpu.field()->bands);
    return std::make_shared<const IlluminanceSnapshot>(std::move(lit));
}

Result<std::unique_ptr<Lighting>> lightIlluminanceOnDevice(gpu::Device& device, Viewport& viewport,
                                                           const Prepared& prepared) {
    return DeviceIlluminance::create(device, viewport, bakeOf(*prepared.data), prepared.scene);
}

} // namespace limn
