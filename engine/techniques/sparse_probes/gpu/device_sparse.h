// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/timestamps.h"
#include "engine/lighting/convergence.h"
#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/render/point_irradiance.h"
#include "engine/render/viewport.h"
#include "engine/techniques/sparse_probes/gpu/sparse_steps.h"
#include "engine/techniques/sparse_probes/receiver_light.h"

#include <memory>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A SparseBake lit on the device of a viewport, which shows the light where it was written.
/// Receivers are lit by the shadow maps that the viewport draws; otherwise the light equals
/// SparseLighting's up to the rounding of 32-bit sums in another order. The same device gives the
/// same bits for the same inputs. Only materials and a sky that changed pass through the CPU.
class DeviceSparse : public Lighting {
public:
    /// Uploads the bake, which was made from `scene`. Fails if the device has too few bindings or
    /// if a part of the bake is larger than it can bind; the message names the sizes. Throws
    /// VulkanError when out of memory. Device and viewport must outlive the object.
    static Result<std::unique_ptr<DeviceSparse>> create(gpu::Device& device, Viewport& viewport,
                                                        std::shared_ptr<const SparseBake> bake,
                                                        const Scene& scene);

    /// Precondition: the viewport shows the lights and objects of input.scene. Waits for the GPU.
    LightingReport update(const LightingInput& input, const Progress& progress) override;
    const IndirectField* field() const override { return nullptr; }
    IndirectField readField() const override;
    /// Waits for the GPU.
    std::shared_ptr<const LightSnapshot> snapshot() const override;

    /// Bounced light, per receiver [W m^-2]. For tests. Waits for the GPU.
    std::vector<glm::vec3> readIrradiance() const;

private:
    /// What an update took [ms] and did.
    struct Work {
        double upload = 0, radiosity = 0, probes = 0, receivers = 0, field = 0;
        std::uint64_t dispatches = 0;
        std::uint32_t bounces = 0;
    };

    DeviceSparse(gpu::Device& device, Viewport& viewport, std::shared_ptr<const SparseBake> bake,
                 const Scene& scene, SparseBuffers buffers, std::vector<glm::vec3> directions,
                 std::vector<float> basis);

    bool uploadInputs(const Scene& scene, Work& work);
    void followScene(const Scene& scene, Work& work);
    void setGrid(bool grid);
    RoundChange bounce(Work& work);
    void writeField(Work& work);
    std::uint64_t dispatches() const { return m_steps.dispatches + m_direct.dispatches; }
    LightingReport report(const Work& work, double totalMs, bool skipped) const;

    gpu::Device& m_device;
    Viewport& m_viewport;
    std::shared_ptr<const SparseBake> m_bake;
    SparseBuffers m_buffers;
    SparseSteps m_steps;
    PointIrradiance m_direct;
    gpu::Timestamps m_times;
    double m_area = 0; ///< of all receivers [m^2]
    std::vector<glm::vec3> m_directions;
    std::vector<float> m_basis;

    ReceiverMaterials m_materials;
    Sky m_sky;
    float m_brightestSky = 0, m_brightest = 0; ///< radiance [W m^-2 sr^-1]
    Convergence m_convergence;
    bool m_started = false, m_clampParts = false;
    std::shared_ptr<GpuField> m_field;
    bool m_fieldWritten = false; ///< since it was created
};

/// DeviceSparse of data of kSparseProbesTechnique. Fails as DeviceSparse::create().
Result<std::unique_ptr<Lighting>> lightSparseOnDevice(gpu::Device& device, Viewport& viewport,
                                                      const Prepared& prepared);

} // namespace limn
