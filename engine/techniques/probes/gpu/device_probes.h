// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/render/viewport.h"
#include "engine/techniques/probes/gpu/gpu_probes.h"
#include "engine/techniques/probes/marched_maps.h"
#include "engine/techniques/probes/probe_inputs.h"

#include <memory>
#include <vector>

namespace limn {

/// Light field probes on the device of a viewport, which shows the light where it was written. The
/// maps are traced on the CPU; what they show is lit by the viewport's shadow maps. Each update
/// lights all probes, and while somebody looks it traces the maps of a few of them, in turn, if
/// surfaces moved. Where the document asks for it, reflections of glossy surfaces are marched. The
/// same device gives the same bits for the same inputs.
class DeviceProbes : public Lighting {
public:
    /// Fails if the device has too few bindings. Device and viewport must outlive the object.
    static Result<std::unique_ptr<DeviceProbes>> create(gpu::Device& device, Viewport& viewport);

    /// Precondition: the viewport shows the lights and objects of input.scene. Where maps are to be
    /// traced, builds a trace scene and keeps it until surfaces move. Throws VulkanError when out
    /// of memory.
    LightingReport update(const LightingInput& input, const Progress& progress) override;
    const IndirectField* field() const override { return nullptr; }
    IndirectField readField() const override;
    /// Waits for the GPU.
    std::shared_ptr<const LightSnapshot> snapshot() const override;

    /// Null before the first update and without a probe.
    const GpuProbes* gpu() const { return m_gpu.get(); }
    const ProbeMaps& maps() const { return m_maps; }

private:
    /// What an update took [ms] and did.
    struct Work {
        double maps = 0, light = 0, field = 0;
        std::uint64_t rays = 0, dispatches = 0;
        std::uint32_t refreshed = 0, bounces = 0;
    };

    DeviceProbes(gpu::Device& device, Viewport& viewport)
        : m_device(device), m_viewport(viewport) {}

    bool followScene(const Scene& scene, const ProbeSettings& settings);
    std::vector<std::uint32_t> traceMaps(const Scene& scene, std::uint32_t maxProbes,
                                         const Progress& progress, Work& work);
    void sendHits(const Scene& scene, const std::vector<std::uint32_t>& probes, bool moved);
    void followReflections(bool wanted);
    void sendPlanes(const Scene& scene, std::span<const std::uint32_t> probes);
    bool bounce(const Scene& scene, Work& work);
    std::uint32_t countStale() const;
    LightingReport report(const Work& work, double totalMs) const;

    gpu::Device& m_device;
    Viewport& m_viewport;
    ProbeInputs m_inputs; ///< that the editions stand for
    ProbeMaps m_maps;
    std::vector<float> m_solidAngles;
    std::unique_ptr<GpuProbes> m_gpu;
    std::unique_ptr<TraceScene> m_trace;    ///< of the surfaces of m_mapEdition; null: not built
    std::uint32_t m_mapEdition = 0;         ///< of the surfaces
    std::vector<std::uint32_t> m_probeMaps; ///< per probe: edition of its map; 0: none
    std::vector<std::uint32_t>
        m_refreshedBy;             ///< per probe: the update that traced its map; 0: none
    std::uint32_t m_updates = 0;   ///< that traced any map
    std::uint32_t m_next = 0;      ///< probe to be looked at first
    bool m_materialsStale = false; ///< on the device
    bool m_lightStale = false;     ///< the probes' light is of older inputs
    MarchedMaps m_planes;          ///< without radiance; of no probe: nothing is marched
    bool m_planesStale = false;    ///< of probes whose maps are current, on the device
    std::shared_ptr<LightPass> m_reflections; ///< of the marched maps; null: there are none
    bool m_lacksReflections = false;          ///< which the document asks for
    bool m_bouncing = false;                  ///< light bounces more than once
    double m_before = 0;                      ///< sum of the mean radiance when a bounce began
    float m_brightest = 0;                    ///< of the means [W m^-2 sr^-1]
};

/// DeviceProbes for the table of techniques. Fails as DeviceProbes::create().
Result<std::unique_ptr<Lighting>> lightProbesOnDevice(gpu::Device& device, Viewport& viewport,
                                                      const Prepared& prepared);

} // namespace limn
