// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/techniques/illuminance/gpu/viewport_relighter.h"
#include "engine/techniques/illuminance/relight/left_out_space.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"

#include <memory>

namespace limn {

/// A bake lit on the device of a viewport, which shows the light where it was written.
class DeviceIlluminance : public Lighting {
public:
    /// Fails as GpuRelighter::create(). `baked` is the scene that `bake` was made from; the
    /// viewport outlives the object.
    static Result<std::unique_ptr<DeviceIlluminance>> create(gpu::Device& device,
                                                             Viewport& viewport,
                                                             std::shared_ptr<const Bake> bake,
                                                             std::shared_ptr<const Scene> baked);

    /// Precondition: the viewport shows the lights and objects of input.scene.
    LightingReport update(const LightingInput& input, const Progress& progress) override;

    const IndirectField* field() const override { return nullptr; }
    IndirectField readField() const override { return m_relighter->gpu().readField(); }
    std::shared_ptr<const IndirectField> emittedField(const Scene& scene) const override;
    /// Waits for the device.
    std::shared_ptr<const LightSnapshot> snapshot() const override;

private:
    DeviceIlluminance(Viewport& viewport, std::unique_ptr<ViewportRelighter> relighter,
                      std::shared_ptr<const Scene> baked)
        : m_viewport(viewport), m_relighter(std::move(relighter)), m_baked(std::move(baked)) {}

    Viewport& m_viewport;
    std::unique_ptr<ViewportRelighter> m_relighter;
    std::shared_ptr<const Scene> m_baked;
    SeenFrom m_seen;
    LeftOutSpace m_leftOut;
};

/// DeviceIlluminance of data of kIlluminanceTechnique. Fails as GpuRelighter::create().
Result<std::unique_ptr<Lighting>> lightIlluminanceOnDevice(gpu::Device& device, Viewport& viewport,
                                                           const Prepared& prepared);

} // namespace limn
