// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/image.h"
#include "engine/render/material_set.h"
#include "engine/render/render_scene.h"
#include "shaders/shared/gpu_light.h"

#include <array>
#include <functional>
#include <vector>

namespace limn::render {

/// What a light's shadow depends on besides the scene; colour, strength and range are not among it.
struct ShadowKey {
    LightKind kind = LightKind::Point;
    glm::vec3 position{0}, direction{0};
    float outerAngle = 0;
    glm::vec3 halfWidth{0}, halfHeight{0}; ///< Rectangle

    bool operator==(const ShadowKey&) const = default;
};
ShadowKey shadowKey(const Light& light);

/// Where a light's shadow views are in the table that ShadowMaps::views() gives out.
struct ShadowSlot {
    std::uint32_t count = 0; ///< SHADOW_NONE, SHADOW_SINGLE, SHADOW_CUBE or SHADOW_RECTANGLE
    std::uint32_t first = 0;
};

/// One view: its projection and its place in the atlas.
struct ShadowView {
    glm::mat4 toClip{1}; ///< depth 1 near, 0 far
    shared::GpuShadowView gpu{};
    VkRect2D tile{};
};

/// Draws everything that casts shadows inside `view` into the bound depth attachment.
using DrawCasters = std::function<void(VkCommandBuffer, const ShadowView& view)>;

/// Shadow maps of all lights in one layered depth atlas. A directional light fills a layer, a spot
/// a quarter, a point light six quarters, a rectangle 24. A map is drawn when its light moved or
/// the scene changed, not when only its colour did.
class ShadowMaps {
public:
    static constexpr std::uint32_t kLayerSize = 2048; ///< texels; a quarter is half as wide
    static constexpr std::uint32_t kMaxLayers = 32; ///< 512 MiB; then further lights cast no shadow

    /// Receivers are moved off their surface by so many shadow texels, along the normal and towards
    /// the light: for rounding, and for the facets next to the one that is lit.
    static constexpr float kNormalBias = 0.2f, kLightBias = 0.5f;

    explicit ShadowMaps(gpu::Device& device);

    /// Finds or makes a place for each of `lights`; all of them shine. `bounds` holds every caster.
    /// Slots of lights that found no room have count 0.
    std::vector<ShadowSlot> assign(const std::vector<Light>& lights, const Bounds& bounds,
                                   std::uint64_t sceneVersion);

    /// Draws the maps that are out of date. Returns how many lights were drawn.
    std::uint32_t record(VkCommandBuffer cmd, const DrawCasters& draw);

    /// Makes the atlas readable where nothing is to be drawn.
    void prepare(VkCommandBuffer cmd);

    std::vector<shared::GpuShadowView> views() const; ///< of the last assign()
    VkImageView atlasView() const { return m_atlas.view; }
    VkSampler sampler() const { return m_sampler.handle; }
    std::uint32_t unshadowed = 0; ///< lights of the last assign() without room

private:
    struct Group {
        ShadowKey key;
        std::vector<ShadowView> views;
        std::uint32_t firstTile = 0, tiles = 0; ///< quarters; a directional light: 4 of one layer
        bool drawn = false, used = false;
    };

    Group* find(const ShadowKey& key);
    bool place(Group& group);
    void build(Group& group, const Bounds& bounds) const;
    void growAtlas(std::uint32_t layers);

    gpu::Device& m_device;
    gpu::Image m_atlas;
    gpu::Sampler m_sampler;
    std::vector<Group> m_groups;
    std::vector<std::uint32_t> m_order; ///< groups in the order of the last assign()
    std::uint64_t m_sceneVersion = ~0ull;
    bool m_atlasFresh = true; ///< its contents and layout are undefined
};

/// The views a light needs: one; six for point lights and for spots too wide for one projection;
/// six from the middle of each quarter of a rectangle.
std::vector<ShadowView> shadowViews(const ShadowKey& key, const Bounds& bounds,
                                    std::uint32_t mapSize);

} // namespace limn::render
