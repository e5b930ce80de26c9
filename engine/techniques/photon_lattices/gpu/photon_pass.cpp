// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/gpu/photon_pass.h"

#include "engine/core/log.h"
#include "engine/gpu/storage_maker.h"
#include "engine/techniques/photon_lattices/lattice_part.h"
#include "engine/techniques/photon_lattices/splat_part.h"
#include "shaders/photon_lattices/photon_light.frag.h"
#include "shaders/shared/gpu_photons.h"

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <glm/gtc/constants.hpp>

namespace limn {

using shared::GpuPhotonCell;
using shared::GpuPhotons;
using shared::GpuSplat;

namespace {

static_assert(PHOTON_NO_ENTRY == kNoEntry && PHOTON_LATTICE_COUNT == kPhotonLattices);
constexpr VkDescriptorType kPassBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array kPassTypes = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kPassBuffer, kPassBuffer,
                                   kPassBuffer, kPassBuffer};
static_assert(kPassTypes.size() == PHOTON_BINDINGS);

/// What the shader reads, in the order of the bindings.
struct PhotonData {
    GpuPhotons photons{};
    std::vector<std::uint32_t> entries;
    std::vector<GpuPhotonCell> cells;
    std::vector<GpuSplat> splats;
    std::vector<std::uint32_t> buckets = {0, 0};
};

/// Adds a lattice. One without light has a single cell without an entry.
void addLattice(const PhotonLatticePart& part, std::size_t k, PhotonData& data) {
    const LitCells& lit = part.cells();
    const bool dark = lit.cells.empty();
    const auto firstCell = std::uint32_t(data.cells.size());
    data.photons.lattice[k] = {lit.lattice.lower, lit.lattice.cell,
                               dark ? glm::uvec3(1) : lit.lattice.size,
                               std::uint32_t(data.entries.size())};
    if (dark)
        data.entries.push_back(PHOTON_NO_ENTRY);
    else
        data.entries.resize(data.entries.size() + lit.lattice.cells(), PHOTON_NO_ENTRY);
    for (std::uint32_t e = 0; e < lit.cellOf.size(); ++e)
        data.entries[data.photons.lattice[k].first + lit.cellOf[e]] = firstCell + e;
    for (const PhotonCell& cell : lit.cells) {
        GpuPhotonCell& packed = data.cells.emplace_back();
        for (std::size_t i = 0; i < 4; ++i)
            packed.value[i] = glm::vec4(cell.light[i], cell.area[i]);
    }
    data.photons.trilinear = part.trilinear() ? 1 : 0;
    data.photons.factor = part.incident() ? 4 * glm::pi<float>() / 3 : 1;
}

/// Sorts splats by the bucket of their cell.
void addSplats(const PhotonSplatPart& part, PhotonData& data) {
    const std::vector<Splat>& splats = part.splats();
    const std::uint32_t buckets = std::bit_ceil(std::uint32_t(splats.size()) | 1U);
    data.photons.splats = std::uint32_t(splats.size());
    data.photons.bucketMask = buckets - 1;
    data.photons.splatRadius = part.radius();
    data.photons.minCosine = PhotonSplatPart::kMinCosine;
    const auto bucketOf = [&](const Splat& splat) {
        const glm::ivec3 cell(glm::floor(splat.position / part.radius()));
        return shared::photonBucket(cell.x, cell.y, cell.z, buckets - 1);
    };
    data.buckets.assign(buckets + 1, 0);
    for (const Splat& splat : splats)
        ++data.buckets[bucketOf(splat) + 1];
    for (std::uint32_t b = 0; b < buckets; ++b)
        data.buckets[b + 1] += data.buckets[b];
    data.splats.resize(splats.size());
    std::vector<std::uint32_t> next = data.buckets;
    for (const Splat& splat : splats)
        data.splats[next[bucketOf(splat)]++] = {splat.power, 0, splat.position, 0, splat.normal, 0};
}

PhotonData dataOf(const IndirectField& field) {
    PhotonData data;
    data.photons.lift = kLatticeLift;
    data.photons.minArea = kMinAreaShare;
    for (std::size_t k = 0; k < field.parts.size(); ++k)
        if (k < kPhotonLattices)
            addLattice(static_cast<const PhotonLatticePart&>(*field.parts[k]), k, data);
        else
            addSplats(static_cast<const PhotonSplatPart&>(*field.parts[k]), data);
    return data;
}

class PhotonPass : public LightPass {
public:
    PhotonPass(gpu::Device& device, Viewport& viewport, const PhotonData& data)
        : m_set(device, viewport.lightPipelines().of(
                            {kPhotonLightFrag, kPassTypes, {}, "light of photons"})) {
        gpu::StorageMaker maker(device, "Fewer cells or photons need less");
        {
            gpu::Uploader uploader(device);
            m_photons = uploader.buffer(std::as_bytes(std::span(&data.photons, 1)),
                                        VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "photon lattices");
        }
        m_buffers = {maker.filled(data.entries, "photon cells' entries"),
                     maker.filled(data.cells, "photon cells"), maker.filled(data.splats, "splats"),
                     maker.filled(data.buckets, "splats' buckets")};
        m_set.bind(PHOTON_LATTICES, m_photons);
        for (std::uint32_t k = 0; k < m_buffers.size(); ++k)
            if (m_buffers[k])
                m_set.bind(PHOTON_ENTRIES + k, m_buffers[k]);
            else
                m_draws = false;
        if (!m_draws)
            logWarning("photons give no light: " + maker.error);
    }

    void record(const LightPassFrame& frame) override {
        if (m_draws)
            m_set.draw(frame);
    }
    std::uint64_t bytes() const override {
        std::uint64_t bytes = m_photons.size;
        for (const gpu::Buffer& buffer : m_buffers)
            bytes += buffer.size;
        return bytes;
    }

private:
    gpu::Buffer m_photons;
    std::array<gpu::Buffer, PHOTON_BINDINGS - 1> m_buffers;
    LightPassSet m_set;
    bool m_draws = true; ///< false: the device cannot bind that much
};

} // namespace

std::shared_ptr<LightPass> photonPass(gpu::Device& device, Viewport& viewport,
                                      const IndirectField& field) {
    return std::make_shared<PhotonPass>(device, viewport, dataOf(field));
}

} // namespace limn
