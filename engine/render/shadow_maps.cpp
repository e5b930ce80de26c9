// SPDX-License-Identifier: MIT
#include "engine/render/shadow_maps.h"

#include "engine/gpu/barrier.h"

#include <algorithm>
#include <cassert>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::render {

constexpr VkFormat kShadowFormat = VK_FORMAT_D32_SFLOAT;
constexpr std::uint32_t kTilesPerLayer = 4;

ShadowMaps::ShadowMaps(gpu::Device& device)
    : m_device(device),
      m_sampler(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST,
                                            .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                            .wrapU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                            .wrapV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE})) {
    // Descriptors need an image even where nothing casts a shadow.
    m_atlas = gpu::Image(device, {.format = kShadowFormat,
                                  .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                  .array = true,
                                  .name = "no shadows"});
}

void ShadowMaps::growAtlas(std::uint32_t layers) {
    m_atlas = {}; // frees before it allocates
    m_atlas = gpu::Image(m_device, {.width = kLayerSize,
                                    .height = kLayerSize,
                                    .layers = layers,
                                    .format = kShadowFormat,
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT |
                                             VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                    .array = true,
                                    .layerViews = true,
                                    .name = "shadow atlas"});
    m_atlasFresh = true;
    for (Group& g : m_groups)
        g.drawn = false;
}

ShadowMaps::Group* ShadowMaps::find(const ShadowKey& key) {
    for (Group& g : m_groups)
        if (g.key == key && !g.used)
            return &g;
    return nullptr;
}

// First fit: whole layers for directional lights, runs of quarters for the others.
bool ShadowMaps::place(Group& group) {
    std::vector<bool> taken(kMaxLayers * kTilesPerLayer, false);
    for (const Group& g : m_groups)
        if (&g != &group)
            std::fill_n(taken.begin() + g.firstTile, g.tiles, true);
    const bool directional = group.key.kind == LightKind::Directional;
    group.tiles = directional ? kTilesPerLayer : std::uint32_t(group.views.size());
    const std::uint32_t step = directional ? kTilesPerLayer : 1;
    for (std::uint32_t first = 0; first + group.tiles <= taken.size(); first += step) {
        if (std::find(taken.begin() + first, taken.begin() + first + group.tiles, true) !=
            taken.begin() + first + group.tiles)
            continue;
        group.firstTile = first;
        return true;
    }
    group.tiles = 0;
    return false;
}

void ShadowMaps::build(Group& group, const Bounds& bounds) const {
    const bool whole = group.key.kind == LightKind::Directional;
    const std::uint32_t size = whole ? kLayerSize : kLayerSize / 2;
    group.views = shadowViews(group.key, bounds, size);
    for (std::uint32_t i = 0; i < group.views.size(); ++i) {
        const std::uint32_t tile = group.firstTile + i, quarter = tile % kTilesPerLayer;
        ShadowView& v = group.views[i];
        v.tile.offset = {std::int32_t(whole ? 0 : (quarter & 1) * size),
                         std::int32_t(whole ? 0 : (quarter >> 1) * size)};
        v.tile.extent = {size, size};
        const glm::vec2 offset =
            glm::vec2(float(v.tile.offset.x), float(v.tile.offset.y)) / float(kLayerSize);
        const float scale = 0.5f * float(size) / float(kLayerSize);
        const glm::mat4 toTile = glm::translate(glm::mat4(1), glm::vec3(offset + scale, 0)) *
                                 glm::scale(glm::mat4(1), glm::vec3(scale, scale, 1));
        v.gpu.toAtlas = toTile * v.toClip;
        v.gpu.layer = tile / kTilesPerLayer;
    }
}

std::vector<ShadowSlot> ShadowMaps::assign(const std::vector<Light>& lights, const Bounds& bounds,
                                           std::uint64_t sceneVersion) {
    if (sceneVersion != m_sceneVersion)
        m_groups.clear();
    m_sceneVersion = sceneVersion;
    for (Group& g : m_groups)
        g.used = false;
    std::vector<bool> known(lights.size(), false);
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (Group* g = find(shadowKey(lights[i])))
            g->used = known[i] = true;
    std::erase_if(m_groups, [](const Group& g) { return !g.used; });
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (known[i])
            continue;
        Group& g = m_groups.emplace_back();
        g.key = shadowKey(lights[i]);
        g.views = shadowViews(g.key, bounds, kLayerSize); // their number decides the place
        if (place(g))
            build(g, bounds);
        else
            m_groups.pop_back();
    }
    std::uint32_t layers = 0;
    for (Group& g : m_groups) {
        g.used = false;
        layers = std::max(layers, (g.firstTile + g.tiles + kTilesPerLayer - 1) / kTilesPerLayer);
    }
    if (layers > 0 && (layers > m_atlas.layers || m_atlas.width != kLayerSize))
        growAtlas(layers);

    std::vector<ShadowSlot> slots(lights.size());
    m_order.clear();
    unshadowed = 0;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Group* g = find(shadowKey(lights[i]));
        unshadowed += g == nullptr;
        if (!g)
            continue;
        g->used = true;
        m_order.push_back(std::uint32_t(g - m_groups.data()));
        slots[i] = {std::uint32_t(g->views.size()), first};
        first += slots[i].count;
    }
    return slots;
}

std::vector<shared::GpuShadowView> ShadowMaps::views() const {
    std::vector<shared::GpuShadowView> out;
    for (std::uint32_t i : m_order)
        for (const ShadowView& v : m_groups[i].views)
            out.push_back(v.gpu);
    return out;
}

static void beginTile(VkCommandBuffer cmd, VkImageView layer, const VkRect2D& tile) {
    VkRenderingAttachmentInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    depth.imageView = layer;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR; // clears the tile only
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.clearValue.depthStencil.depth = 0;
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = tile;
    info.layerCount = 1;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(cmd, &info);
    const VkViewport viewport{float(tile.offset.x),
                              float(tile.offset.y),
                              float(tile.extent.width),
                              float(tile.extent.height),
                              0,
                              1};
    vkCmdSetViewport(cmd, 0, 1, &viewport);
    vkCmdSetScissor(cmd, 0, 1, &tile);
}

void ShadowMaps::prepare(VkCommandBuffer cmd) {
    if (m_atlasFresh)
        gpu::imageBarrier(cmd, m_atlas.handle, VK_IMAGE_ASPECT_DEPTH_BIT, gpu::kUndefined,
                          gpu::kFragmentRead);
    m_atlasFresh = false;
}

std::uint32_t ShadowMaps::record(VkCommandBuffer cmd, const DrawCasters& draw) {
    const bool any = std::any_of(m_order.begin(), m_order.end(),
                                 [&](std::uint32_t i) { return !m_groups[i].drawn; });
    if (!any) {
        prepare(cmd);
        return 0;
    }
    const gpu::Access before = m_atlasFresh ? gpu::kUndefined : gpu::kFragmentRead;
    gpu::imageBarrier(cmd, m_atlas.handle, VK_IMAGE_ASPECT_DEPTH_BIT, before, gpu::kDepthWrite);
    std::uint32_t drawn = 0;
    for (std::uint32_t i : m_order) {
        Group& g = m_groups[i];
        if (g.drawn)
            continue;
        for (const ShadowView& v : g.views) {
            beginTile(cmd, m_atlas.layerViews[v.gpu.layer], v.tile);
            draw(cmd, v);
            vkCmdEndRendering(cmd);
        }
        g.drawn = true;
        ++drawn;
    }
    gpu::imageBarrier(cmd, m_atlas.handle, VK_IMAGE_ASPECT_DEPTH_BIT, gpu::kDepthWrite,
                      gpu::kFragmentRead);
    m_atlasFresh = false;
    return drawn;
}

} // namespace limn::render
