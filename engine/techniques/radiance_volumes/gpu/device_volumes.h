// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/render/viewport.h"
#include "engine/techniques/radiance_volumes/gpu/gpu_allocation.h"
#include "engine/techniques/radiance_volumes/gpu/gpu_area_lights.h"
#include "engine/techniques/radiance_volumes/gpu/gpu_cache_light.h"
#include "engine/techniques/radiance_volumes/gpu/volume_pass.h"
#include "engine/techniques/radiance_volumes/lit_volume.h"
#include "engine/techniques/radiance_volumes/volume_report.h"

#include <memory>
#include <optional>
#include <vector>

namespace limn {

/// Radiance volumes on the device of a viewport, which draws the maps of lights and of the camera,
/// and shows the light where it was written. Voxels and the numbers of caches are the CPU's.
class DeviceVolumes : public Lighting {
public:
    /// Both outlive the object.
    DeviceVolumes(gpu::Device& device, Viewport& viewport);

    /// Precondition: the viewport shows the objects and materials of input.scene. Traces no ray.
    LightingReport update(const LightingInput& input, const Progress& progress) override;

    const IndirectField* field() const override { return nullptr; }
    IndirectField readField() const override;
    bool isOfView() const override { return true; }
    /// Waits for the device. Area lights and voxels are those of the CPU, for which this traces
    /// rays where a light or an object has moved.
    std::shared_ptr<const LightSnapshot> snapshot() const override;

private:
    struct Cost : VolumeCost {
        std::uint64_t views = 0, dispatches = 0;
    };

    bool relight(const Scene& scene, const VolumeInputs& now, const Progress& progress, Cost& cost);
    bool castMaps(const Scene& scene, const VolumeInputs& now, const Progress& progress,
                  Cost& cost);
    void placeCaches(const Scene& scene, const VolumeInputs& now);
    const GpuAreaLights* lightsOf(const Light& shape) const;
    std::shared_ptr<const VolumePart> readPart() const;
    std::uint64_t dispatches() const {
        return m_maps.dispatches() + m_allocation.dispatches() + m_light.dispatches();
    }
    void describe(const Cost& cost, LightingReport& report) const;

    gpu::Device& m_device;
    Viewport& m_viewport;
    GpuAreaLightMaps m_maps;
    GpuAllocation m_allocation;
    GpuCacheLight m_light;
    ShownVoxels m_voxels;                ///< none where the device cannot bind them
    std::vector<GpuAreaLights> m_lights; ///< each shape once
    std::shared_ptr<const CacheAllocation> m_caches;
    std::shared_ptr<const gpu::Buffer> m_address; ///< of m_caches
    std::shared_ptr<const GpuVolume> m_volume;
    std::optional<GlossyMapShape> m_glossy; ///< of m_volume
    glm::vec3 m_eye{0};                     ///< of its maps
    std::shared_ptr<VolumePass> m_pass;
    std::optional<VolumeInputs> m_followed; ///< of what is kept
    std::optional<VolumeInputs> m_inputs;   ///< of the light; none before the first update
    Scene m_scene;                          ///< of m_inputs
    mutable VolumeSources m_onCpu;          ///< for overlays
    const char* m_lacks = nullptr;
};

/// DeviceVolumes for the table of techniques.
Result<std::unique_ptr<Lighting>> lightVolumesOnDevice(gpu::Device& device, Viewport& viewport,
                                                       const Prepared& prepared);

} // namespace limn
