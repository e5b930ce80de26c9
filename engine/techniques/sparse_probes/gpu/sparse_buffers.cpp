// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/gpu/sparse_buffers.h"

#include "engine/gpu/storage_maker.h"
#include "engine/techniques/sparse_probes/relight_rays.h"

#include <algorithm>
#include <array>
#include <bit>

namespace limn {

using shared::GpuCluster;
using shared::GpuReceiver;

static_assert(kProbesPerReceiver == SPARSE_PROBES_PER_RECEIVER &&
              kMaxClusterReceivers == SPARSE_CLUSTER_RECEIVERS && kDarkHit == SPARSE_DARK_HIT);

namespace {

/// Two halfs as unpackHalf2x16() reads them.
std::uint32_t pairOf(std::uint16_t first, std::uint16_t second) {
    return std::uint32_t(first) | std::uint32_t(second) << 16;
}

std::vector<GpuReceiver> packReceivers(const Receivers& receivers, const ReceiverPoints& points,
                                       const std::vector<float>& shares) {
    std::vector<GpuReceiver> out(receivers.size());
    for (std::size_t r = 0; r < out.size(); ++r)
        out[r] = {points.position[r], shares[r], points.normal[r], receivers.texel[r]};
    return out;
}

/// Eight probes per receiver, two to a word. Where there are fewer, probe 0 stands in for them; its
/// coefficients are 0 there.
std::vector<std::uint32_t> packNear(const Transport& transport) {
    std::vector<std::uint32_t> out(transport.probe.size() / 2);
    const auto known = [&](std::size_t k) {
        return transport.probe[k] == kNoProbe ? std::uint16_t(0) : transport.probe[k];
    };
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = pairOf(known(2 * k), known(2 * k + 1));
    return out;
}

/// Transport of the receivers [begin, end).
std::vector<std::uint32_t> packTransport(const SparseBake& bake, std::uint32_t begin,
                                         std::uint32_t end) {
    const std::size_t coefficients = bake.coefficients(), pairs = probeRow(coefficients) / 2,
                      count = end - begin;
    std::vector<std::uint32_t> out(count * kProbesPerReceiver * pairs);
    for (std::size_t r = 0; r < count; ++r)
        for (std::size_t k = 0; k < kProbesPerReceiver; ++k) {
            const std::size_t slot = (begin + r) * kProbesPerReceiver + k;
            if (bake.transport.probe[slot] == kNoProbe)
                continue;
            const std::uint16_t* row = &bake.transport.coefficients[slot * coefficients];
            for (std::size_t p = 0; p < pairs; ++p)
                out[(k * pairs + p) * count + r] =
                    pairOf(row[2 * p], 2 * p + 1 < coefficients ? row[2 * p + 1] : 0);
        }
    return out;
}

/// Appends what the clusters' workgroup reads of cluster `c`.
GpuCluster appendCluster(const CompressedTransport& t, std::size_t c, std::size_t coefficients,
                         std::vector<std::uint32_t>& words) {
    const auto offset = [&] { return std::uint32_t(words.size()); };
    GpuCluster out{.receivers = offset(),
                   .receiverCount = t.receiverBegin[c + 1] - t.receiverBegin[c],
                   .probeCount = t.probeBegin[c + 1] - t.probeBegin[c],
                   .rank = t.rank[c]};
    words.insert(words.end(), t.receiver.begin() + t.receiverBegin[c],
                 t.receiver.begin() + t.receiverBegin[c + 1]);
    out.probes = offset();
    words.insert(words.end(), t.probe.begin() + t.probeBegin[c],
                 t.probe.begin() + t.probeBegin[c + 1]);
    const auto ofRow = [](const std::uint16_t* row, std::size_t length, std::size_t pair) {
        return pairOf(row[2 * pair], 2 * pair + 1 < length ? row[2 * pair + 1] : 0);
    };
    out.left = offset();
    for (std::size_t p = 0; p < (out.rank + 1U) / 2; ++p)
        for (std::size_t r = 0; r < out.receiverCount; ++r)
            words.push_back(ofRow(&t.left[t.leftBegin[c] + r * out.rank], out.rank, p));
    out.right = offset();
    for (std::size_t probe = 0; probe < out.probeCount; ++probe)
        for (std::size_t p = 0; p < probeRow(coefficients) / 2; ++p)
            for (std::size_t k = 0; k < out.rank; ++k)
                words.push_back(
                    ofRow(&t.right[t.rightBegin[c] + (k * out.probeCount + probe) * coefficients],
                          coefficients, p));
    return out;
}

/// Makes blocks of at most as many bytes as the device can bind.
class BlockMaker {
public:
    BlockMaker(gpu::Device& device, gpu::StorageMaker& make)
        : m_maxBytes(device.properties.limits.maxStorageBufferRange), m_make(make) {}

    std::vector<SparseBlock> receivers(const SparseBake& bake) {
        const std::size_t bytes = probeRow(bake.coefficients()) * kProbesPerReceiver * 2;
        const auto count = std::uint32_t(bake.receivers.size()),
                   maxReceivers =
                       std::uint32_t(std::clamp<std::size_t>(m_maxBytes / bytes, 1, ~0U));
        for (std::uint32_t begin = 0; begin < count;
             begin += std::min(maxReceivers, count - begin)) {
            const std::uint32_t end = begin + std::min(maxReceivers, count - begin);
            add(begin, end, packTransport(bake, begin, end));
        }
        return std::move(m_blocks);
    }

    /// Also fills `clusters`.
    std::vector<SparseBlock> clusters(const SparseBake& bake, std::vector<GpuCluster>& clusters) {
        std::vector<std::uint32_t> words, one;
        std::uint32_t begin = 0;
        for (std::uint32_t c = 0; c < bake.compressed.clusters(); ++c) {
            one.clear();
            GpuCluster cluster = appendCluster(bake.compressed, c, bake.coefficients(), one);
            if (!words.empty() && (words.size() + one.size()) * sizeof(words[0]) > m_maxBytes) {
                add(begin, c, words);
                words.clear();
                begin = c;
            }
            const auto first = std::uint32_t(words.size());
            for (std::uint32_t* offset :
                 {&cluster.receivers, &cluster.probes, &cluster.left, &cluster.right})
                *offset += first;
            words.insert(words.end(), one.begin(), one.end());
            clusters.push_back(cluster);
        }
        if (begin < clusters.size())
            add(begin, std::uint32_t(clusters.size()), words);
        return std::move(m_blocks);
    }

private:
    void add(std::uint32_t begin, std::uint32_t end, const std::vector<std::uint32_t>& words) {
        m_blocks.push_back({begin, end, m_make.filled(words, "transport")});
    }

    VkDeviceSize m_maxBytes;
    gpu::StorageMaker& m_make;
    std::vector<SparseBlock> m_blocks;
};

/// The probes nearest to each cell of the grid, and the bits of their weights, whose sum is 1.
std::vector<std::uint32_t> packCells(const SparseBake& bake) {
    const IndirectField grid{.gridSize = bake.gridSize, .gridBounds = bake.gridBounds};
    std::vector<std::uint32_t> out;
    for (std::uint32_t c = 0; c < grid.cells(); ++c) {
        const NearProbes near = nearestProbes(bake.probes, cellCentre(grid, c));
        float sum = 0;
        for (const float w : near.weight)
            sum += w;
        for (const std::uint16_t probe : near.probe)
            out.push_back(probe == kNoProbe ? 0 : probe);
        for (const float w : near.weight)
            out.push_back(std::bit_cast<std::uint32_t>(sum > 0 ? w / sum : 0.f));
    }
    return out;
}

} // namespace

std::vector<glm::vec4> packProbes(const ProbeRadiance& probes, std::size_t coefficients) {
    const std::size_t row = probeRow(coefficients), count = probes.size() / (3 * coefficients);
    std::vector<glm::vec4> out(count * row, glm::vec4(0));
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t i = 0; i < coefficients; ++i)
            for (int c = 0; c < 3; ++c)
                out[p * row + i][c] = probes[(3 * p + std::size_t(c)) * coefficients + i];
    return out;
}

ProbeRadiance unpackProbes(const std::vector<glm::vec4>& rows, std::size_t coefficients) {
    const std::size_t row = probeRow(coefficients), count = rows.size() / row;
    ProbeRadiance out(count * 3 * coefficients);
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t i = 0; i < coefficients; ++i)
            for (int c = 0; c < 3; ++c)
                out[(3 * p + std::size_t(c)) * coefficients + i] = rows[p * row + i][c];
    return out;
}

Result<SparseBuffers> createSparseBuffers(gpu::Device& device, const SparseBake& bake,
                                          const ReceiverPoints& points,
                                          const std::vector<float>& shares,
                                          const std::vector<float>& basis, std::uint32_t lanes) {
    const std::size_t receivers = bake.receivers.size(), color = sizeof(glm::vec4),
                      // Receivers without a probe read the first one.
        rows = std::max<std::size_t>(bake.probes.size(), 1) * probeRow(bake.coefficients());
    SparseBuffers out;
    std::string error;
    {
        gpu::StorageMaker make(device, "bake fewer texels, probes, rays or bands");
        out.receivers = make.filled(packReceivers(bake.receivers, points, shares), "receivers");
        out.hits = make.filled(bake.hits, "relight rays");
        out.basis = make.filled(basis, "harmonics of relight rays");
        out.cells = make.filled(packCells(bake), "probes of the grid");
        BlockMaker blocks(device, make);
        if (bake.compressed.empty()) {
            out.near = make.filled(packNear(bake.transport), "probes of receivers");
            out.blocks = blocks.receivers(bake);
        } else {
            std::vector<GpuCluster> clusters;
            out.blocks = blocks.clusters(bake, clusters);
            out.near = make.filled(clusters, "clusters");
        }
        out.direct = make.empty(receivers, color, "direct irradiance");
        out.albedo = make.empty(receivers, color, "albedo");
        out.emission = make.empty(receivers, color, "emission");
        out.irradiance = make.empty(receivers, color, "bounced irradiance");
        out.radiance = make.empty(receivers, color, "radiance of receivers");
        out.sky = make.empty(rows, color, "sky at probes");
        out.probes = make.empty(rows, color, "light of probes");
        out.change =
            make.empty((receivers + lanes - 1) / lanes, color, "change", gpu::MemoryKind::Readback);
        error = make.error;
    }
    if (!error.empty())
        return fail(error);
    gpu::clearBuffers(device, {out.direct.handle, out.irradiance.handle, out.radiance.handle,
                               out.sky.handle, out.probes.handle});
    return out;
}

VkDeviceSize SparseBuffers::bytes() const {
    VkDeviceSize sum = 0;
    for (const gpu::Buffer* b : {&receivers, &hits, &basis, &near, &cells, &direct, &albedo,
                                 &emission, &sky, &irradiance, &radiance, &probes, &change})
        sum += b->size;
    for (const SparseBlock& block : blocks)
        sum += block.transport.size;
    return sum;
}

} // namespace limn
