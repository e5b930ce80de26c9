// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/timestamps.h"
#include "engine/render/gpu_field.h"
#include "engine/render/point_irradiance.h"
#include "engine/techniques/probes/gpu/gpu_marched_maps.h"
#include "engine/techniques/probes/probe_light.h"
#include "shaders/shared/gpu_probes.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace limn {

/// What the probes of a lattice see, lit on the device. Maps are split into blocks of probes, each
/// of which the device can bind. Not thread-safe; the device must outlive the object.
class GpuProbes {
public:
    /// Number of storage buffers bound at once.
    static constexpr std::uint32_t kStorageBuffers = PROBE_BINDINGS;

    /// Creates a lattice of at least one probe that sees nothing. Throws VulkanError when out of
    /// memory.
    GpuProbes(gpu::Device& device, const ProbeGrid& grid, Octahedron map);

    /// Replaces what some probes see; `hits` has the map's texels for each of them, one probe after
    /// the other. The moments are those of all probes. `moved`: places or normals of the hits have
    /// changed, and not only their materials.
    void setHits(std::span<const std::uint32_t> probes, std::span<const shared::GpuProbeHit> hits,
                 bool moved);
    void setMoments(const GridMoments& moments);
    void setSky(const Sky& sky);
    /// GridMoments::smooth. setMoments() keeps it.
    void setSmooth(bool smooth);
    /// Begins to keep maps through which reflections are marched, or ends it. The next project()
    /// and writeField() write the radiance of these maps; setPlanes() writes their surfaces.
    /// Returns true if there are maps now. There are none if the device cannot bind buffers that
    /// large.
    bool setMarched(bool marched);
    /// Those maps; null: none.
    const std::shared_ptr<const GpuMarchedMaps>& marched() const { return m_marched; }
    /// Replaces the planes of some probes in these maps, of which there must be some.
    void setPlanes(const MarchedMaps& maps, std::span<const std::uint32_t> probes);

    /// Lights the hits. Returns whether their light was computed.
    bool updateDirect(const ShadowedLights& lights);

    /// Computes the light of all probes; `bounces`: surfaces also reflect the light of the last
    /// call. Returns the constant harmonic of each probe in xyz, valid until the next call. Waits
    /// for the GPU.
    std::span<const glm::vec4> project(bool bounces);

    /// Writes the light into the field, with values times `scale`. Waits for the GPU.
    void writeField(float scale);
    /// The field for the viewport, without lightmap. setMoments() replaces it by a black one.
    const std::shared_ptr<GpuField>& field() const { return m_field; }

    /// Radiance at the probes. Waits for the GPU.
    std::vector<ProbeHarmonics> readLight() const;

    double directMs = 0, projectMs = 0, fieldMs = 0; ///< GPU time of the last call of each
    std::uint32_t lightsComputed = 0;                ///< by the last updateDirect()
    std::uint64_t dispatches() const;                ///< so far
    VkDeviceSize bytes() const;                      ///< on the GPU, without marchedBytes()
    VkDeviceSize marchedBytes() const { return m_marched ? m_marched->bytes() : 0; }

private:
    /// The maps of probes [begin, end).
    struct Block {
        std::uint32_t begin = 0, end = 0;
        gpu::Buffer hits, direct;
        std::unique_ptr<PointIrradiance> irradiance;
        std::array<VkDescriptorSet, 2> sets{}; ///< by which of m_light is written
    };

    void createBlocks();
    void createSets();
    void writeLevels(VkCommandBuffer cmd);
    void forSets(std::uint32_t binding, VkBuffer buffer);
    shared::GpuProbeRange range(const Block& block, bool bounces) const;
    void dispatch(VkCommandBuffer cmd, const gpu::Pipeline& step, VkDescriptorSet set,
                  const shared::GpuProbeRange& range, std::size_t groups);

    gpu::Device& m_device;
    ProbeGrid m_grid;
    Octahedron m_map;
    std::vector<Block> m_blocks;
    gpu::Buffer m_sky, m_basis, m_means;
    std::array<gpu::Buffer, 2> m_light; ///< of the last two bounces
    std::uint32_t m_written = 1;        ///< the newer one of them
    std::shared_ptr<const gpu::Buffer> m_moments;
    std::shared_ptr<const GpuMarchedMaps> m_marched; ///< null: none
    std::shared_ptr<GpuField> m_field;
    bool m_smooth = false;

    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_project, m_writeField, m_writeLevel;
    gpu::Timestamps m_times;
    std::uint64_t m_dispatches = 0; ///< without those of the blocks' irradiance
};

} // namespace limn
