// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/render/viewport.h"
#include "engine/techniques/photon_lattices/gpu/gpu_bounces.h"
#include "engine/techniques/photon_lattices/live_photons.h"

#include <memory>

namespace limn {

/// Photon lattices on the device of a viewport, which draws the lights' maps, makes the first
/// bounces, and shows the lattices by a pass of its own. Photons are traced and summed on the CPU.
/// The viewport outlives the object.
class DevicePhotons : public Lighting {
public:
    DevicePhotons(gpu::Device& device, Viewport& viewport)
        : m_device(device), m_viewport(viewport), m_bounces(device, viewport) {}

    /// Precondition: the viewport shows the objects and materials of input.scene.
    LightingReport update(const LightingInput& input, const Progress& progress) override;

    const IndirectField* field() const override { return nullptr; } // the viewport has it already
    IndirectField readField() const override { return m_live.field(); }
    std::shared_ptr<const LightSnapshot> snapshot() const override { return m_live.snapshot(); }

private:
    const TraceScene& traceOf(const LightingInput& input);
    PhotonMap traceLight(const LightingInput& input, const Light& light,
                         const PathSettings& settings, const Progress& progress);

    gpu::Device& m_device;
    Viewport& m_viewport;
    GpuBounces m_bounces;
    LivePhotons m_live;
    std::shared_ptr<LightPass> m_pass;         ///< of m_shown
    std::uint64_t m_shown = ~std::uint64_t(0); ///< IndirectField::version that was uploaded
    std::unique_ptr<TraceScene> m_trace;       ///< where an update brings none
};

/// DevicePhotons for the table of techniques.
Result<std::unique_ptr<Lighting>> lightPhotonsOnDevice(gpu::Device& device, Viewport& viewport,
                                                       const Prepared& prepared);

} // namespace limn
