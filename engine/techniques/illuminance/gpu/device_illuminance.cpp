// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/device_illuminance.h"

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
    return reportOf(m_relighter->relight(m_viewport, input.scene, input.bounces, progress, seen));
}

} // namespace limn
