// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/render/viewport.h"
#include "engine/techniques/lpv/gpu/gpu_light_maps.h"
#include "engine/techniques/lpv/gpu/gpu_propagation.h"
#include "engine/techniques/lpv/lattice_sources.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace limn {

/// Light propagation volumes on the device of a viewport, which draws the lights' maps and shows
/// the light where it was written. Emitters and the geometry volume are the CPU's; they are sent
/// when they change.
class DeviceLpv : public Lighting {
public:
    /// Fails as GpuPropagation::create(). The viewport outlives the object.
    static Result<std::unique_ptr<DeviceLpv>> create(gpu::Device& device, Viewport& viewport);

    /// Precondition: the viewport shows the objects and materials of input.scene. Traces no ray.
    LightingReport update(const LightingInput& input, const Progress& progress) override;

    const IndirectField* field() const override { return nullptr; }
    IndirectField readField() const override { return m_gpu->readField(); }
    /// Waits for the device. What is injected, and the texels of maps, are those of the CPU, for
    /// which this traces rays where a light or an object has moved.
    std::shared_ptr<const LightSnapshot> snapshot() const override;

    const GpuPropagation& gpu() const { return *m_gpu; }

private:
    struct Cost : LpvSourceCost, GpuPropagationCost {
        double uploadMs = 0;
        std::uint64_t rounds = 0, views = 0, mapDispatches = 0, bytesUploaded = 0;
    };

    /// A light of which there is a map.
    struct Kept {
        Light shape; ///< unitLight()
        GpuLobes lobes;
    };

    DeviceLpv(gpu::Device& device, Viewport& viewport, std::unique_ptr<GpuPropagation> gpu)
        : m_viewport(viewport), m_gpu(std::move(gpu)), m_maps(device, viewport),
          m_sources(std::make_unique<LatticeSources>()) {}
    bool relight(const Scene& scene, const LpvInputs& now, const Progress& progress, Cost& cost);
    void upload(Cost& cost);
    bool castMaps(const Scene& scene, const LpvInputs& now, const Progress& progress, Cost& cost);
    const GpuLobes* lobesOf(const Light& shape) const;
    void describe(const Cost& cost, LightingReport& report) const;

    Viewport& m_viewport;
    std::unique_ptr<GpuPropagation> m_gpu;
    GpuLightMaps m_maps;
    std::unique_ptr<LatticeSources> m_sources; ///< its lights are for overlays
    std::optional<LpvInputs> m_inputs;         ///< of the field; none before the first update
    Scene m_scene;                             ///< of m_inputs
    std::uint64_t m_surfacesSent = 0, m_emittersSent = 0; ///< versions in m_sources
    GpuLobes m_emitters;
    std::vector<Kept> m_lights; ///< each shape once
};

/// DeviceLpv for the table of techniques. Fails as GpuPropagation::create().
Result<std::unique_ptr<Lighting>> lightLpvOnDevice(gpu::Device& device, Viewport& viewport,
                                                   const Prepared& prepared);

} // namespace limn
