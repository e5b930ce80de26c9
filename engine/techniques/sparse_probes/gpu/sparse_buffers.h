// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gpu/buffer.h"
#include "engine/render/gpu_field.h"
#include "engine/techniques/sparse_probes/sparse_gather.h"
#include "shaders/shared/gpu_sparse.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Transport of some receivers, or, where it is compressed, of some clusters: as much as the device
/// can bind at once.
struct SparseBlock {
    std::uint32_t begin = 0, end = 0; ///< receivers or clusters
    gpu::Buffer transport;
};

/// All GPU buffers of sparse probes. shaders/shared/gpu_sparse.h describes their contents.
struct SparseBuffers {
    gpu::Buffer receivers, hits, basis, near, cells; ///< of the bake
    gpu::Buffer direct, albedo, emission, sky;       ///< inputs
    gpu::Buffer irradiance, radiance, probes;        ///< results; 0 at first
    gpu::Buffer change;                              ///< mapped
    std::vector<SparseBlock> blocks;

    VkDeviceSize bytes() const; ///< of all of them
};

/// Number of values in a probe's row of harmonics: that of coefficients, or one more to make it
/// even.
constexpr std::uint32_t probeRow(std::size_t coefficients) {
    return std::uint32_t(coefficients + coefficients % 2);
}

/// Uploads a bake; `lanes` is the size of a group of receivers. `basis`: relightBasis(). Transport
/// that is larger than the device can bind is split into blocks. Fails when any other buffer would
/// be, or the transport of a single cluster, naming both sizes. Throws VulkanError when out of
/// memory.
Result<SparseBuffers> createSparseBuffers(gpu::Device& device, const SparseBake& bake,
                                          const ReceiverPoints& points,
                                          const std::vector<float>& shares,
                                          const std::vector<float>& basis, std::uint32_t lanes);

/// Rows of harmonics as the device reads them: RGB and 0, probeRow() values per probe.
std::vector<glm::vec4> packProbes(const ProbeRadiance& probes, std::size_t coefficients);
/// The inverse of packProbes().
ProbeRadiance unpackProbes(const std::vector<glm::vec4>& rows, std::size_t coefficients);

} // namespace limn
