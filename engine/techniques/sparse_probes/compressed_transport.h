// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/sparse_probes/receivers.h"
#include "engine/techniques/sparse_probes/transport.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Transport of clusters of receivers, each a product of two matrices: T = L R, with one row of L
/// per receiver and one column of R per coefficient of the probes that any of them reads. L R is
/// the truncated singular value decomposition of T, which is the best of its rank. Structure of
/// arrays. Silvennoinen, Lehtinen. Real-time Global Illumination by Precomputed Local
/// Reconstruction from Sparse Radiance Probes. 2017
struct CompressedTransport {
    std::vector<std::uint32_t> receiver; ///< every receiver once, cluster by cluster
    /// Offsets of each cluster, and the end, into `receiver`, `probe`, `left` and `right`. All are
    /// empty if nothing is compressed.
    std::vector<std::uint32_t> receiverBegin, probeBegin;
    std::vector<std::uint64_t> leftBegin, rightBegin;
    std::vector<std::uint16_t> rank;        ///< per cluster, [0, kMaxClusterReceivers]
    std::vector<std::uint16_t> probe;       ///< of a cluster, ascending
    std::vector<std::uint16_t> left, right; ///< L and R as halfs, row by row

    bool empty() const { return rank.empty(); }
    std::size_t clusters() const { return rank.size(); }
    std::uint64_t bytes() const;
    bool operator==(const CompressedTransport&) const = default;
};

inline constexpr std::uint32_t kMaxClusterReceivers = 256;

/// What of a receiver's irradiance is kept from being negative, which harmonics that ring make it.
enum class NotNegative : std::uint8_t {
    Sum,
    Parts, ///< that of each probe; this adds light
    Nothing
};

/// Compresses a transport of `coefficients` per receiver and probe. Receivers are clustered by
/// place and normal. Of each cluster's matrix at most the share `error` of its Frobenius norm is
/// lost, besides the rounding to halfs; `error` in [0, 1]. Incomplete when cancelled.
CompressedTransport compressTransport(const Transport& transport, std::size_t coefficients,
                                      const ReceiverPoints& points, float error,
                                      const Progress& progress = {});

/// Irradiance of all receivers [W m^-2], as gatherReceivers() has it of a transport that is not
/// compressed. `probes` is a ProbeRadiance; `irradiance` has an entry per receiver.
void gatherCompressed(const CompressedTransport& transport, std::size_t coefficients,
                      std::span<const float> probes, NotNegative clamped,
                      std::span<glm::vec3> irradiance);

/// Adds to `probes`, weights per coefficient of each probe, what follows from weights of the
/// receivers' irradiance: the transpose of the transport.
void addTransposed(const CompressedTransport& transport, std::size_t coefficients,
                   std::span<const glm::vec3> receivers, std::span<glm::vec3> probes);

} // namespace limn
