// SPDX-License-Identifier: MIT
#include "engine/render/shadows/shadow_maps.h"

#include "engine/gpu/barrier.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::render {

constexpr VkFormat kShadowFormat = VK_FORMAT_D32_SFLOAT;

ShadowMaps::ShadowMaps(gpu::Device& device)
    : m_device(device),
      m_sampler(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST,
                                            .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                            .wrapU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                            .wrapV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE})) {
    m_tiles.reset(0);
    // Descriptors need an image even where nothing casts a shadow.
    m_atlas = gpu::Image(device, {.format = kShadowFormat,
                                  .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                  .array = true,
                                  .name = "no shadows"});
}

void ShadowMaps::growAtlas(std::uint32_t layers) {
    m_atlas = {}; // frees before it allocates
    m_atlas = gpu::Image(m_device, {.width = ShadowTiles::kLayerSize,
                                    .height = ShadowTiles::kLayerSize,
                                    .layers = layers,
                                    .format = kShadowFormat,
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT |
                                             VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                    .array = true,
                                    .layerViews = true,
                                    .name = "shadow atlas"});
    m_atlasFresh = true;
    for (auto& [key, g] : m_groups) {
        g.drawn = false;
        for (Cascade& c : g.cascades)
            c.drawn = false;
    }
}

static bool isLarge(const ShadowKey& key) {
    return key.kind == LightKind::Directional;
}

static std::uint32_t smallTiles(const ShadowKey& key) {
    return isLarge(key) ? ShadowTiles::kLargeTile : shadowViewCount(key);
}

static float reachOf(const Light& light) {
    const bool windowed = light.kind == LightKind::Point || light.kind == LightKind::Spot;
    return windowed && light.range > 0 ? light.range : std::numeric_limits<float>::infinity();
}

// Lights with equal shadow keys share their maps.
ShadowMaps::Groups ShadowMaps::wantedGroups(const std::vector<Light>& lights) {
    Groups wanted;
    std::uint64_t tiles = 0;
    leftOut = 0;
    for (const Light& light : lights) {
        const ShadowKey key = shadowKey(light);
        auto found = wanted.find(key);
        if (found == wanted.end()) {
            if (tiles + smallTiles(key) > ShadowTiles::room(ShadowTiles::kMaxLevel)) {
                ++leftOut;
                continue;
            }
            tiles += smallTiles(key);
            found = wanted.emplace(key, Group{}).first;
        }
        found->second.reach = std::max(found->second.reach, reachOf(light));
    }
    const std::uint32_t level = *ShadowTiles::levelFor(tiles);
    if (level != m_tiles.level()) {
        m_groups.clear();
        m_tiles.reset(level);
    }
    return wanted;
}

bool ShadowMaps::place(const ShadowKey& key, Group& group) {
    const std::uint32_t count = shadowViewCount(key);
    group.places.clear();
    group.drawn = false;
    while (group.places.size() < count) {
        const auto tile = m_tiles.take(isLarge(key));
        if (!tile)
            return false;
        group.places.push_back(*tile);
    }
    return true;
}

// Places groups that have no place yet. If that fails because small tiles or cascades occupy the
// room, all groups are placed again, large ones first and without cascades.
void ShadowMaps::placeAll() {
    static_assert(LightKind::Directional == LightKind(0), "first in the order of keys");
    for (auto& [key, group] : m_groups) {
        if (!group.places.empty() || place(key, group))
            continue;
        m_tiles.reset(m_tiles.level());
        for (auto& [k, g] : m_groups) {
            g.cascades.clear();
            place(k, g);
        }
        return;
    }
}

// A view with fewer texels than its tile is drawn into the tile's corner.
static void placeInAtlas(ShadowView& v, ShadowTile tile, std::uint32_t size) {
    v.tile = tile;
    v.tile.size = size;
    const float whole = float(ShadowTiles::kLayerSize), scale = 0.5f * float(size) / whole;
    const glm::vec2 offset = glm::vec2(float(tile.x), float(tile.y)) / whole;
    const glm::mat4 toTile = glm::translate(glm::mat4(1), glm::vec3(offset + scale, 0)) *
                             glm::scale(glm::mat4(1), glm::vec3(scale, scale, 1));
    v.gpu.toAtlas = toTile * v.toClip;
    v.gpu.layer = tile.layer;
    const float margin = float(SHADOW_MARGIN) / whole;
    v.gpu.inside = glm::vec4(offset + margin, offset + 2 * scale - margin);
}

void ShadowMaps::makeViews(const ShadowKey& key, Group& group, const Bounds& bounds) {
    const std::uint32_t size = m_tiles.tile(group.places[0], isLarge(key)).size >> group.coarse;
    group.views = shadowViews(key, bounds, size);
    for (std::size_t i = 0; i < group.views.size(); ++i)
        placeInAtlas(group.views[i], m_tiles.tile(group.places[i], isLarge(key)), size);
}

// Keeps cascades whose projection is unchanged; the others must be redrawn.
void ShadowMaps::updateCascades(const ShadowKey& key, Group& group, const Bounds& bounds,
                                bool coarse, const ShadowCamera& camera) {
    const std::vector<glm::mat4> wanted = cascadeProjections(key.direction, bounds, camera);
    for (; group.cascades.size() > wanted.size(); group.cascades.pop_back())
        m_tiles.free(group.cascades.back().place, false);
    while (group.cascades.size() < wanted.size()) {
        const auto place = m_tiles.take(false);
        if (!place)
            break;
        group.cascades.push_back({.view = {}, .place = *place});
    }
    for (std::size_t k = 0; k < group.cascades.size(); ++k) {
        Cascade& c = group.cascades[k];
        if (c.drawn && c.view.toClip == wanted[k] && (coarse || !c.coarse))
            continue;
        const ShadowTile tile = m_tiles.tile(c.place, false);
        const std::uint32_t size = tile.size >> coarse;
        c.drawn = false;
        c.coarse = coarse;
        c.view.toClip = wanted[k];
        c.view.gpu.axis = glm::vec4(key.direction, 0);
        const glm::vec3 across = glm::transpose(wanted[k])[0]; // 2 / width long
        c.view.gpu.texelSize = 2 / (float(size) * glm::length(across));
        placeInAtlas(c.view, tile, size);
    }
}

std::vector<ShadowSlot> ShadowMaps::assign(const std::vector<Light>& lights, const Bounds& bounds,
                                           std::uint64_t sceneVersion, bool coarse,
                                           const ShadowCamera* camera) {
    if (sceneVersion != m_sceneVersion) {
        m_groups.clear();
        m_tiles.reset(m_tiles.level());
    }
    m_sceneVersion = sceneVersion;
    Groups wanted = wantedGroups(lights);
    for (auto& [key, group] : m_groups) {
        const auto found = wanted.find(key);
        if (found != wanted.end()) {
            const float reach = found->second.reach;
            found->second = std::move(group);
            if (!found->second.drawn || reach > found->second.reach) {
                found->second.drawn = false;
                found->second.reach = reach;
            }
            continue;
        }
        for (const std::uint32_t tile : group.places)
            m_tiles.free(tile, isLarge(key));
        for (const Cascade& c : group.cascades)
            m_tiles.free(c.place, false);
    }
    m_groups = std::move(wanted);
    placeAll();

    std::uint32_t layers = 0, first = 0;
    std::map<ShadowKey, ShadowSlot, ShadowKeyOrder> slotOf;
    for (auto& [key, group] : m_groups) {
        if (!group.drawn || (group.coarse && !coarse)) {
            group.drawn = false;
            group.coarse = coarse;
            makeViews(key, group, bounds);
        }
        if (camera && key.kind == LightKind::Directional)
            updateCascades(key, group, bounds, coarse, *camera);
        slotOf[key] = {std::uint32_t(group.views.size()), first,
                       std::uint32_t(group.cascades.size())};
        forEachView(group, [&](const ShadowView& v) {
            ++first;
            layers = std::max(layers, v.tile.layer + 1);
        });
    }
    if (layers > 0 && (layers > m_atlas.layers || m_atlas.width != ShadowTiles::kLayerSize))
        growAtlas(layers);
    std::vector<ShadowSlot> slots(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (const auto found = slotOf.find(shadowKey(lights[i])); found != slotOf.end())
            slots[i] = found->second;
    return slots;
}

std::vector<shared::GpuShadowView> ShadowMaps::views() const {
    std::vector<shared::GpuShadowView> out;
    for (const auto& [key, group] : m_groups)
        forEachView(group, [&](const ShadowView& v) { out.push_back(v.gpu); });
    return out;
}

static VkRect2D areaOf(const ShadowTile& tile) {
    return {{std::int32_t(tile.x), std::int32_t(tile.y)}, {tile.size, tile.size}};
}

// Clears the tiles of `stale`, all of which lie in `layer`, and everything unused.
void ShadowMaps::beginLayer(VkCommandBuffer cmd, std::uint32_t layer,
                            const std::vector<const ShadowView*>& stale) {
    std::size_t used = 0;
    for (const auto& [key, group] : m_groups)
        forEachView(group, [&](const ShadowView& v) { used += v.tile.layer == layer; });
    const bool whole = used == stale.size();
    VkRenderingAttachmentInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    depth.imageView = m_atlas.layerViews[layer];
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = whole ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.clearValue.depthStencil.depth = 0;
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = {{0, 0}, {ShadowTiles::kLayerSize, ShadowTiles::kLayerSize}};
    info.layerCount = 1;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(cmd, &info);
    if (whole)
        return;
    std::vector<VkClearRect> rects;
    for (const ShadowView* v : stale)
        rects.push_back({.rect = areaOf(v->tile), .baseArrayLayer = 0, .layerCount = 1});
    VkClearAttachment clear{};
    clear.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    vkCmdClearAttachments(cmd, 1, &clear, std::uint32_t(rects.size()), rects.data());
}

static void setTile(VkCommandBuffer cmd, const ShadowTile& tile) {
    const VkViewport viewport{
        float(tile.x), float(tile.y), float(tile.size), float(tile.size), 0, 1};
    const VkRect2D area = areaOf(tile);
    vkCmdSetViewport(cmd, 0, 1, &viewport);
    vkCmdSetScissor(cmd, 0, 1, &area);
}

void ShadowMaps::prepare(VkCommandBuffer cmd) {
    if (m_atlasFresh)
        gpu::imageBarrier(cmd, m_atlas.handle, VK_IMAGE_ASPECT_DEPTH_BIT, gpu::kUndefined,
                          gpu::kFragmentRead);
    m_atlasFresh = false;
}

std::uint32_t ShadowMaps::record(VkCommandBuffer cmd, const DrawCasters& draw) {
    std::uint32_t drawn = 0;
    bool lasting = false; // any map except cascades
    struct Stale {
        std::vector<const ShadowView*> views;
        std::vector<const Groups::value_type*> owners;
    };
    std::map<std::uint32_t, Stale> layers;
    for (auto& entry : m_groups) {
        auto& [key, g] = entry;
        bool any = false;
        const auto add = [&](const ShadowView& v) {
            layers[v.tile.layer].views.push_back(&v);
            layers[v.tile.layer].owners.push_back(&entry);
            any = true;
        };
        if (!g.drawn)
            for (const ShadowView& v : g.views)
                add(v);
        lasting |= !std::exchange(g.drawn, true);
        for (Cascade& c : g.cascades)
            if (!std::exchange(c.drawn, true))
                add(c.view);
        drawn += any;
    }
    if (drawn == 0) {
        prepare(cmd);
        return 0;
    }
    const gpu::Access before = m_atlasFresh ? gpu::kUndefined : gpu::kFragmentRead;
    gpu::imageBarrier(cmd, m_atlas.handle, VK_IMAGE_ASPECT_DEPTH_BIT, before, gpu::kDepthWrite);
    for (const auto& [layer, stale] : layers) {
        beginLayer(cmd, layer, stale.views);
        for (std::size_t i = 0; i < stale.views.size(); ++i) {
            setTile(cmd, stale.views[i]->tile);
            draw(cmd, *stale.views[i], stale.owners[i]->first.position,
                 stale.owners[i]->second.reach);
        }
        vkCmdEndRendering(cmd);
    }
    gpu::imageBarrier(cmd, m_atlas.handle, VK_IMAGE_ASPECT_DEPTH_BIT, gpu::kDepthWrite,
                      gpu::kFragmentRead);
    m_atlasFresh = false;
    drawings += lasting;
    return drawn;
}

} // namespace limn::render
