// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/gpu/gpu_propagation.h"

#include "engine/field/field_packing.h"
#include "engine/gpu/barrier.h"
#include "engine/gpu/uploader.h"
#include "shaders/lpv/lpv_brightest.comp.h"
#include "shaders/lpv/lpv_field.comp.h"
#include "shaders/lpv/lpv_inject.comp.h"
#include "shaders/lpv/lpv_propagate.comp.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <map>

namespace limn {

using shared::GpuCellLobe;
using shared::GpuLpvStep;

namespace {

constexpr std::uint32_t kBands = 2;
/// Cells times rounds of one submission: between two of them a cancellation is seen, and no
/// driver takes the device for hung.
constexpr std::uint64_t kCellRounds = 1 << 22;

constexpr std::uint32_t kStorageBuffers = LPV_BINDINGS + 1; // the lobes' too

static_assert(LPV_FRONT_SOLID_ANGLE == kFrontSolidAngle &&
              LPV_SIDE_SOLID_ANGLE == kSideSolidAngle && LPV_COSINE_MEAN == kCosineMean &&
              LPV_COSINE_SLOPE == kCosineSlope);
// Every device can bind 2^27 bytes, which three vec4 for each cell of the largest lattice and its
// border do not exceed.
static_assert(3 * sizeof(glm::vec4) * 130 * 130 * 130 <= 1 << 27);

std::size_t paddedCells(glm::uvec3 size) {
    return std::size_t(size.x + 2) * (size.y + 2) * (size.z + 2);
}

std::size_t paddedIndex(glm::uvec3 size, glm::uvec3 cell) {
    return (std::size_t(cell.z + 1) * (size.y + 2) + cell.y + 1) * (size.x + 2) + cell.x + 1;
}

/// Colour c of a lobe in the order of gpu_lpv.h.
glm::vec4 packedLobe(const Lobe& lobe, int c) {
    return {lobe[3][c], lobe[1][c], lobe[2][c], lobe[0][c]};
}

/// The faces of cells, and those above the last ones.
std::vector<glm::vec4> packBlockers(const FaceBlockers& blockers, glm::uvec3 size) {
    const std::size_t count = paddedCells(size);
    std::vector<glm::vec4> packed(3 * count, glm::vec4(0));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& face = blockers.axis[axis];
        for (std::uint32_t z = 0; z <= size.z; ++z)
            for (std::uint32_t y = 0; y <= size.y; ++y)
                for (std::uint32_t x = 0; x <= size.x; ++x) {
                    const std::size_t k = blockers.cells.at({x, y, z});
                    packed[axis * count + paddedIndex(size, {x, y, z})] = {face[3][k], face[1][k],
                                                                           face[2][k], face[0][k]};
                }
    }
    return packed;
}

/// The parts' sum, each cell once.
std::vector<GpuCellLobe> packLobes(std::span<const InjectedInstance> parts,
                                   const Lattice& lattice) {
    std::map<std::uint32_t, Lobe> sums;
    for (const InjectedInstance& part : parts)
        for (const CellLobe& cell : part.cells) {
            Lobe& sum = sums[cell.cell];
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += cell.lobe[i];
        }
    std::vector<GpuCellLobe> packed;
    packed.reserve(sums.size());
    for (const auto& [cell, lobe] : sums) {
        GpuCellLobe& out = packed.emplace_back();
        for (int c = 0; c < 3; ++c)
            out.color[c] = packedLobe(lobe, c);
        out.cell = std::uint32_t(paddedIndex(lattice.size, lattice.place(cell)));
    }
    return packed;
}

gpu::Buffer volume(gpu::Device& device, glm::uvec3 size, const char* name) {
    return {device,
            {.size = 3 * paddedCells(size) * sizeof(glm::vec4),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
             .name = name}};
}

} // namespace

Result<std::unique_ptr<GpuPropagation>> GpuPropagation::create(gpu::Device& device) {
    if (const auto bindings = device.checkStorageBuffers(kStorageBuffers); !bindings)
        return tl::make_unexpected(bindings.error());
    return std::unique_ptr<GpuPropagation>(new GpuPropagation(device));
}

GpuPropagation::GpuPropagation(gpu::Device& device)
    : m_device(device),
      m_brightest(device,
                  {.size = sizeof(std::uint32_t),
                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                   .memory = gpu::MemoryKind::Readback,
                   .name = "brightest value"}),
      m_times(device, 3) {
    createSets();
    const auto pipeline = [&](gpu::Spirv shader, const char* name) {
        return gpu::createComputePipeline(device, shader, m_layout.handle, {}, name);
    };
    m_inject = pipeline(kLpvInjectComp, "inject light");
    m_propagate = pipeline(kLpvPropagateComp, "propagate light");
    m_findBrightest = pipeline(kLpvBrightestComp, "brightest value");
    m_writeField = pipeline(kLpvFieldComp, "write field");
}

void GpuPropagation::createSets() {
    std::array<VkDescriptorType, LPV_BINDINGS> types;
    types.fill(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    m_setLayout = gpu::createSetLayout(m_device, types);
    m_lobesLayout = gpu::createSetLayout(m_device, std::array{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
    m_layout =
        gpu::createPipelineLayout(m_device, std::array{m_setLayout.handle, m_lobesLayout.handle},
                                  sizeof(GpuLpvStep), "light propagation");
    m_pool = gpu::createDescriptorPool(m_device, std::uint32_t(m_sets.size()), types);
    for (VkDescriptorSet& set : m_sets)
        set = gpu::allocateSet(m_device, m_pool, m_setLayout);
}

/// No submitted work may be using the sets.
void GpuPropagation::writeSets() {
    for (std::size_t k = 0; k < m_sets.size(); ++k) {
        const auto write = [&](std::uint32_t binding, const gpu::Buffer& buffer) {
            gpu::writeBuffer(m_device, m_sets[k], binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                             buffer.handle);
        };
        write(LPV_BLOCKERS, m_blockers);
        write(LPV_FROM, m_light[k]);
        write(LPV_TO, m_light[1 - k]);
        write(LPV_SUM, m_sum);
        write(LPV_BRIGHTEST, m_brightest);
    }
}

std::uint64_t GpuPropagation::setLattice(const Lattice& lattice, const FaceBlockers& blockers) {
    if (!m_sum || lattice.size != m_lattice.size) {
        m_light = {volume(m_device, lattice.size, "propagated light"),
                   volume(m_device, lattice.size, "propagated light")};
        m_sum = volume(m_device, lattice.size, "light of all rounds");
    }
    m_lattice = lattice;
    gpu::Uploader uploader(m_device);
    const std::vector<glm::vec4> packed = packBlockers(blockers, lattice.size);
    m_blockers = uploader.buffer(std::as_bytes(std::span(packed)),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "blockers");
    writeSets();
    return m_blockers.size;
}

GpuLobes GpuPropagation::upload(std::span<const InjectedInstance> parts) {
    const std::vector<GpuCellLobe> packed = packLobes(parts, m_lattice);
    if (packed.empty())
        return {};
    gpu::Uploader uploader(m_device);
    return lobesOf(uploader.buffer(std::as_bytes(std::span(packed)),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "injected lobes"),
                   std::uint32_t(packed.size()));
}

GpuLobes GpuPropagation::lobesOf(gpu::Buffer cells, std::uint32_t count) {
    if (!cells)
        return {};
    GpuLobes lobes{.cells = std::move(cells), .count = count};
    lobes.pool =
        gpu::createDescriptorPool(m_device, 1, std::array{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
    lobes.set = gpu::allocateSet(m_device, lobes.pool, m_lobesLayout);
    gpu::writeBuffer(m_device, lobes.set, 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, lobes.cells.handle);
    return lobes;
}

void GpuPropagation::makeField() {
    if (!m_field || m_field->gridSize != m_lattice.size) {
        const std::uint32_t layers = fieldLayers(kBands, kBands);
        auto field = std::make_shared<GpuField>();
        field->bands = field->chroma = kBands;
        field->lightmap =
            createFieldLightmap(m_device, 0, 0, layers, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
        const std::vector<glm::u16vec4> black(layers, glm::u16vec4(0));
        gpu::Uploader(m_device).image(field->lightmap, std::as_bytes(std::span(black)));
        field->gridSize = m_lattice.size;
        field->grid = {
            m_device,
            {.size = m_lattice.cells() * layers * sizeof(glm::u16vec4),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
             .name = "grid cells"}};
        m_field = std::move(field);
        for (const VkDescriptorSet set : m_sets)
            gpu::writeBuffer(m_device, set, LPV_GRID, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                             m_field->grid.handle);
    }
    m_field->gridBounds = m_lattice.bounds();
}

void GpuPropagation::bind(VkCommandBuffer cmd, const gpu::Pipeline& step, std::size_t set) {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, step.handle);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1,
                            &m_sets[set], 0, nullptr);
}

/// Records a step with one invocation for each cell, and a barrier that makes what it wrote visible
/// to the next.
void GpuPropagation::dispatchCells(VkCommandBuffer cmd, const gpu::Pipeline& step,
                                   const GpuLpvStep& constants, std::size_t set) {
    bind(cmd, step, set);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof constants, &constants);
    const glm::uvec3 size = m_lattice.size;
    vkCmdDispatch(cmd, gpu::groups(size.x, LPV_GROUP_X), gpu::groups(size.y, LPV_GROUP_Y),
                  gpu::groups(size.z, LPV_GROUP_Z));
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kComputeWrite);
    ++m_dispatches;
}

/// Each source is one dispatch after the other, so that the order of the sums is always the same.
void GpuPropagation::recordInjection(VkCommandBuffer cmd, std::span<const GpuSource> sources,
                                     bool dark) {
    gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kTransferWrite);
    for (const gpu::Buffer& light : m_light)
        vkCmdFillBuffer(cmd, light.handle, 0, VK_WHOLE_SIZE, 0);
    if (dark)
        vkCmdFillBuffer(cmd, m_sum.handle, 0, VK_WHOLE_SIZE, 0);
    gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kComputeWrite);
    for (const GpuSource& source : sources) {
        if (source.lobes->count == 0)
            continue;
        const GpuLpvStep constants{
            .size = m_lattice.size, .count = source.lobes->count, .color = source.colour};
        bind(cmd, m_inject, 0);
        vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 1, 1,
                                &source.lobes->set, 0, nullptr);
        vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof constants,
                           &constants);
        vkCmdDispatch(cmd, gpu::groups(source.lobes->count, LPV_LIST_LANES), 1, 1);
        gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kComputeWrite);
        ++m_dispatches;
    }
}

void GpuPropagation::recordField(VkCommandBuffer cmd, std::array<float, 2> factors) {
    gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kTransferWrite);
    vkCmdFillBuffer(cmd, m_brightest.handle, 0, VK_WHOLE_SIZE, 0);
    gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kComputeWrite);
    const GpuLpvStep constants{.size = m_lattice.size, .mean = factors[0], .slope = factors[1]};
    dispatchCells(cmd, m_findBrightest, constants);
    // Frames that were submitted before may still read the grid.
    gpu::memoryBarrier(cmd, gpu::kAllReads, gpu::kComputeWrite);
    dispatchCells(cmd, m_writeField, constants);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
}

bool GpuPropagation::light(std::span<const GpuSource> sources, std::uint32_t rounds,
                           std::array<float, 2> factors, const Progress& progress,
                           GpuPropagationCost& cost) {
    const std::uint64_t dispatchesBefore = m_dispatches;
    const auto atOnce = std::uint32_t(std::max<std::uint64_t>(kCellRounds / m_lattice.cells(), 1));
    std::uint32_t round = 0;
    bool written = false;
    while (!written && !progress.cancelled()) {
        progress.at("propagation", rounds > 0 ? float(round) / float(rounds) : 0);
        const std::uint32_t end = std::min(round + atOnce, rounds);
        written = end == rounds;
        if (written)
            makeField();
        m_device.immediate("propagate light", [&](VkCommandBuffer cmd) {
            m_times.begin(cmd);
            if (round == 0)
                recordInjection(cmd, sources, rounds == 0);
            else
                gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite);
            m_times.mark(cmd);
            for (; round < end; ++round)
                dispatchCells(cmd, m_propagate, {.size = m_lattice.size, .first = round == 0},
                              round % 2);
            m_times.mark(cmd);
            if (written)
                recordField(cmd, factors);
            m_times.mark(cmd);
        });
        const std::span<const double> ms = m_times.steps();
        cost.injectionMs += ms[0];
        cost.propagationMs += ms[1];
        cost.fieldMs += ms[2];
    }
    cost.dispatches = m_dispatches - dispatchesBefore;
    if (written) {
        const auto bits = *static_cast<const std::uint32_t*>(m_brightest.mapped);
        m_field->scale = fieldScale(std::bit_cast<float>(bits));
    }
    return written;
}

std::vector<Lobe> GpuPropagation::readSum() const {
    const std::size_t count = paddedCells(m_lattice.size);
    std::vector<glm::vec4> packed(3 * count);
    gpu::readBuffer(m_device, m_sum, std::as_writable_bytes(std::span(packed)));
    std::vector<Lobe> sum(m_lattice.cells());
    for (std::uint32_t cell = 0; cell < sum.size(); ++cell) {
        const std::size_t k = paddedIndex(m_lattice.size, m_lattice.place(cell));
        for (int c = 0; c < 3; ++c) {
            const glm::vec4 lobe = packed[std::size_t(c) * count + k];
            sum[cell][0][c] = lobe.w;
            sum[cell][1][c] = lobe.y;
            sum[cell][2][c] = lobe.z;
            sum[cell][3][c] = lobe.x;
        }
    }
    return sum;
}

IndirectField GpuPropagation::readField() const {
    IndirectField out;
    out.bands = m_field->bands;
    out.gridSize = m_field->gridSize;
    out.gridBounds = m_field->gridBounds;
    std::vector<glm::u16vec4> packed(m_field->grid.size / sizeof(glm::u16vec4));
    gpu::readBuffer(m_device, m_field->grid, std::as_writable_bytes(std::span(packed)));
    out.grid = unpackField(packed, m_field->bands, m_field->chroma, m_field->scale);
    return out;
}

std::uint64_t GpuPropagation::bytes() const {
    return m_light[0].size + m_light[1].size + m_sum.size + m_blockers.size +
           (m_field ? m_field->grid.size : 0);
}

} // namespace limn
