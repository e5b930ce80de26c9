// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/field/indirect_field.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/timestamps.h"
#include "engine/lattice/lattice.h"
#include "engine/render/gpu_field.h"
#include "engine/techniques/lpv/injected_lights.h"
#include "engine/techniques/lpv/propagation.h"
#include "shaders/shared/gpu_lpv.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace limn {

/// What a light of colour 1 sends into cells, on the device.
struct GpuLobes {
    gpu::Buffer cells; ///< array of shared::GpuCellLobe; empty where there are none
    gpu::DescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
    std::uint32_t count = 0;
};

/// Lobes that a device injects, and the colour of their light.
struct GpuSource {
    const GpuLobes* lobes;
    glm::vec3 colour;
};

/// GPU time of the steps [ms] and number of dispatches of one GpuPropagation::light().
struct GpuPropagationCost {
    double injectionMs = 0, propagationMs = 0, fieldMs = 0;
    std::uint64_t dispatches = 0;
};

/// Injection, propagation and the field as Vulkan compute shaders. The light equals propagate()'s
/// up to the rounding of 32-bit sums in another order, and the field's to halfs. It has the same
/// bits whenever the same device gets the same inputs. Not thread-safe; the device must outlive the
/// object.
class GpuPropagation {
public:
    /// Fails if the device has too few bindings.
    static Result<std::unique_ptr<GpuPropagation>> create(gpu::Device& device);

    /// Sets the lattice, of at most 128 cells a side, and what blocks light in it. Lobes for other
    /// lattices must no longer be used. Returns the number of bytes sent.
    std::uint64_t setLattice(const Lattice& lattice, const FaceBlockers& blockers);

    /// Uploads what a light sends into the cells of the last setLattice().
    GpuLobes upload(std::span<const InjectedInstance> parts);
    /// Makes lobes of an array of `count` shared::GpuCellLobe, no cell of which is in it twice. An
    /// empty buffer makes none.
    GpuLobes lobesOf(gpu::Buffer cells, std::uint32_t count);

    /// Adds up the sources, propagates them and writes the field. 0 rounds: the field is black.
    /// `factors`: as by fieldFactors(). Waits for the device. Returns false if cancelled; the field
    /// is then as before.
    bool light(std::span<const GpuSource> sources, std::uint32_t rounds,
               std::array<float, 2> factors, const Progress& progress, GpuPropagationCost& cost);

    /// The field for the viewport; null before the first light(). Each light() rewrites it, after
    /// the frames that were submitted before, or replaces it. It may outlive this object.
    const std::shared_ptr<GpuField>& field() const { return m_field; }

    // Read-back, for tests and for what needs the numbers on the CPU. Each waits for the device and
    // needs a light() before.
    std::vector<Lobe> readSum() const; ///< leaves each cell, over all rounds [W sr^-1]
    IndirectField readField() const;   ///< field(), without what rounding to halfs took

    std::uint64_t bytes() const; ///< of volumes and field, without lobes

private:
    explicit GpuPropagation(gpu::Device& device);
    void createSets();
    void writeSets();
    void makeField();
    void bind(VkCommandBuffer cmd, const gpu::Pipeline& step, std::size_t set);
    void dispatchCells(VkCommandBuffer cmd, const gpu::Pipeline& step,
                       const shared::GpuLpvStep& constants, std::size_t set = 0);
    void recordInjection(VkCommandBuffer cmd, std::span<const GpuSource> sources, bool dark);
    void recordField(VkCommandBuffer cmd, std::array<float, 2> factors);

    gpu::Device& m_device;
    Lattice m_lattice;
    /// As gpu_lpv.h describes them. Light goes to and fro between the first two.
    std::array<gpu::Buffer, 2> m_light;
    gpu::Buffer m_sum, m_blockers;
    gpu::Buffer m_brightest; ///< mapped
    std::shared_ptr<GpuField> m_field;
    gpu::DescriptorSetLayout m_setLayout, m_lobesLayout;
    gpu::DescriptorPool m_pool;
    std::array<VkDescriptorSet, 2> m_sets{}; ///< from the first volume to the second, and back
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_inject, m_propagate, m_findBrightest, m_writeField;
    gpu::Timestamps m_times;
    std::uint64_t m_dispatches = 0; ///< recorded so far
};

} // namespace limn
