// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/relight_buffers.h"

#include "engine/field/field_packing.h"
#include "engine/field/indirect_field.h"
#include "engine/gpu/barrier.h"
#include "engine/gpu/uploader.h"
#include "engine/techniques/illuminance/gpu/tree_levels.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace limn {

using shared::GpuCache;
using shared::GpuFill;
using shared::GpuSurfel;

namespace {

/// Creates storage buffers, none larger than the device can bind.
class StorageMaker {
public:
    explicit StorageMaker(gpu::Device& device) : m_device(device), m_uploader(device) {}

    template <class T>
    gpu::Buffer filled(const std::vector<T>& values, const char* name) {
        const std::vector<T> one(1); // descriptors need a buffer even where there is nothing
        const auto bytes = std::as_bytes(std::span(values.empty() ? one : values));
        return fits(bytes.size(), name)
                   ? m_uploader.buffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, name)
                   : gpu::Buffer();
    }

    /// Creates a buffer without filling it.
    gpu::Buffer empty(std::size_t count, std::size_t elementBytes, const char* name,
                      gpu::MemoryKind memory = gpu::MemoryKind::Gpu) {
        const VkDeviceSize bytes = std::max<std::size_t>(count, 1) * elementBytes;
        if (!fits(bytes, name))
            return {};
        return {m_device,
                {.size = bytes,
                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                          VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                 .memory = memory,
                 .name = name}};
    }

    std::string error; ///< empty if all fitted

private:
    bool fits(VkDeviceSize bytes, const char* name) {
        const VkDeviceSize most = m_device.properties.limits.maxStorageBufferRange;
        if (bytes > most && error.empty())
            error = fmt::format("{}: the {} of this bake take {:.1f} MiB, more than the {:.1f} MiB "
                                "that the device can bind; bake fewer links, caches or bands",
                                m_device.properties.deviceName, name, double(bytes) / (1 << 20),
                                double(most) / (1 << 20));
        return bytes <= most;
    }

    gpu::Device& m_device;
    gpu::Uploader m_uploader;
};

} // namespace

static std::vector<GpuSurfel> packSurfels(const Bake& bake) {
    const Surfels& surfels = bake.surfels;
    const std::vector<float> share = seenShares(bake.tree);
    std::vector<GpuSurfel> out(surfels.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = {surfels.position[i], share[i],         surfels.normal[i],
                  surfels.area[i],     surfels.cache[i], surfels.cacheWeight[i]};
    return out;
}

std::vector<GpuCache> packCaches(const Caches& caches, LinkEnds ends) {
    std::vector<GpuCache> out(caches.size());
    for (std::size_t c = 0; c < out.size(); ++c)
        out[c] = {caches.linkBegin[c], ends[c], std::ldexp(1.f, -caches.linkExponent[c]),
                  caches.texel[c]};
    return out;
}

/// Packs links of LinkStorage::Sh: a node, then its halfs in pairs.
static std::vector<std::uint32_t> packHarmonics(const Caches& caches, std::size_t coefficients) {
    const std::size_t words = 1 + (coefficients + 1) / 2;
    std::vector<std::uint32_t> out(caches.shNode.size() * words);
    for (std::size_t k = 0; k < caches.shNode.size(); ++k) {
        out[k * words] = caches.shNode[k];
        std::memcpy(&out[k * words + 1], &caches.shCoefficients[k * coefficients],
                    coefficients * sizeof(std::uint16_t));
    }
    return out;
}

static gpu::Buffer uploadLinks(StorageMaker& make, const Caches& caches, std::size_t coefficients) {
    static_assert(sizeof(Link) == RELIGHT_CONE_WORDS * 4);
    return caches.shNode.empty() ? make.filled(caches.links, "links")
                                 : make.filled(packHarmonics(caches, coefficients), "links");
}

static void uploadFills(StorageMaker& make, const Caches& caches, RelightBuffers& out) {
    std::vector<GpuFill> fills;
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        if (caches.fillBegin[c] == caches.fillBegin[c + 1])
            continue;
        fills.push_back({c, caches.fillBegin[c], caches.fillBegin[c + 1], 0});
        out.lightmapFills += c < caches.lightmapCount;
    }
    std::vector<glm::uvec2> sources(caches.fillSource.size());
    for (std::size_t k = 0; k < sources.size(); ++k)
        sources[k] = {caches.fillSource[k], std::bit_cast<std::uint32_t>(caches.fillWeight[k])};
    out.fillCount = std::uint32_t(fills.size());
    out.fills = make.filled(fills, "invalid caches");
    out.fillSources = make.filled(sources, "sources of invalid caches");
}

void clearBuffers(gpu::Device& device, std::initializer_list<VkBuffer> buffers) {
    const VkCommandBuffer cmd = device.begin("clear light");
    for (const VkBuffer b : buffers)
        vkCmdFillBuffer(cmd, b, 0, VK_WHOLE_SIZE, 0);
    gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kAllReads);
    device.submit(cmd);
}

static void clear(gpu::Device& device, const gpu::Image& lightmap) {
    const VkCommandBuffer cmd = device.begin("clear lightmap");
    const VkImage image = lightmap.handle;
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kUndefined, gpu::kTransferWrite);
    const VkClearColorValue black{};
    const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0,
                                        VK_REMAINING_ARRAY_LAYERS};
    vkCmdClearColorImage(cmd, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &whole);
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kTransferWrite,
                      gpu::kFragmentRead);
    device.submit(cmd);
}

std::vector<const gpu::Buffer*> RelightBuffers::inBindingOrder() const {
    return {&surfels, &direct,      &albedo,      &emitted, &indirect, &radiosity,
            &change,  &innerNodes,  &levels,      &caches,  &links,    &sh,
            &fills,   &fillSources, &field->grid, &order};
}

Result<RelightBuffers> createRelightBuffers(gpu::Device& device, const Bake& bake,
                                            std::uint32_t lanes) {
    const std::size_t surfels = bake.surfels.size(), color = sizeof(glm::vec4);
    const std::size_t coefficients = std::size_t(bake.settings.bands) * bake.settings.bands;
    const TreeLevels levels = treeLevels(bake.tree);
    RelightBuffers out;
    std::string error;
    {
        StorageMaker make(device);
        out.surfels = make.filled(packSurfels(bake), "surfels");
        out.innerNodes = make.filled(levels.nodes, "inner nodes");
        out.levels = make.filled(levels.begin, "tree levels");
        out.caches = make.filled(packCaches(bake.caches, allLinks(bake.caches)), "caches");
        out.links = uploadLinks(make, bake.caches, coefficients);
        uploadFills(make, bake.caches, out);
        out.direct = make.empty(surfels, color, "direct irradiance");
        out.albedo = make.empty(surfels, color, "albedo");
        out.emitted = make.empty(surfels, color, "emitted radiosity");
        out.indirect = make.empty(surfels, color, "indirect irradiance");
        out.radiosity = make.empty(bake.tree.size(), color, "radiosity");
        out.sh = make.empty(bake.caches.size() * coefficients, color, "cache harmonics");
        out.change = make.empty((surfels + lanes - 1) / lanes, sizeof(glm::vec4), "change",
                                gpu::MemoryKind::Readback);
        std::vector<std::uint32_t> order;
        for (std::uint32_t c = bake.caches.lightmapCount; c < bake.caches.size(); ++c)
            order.push_back(c);
        order.resize(order.size() + RelightBuffers::kCacheLists * bake.caches.lightmapCount);
        out.order = make.filled(order, "lists of caches");
        if (!bake.gridDepth.empty())
            out.gridDepth =
                std::make_shared<const gpu::Buffer>(make.filled(bake.gridDepth, "grid depths"));
        error = make.error;
    }
    if (!error.empty())
        return fail(error);
    out.levelBegin = levels.begin;
    clearBuffers(device, {out.indirect.handle, out.radiosity.handle});
    return out;
}

void makeRelitField(gpu::Device& device, const Bake& bake, std::uint32_t bands,
                    std::uint32_t chroma, RelightBuffers& buffers) {
    assert(bands <= bake.settings.bands && chroma <= bands);
    const std::uint32_t layers = fieldLayers(bands, chroma);
    auto field = std::make_shared<GpuField>();
    field->bands = bands;
    field->chroma = chroma;
    field->lightmap =
        createFieldLightmap(device, bake.lightmap.width, bake.lightmap.height, layers,
                            VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    field->gridSize = bake.gridSize;
    field->gridBounds = bake.gridBounds;
    // Every cell is a cache, so this buffer is no larger than that of the harmonics, which fits.
    field->grid = StorageMaker(device).empty(std::size_t(bake.gridSize.x) * bake.gridSize.y *
                                                 bake.gridSize.z * layers,
                                             sizeof(glm::u16vec4), "grid cells");
    field->gridDepth = buffers.gridDepth;
    buffers.field = std::move(field);
    clearBuffers(device, {buffers.sh.handle, buffers.field->grid.handle});
    clear(device, buffers.field->lightmap);
}

} // namespace limn
