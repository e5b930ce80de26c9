// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/image.h"
#include "engine/render/shadows/shadow_cascades.h"
#include "engine/render/shadows/shadow_tiles.h"
#include "engine/render/surfaces/material_set.h"
#include "engine/render/surfaces/render_scene.h"
#include "shaders/shared/gpu_light.h"

#include <functional>
#include <map>
#include <vector>

namespace limn::render {

/// What a light's shadow depends on besides the scene. Excludes colour, strength and range.
struct ShadowKey {
    LightKind kind = LightKind::Point;
    glm::vec3 position{0}, direction{0};
    float outerAngle = 0;
    glm::vec3 halfWidth{0}, halfHeight{0}; ///< Rectangle

    bool operator==(const ShadowKey&) const = default;
};
ShadowKey shadowKey(const Light& light);

/// Strict weak ordering of shadow keys.
struct ShadowKeyOrder {
    bool operator()(const ShadowKey& a, const ShadowKey& b) const;
};

/// Location of a light's shadow views in the table returned by ShadowMaps::views().
struct ShadowSlot {
    std::uint32_t count =
        0; ///< SHADOW_SINGLE, SHADOW_CUBE or SHADOW_RECTANGLE; 0: the light is left out
    std::uint32_t first = 0;
    std::uint32_t cascades =
        0; ///< of a directional light; they follow the other views, coarse ones first
};

/// One view: its projection and its place in the atlas.
struct ShadowView {
    glm::mat4 toClip{1}; ///< depth 1 near, 0 far
    shared::GpuShadowView gpu{};
    ShadowTile tile{};
};

/// Draws all shadow casters inside `view` and no further than `reach` from the light [m] into the
/// bound depth attachment.
using DrawCasters =
    std::function<void(VkCommandBuffer, const ShadowView& view, glm::vec3 light, float reach)>;

/// Shadow maps of all lights in one layered depth atlas. A directional light fills a layer, a spot
/// a quarter, a point light six quarters, a rectangle 24. If the layers do not suffice, all maps
/// are half as wide and high, or a quarter, … Cascades of directional lights use the remaining
/// room, a quarter each. A map is redrawn when its light moved or reaches further or the scene
/// changed, but not when only its colour changed. A cascade is also redrawn when the camera has
/// moved by a step.
class ShadowMaps {
public:
    /// Offsets of receivers along the normal and towards the light [shadow texels], for rounding
    /// and for the facets next to the lit one. A larger light bias keeps the corners of lit rooms
    /// lit to the edge; a smaller one narrows the line of light below the edge of a roof. Surfels,
    /// which stand for a patch, use more.
    static constexpr float kNormalBias = 0.2f, kLightBias = 0.25f, kSurfelLightBias = 0.5f;

    explicit ShadowMaps(gpu::Device& device);

    /// Assigns atlas space to each of `lights`, all of which must shine. `bounds` contains every
    /// caster. If there is no room for the last lights, their slots have count 0. With `coarse`,
    /// outdated maps get half as many texels across; without it, such maps are outdated too.
    /// Cascades are updated for `camera`; if it is null, they stay as they are.
    std::vector<ShadowSlot> assign(const std::vector<Light>& lights, const Bounds& bounds,
                                   std::uint64_t sceneVersion, bool coarse = false,
                                   const ShadowCamera* camera = nullptr);

    /// Draws the maps that are out of date. Returns how many lights were drawn.
    std::uint32_t record(VkCommandBuffer cmd, const DrawCasters& draw);

    /// Makes the atlas readable if there is nothing to draw.
    void prepare(VkCommandBuffer cmd);

    std::vector<shared::GpuShadowView> views() const; ///< of the last assign()
    VkImageView atlasView() const { return m_atlas.view; }
    VkSampler sampler() const { return m_sampler.handle; }
    std::uint32_t leftOut = 0; ///< lights of the last assign() without room
    std::uint64_t drawings =
        0; ///< number of record() calls so far that drew any map except cascades

private:
    /// A cascade's view, drawn into a small tile.
    struct Cascade {
        ShadowView view;
        std::uint32_t place = 0;
        bool drawn = false, coarse = false;
    };
    struct Group {
        std::vector<ShadowView> views;
        std::vector<std::uint32_t> places; ///< of the views among m_tiles
        std::vector<Cascade> cascades;
        float reach = 0; ///< of the light [m]
        bool drawn = false, coarse = false;
    };
    using Groups = std::map<ShadowKey, Group, ShadowKeyOrder>;

    /// Calls `f` for each view, in the order of views().
    template <class Function>
    static void forEachView(const Group& group, const Function& f) {
        for (const ShadowView& v : group.views)
            f(v);
        for (const Cascade& c : group.cascades)
            f(c.view);
    }

    Groups wantedGroups(const std::vector<Light>& lights);
    bool place(const ShadowKey& key, Group& group);
    void placeAll();
    void makeViews(const ShadowKey& key, Group& group, const Bounds& bounds);
    void updateCascades(const ShadowKey& key, Group& group, const Bounds& bounds, bool coarse,
                        const ShadowCamera& camera);
    void growAtlas(std::uint32_t layers);
    void beginLayer(VkCommandBuffer cmd, std::uint32_t layer,
                    const std::vector<const ShadowView*>& stale);

    gpu::Device& m_device;
    gpu::Image m_atlas;
    gpu::Sampler m_sampler;
    ShadowTiles m_tiles;
    Groups m_groups; ///< of the last assign()
    std::uint64_t m_sceneVersion = ~0ull;
    bool m_atlasFresh = true; ///< its contents and layout are undefined
};

/// Transform from world space to a frame that looks along a directional light.
glm::mat4 directionalFrame(glm::vec3 direction);

/// Bounding box of the corners of `bounds` in such a frame.
Bounds boundsInFrame(const Bounds& bounds, const glm::mat4& frame);

/// Number of views that shadowViews() returns.
std::uint32_t shadowViewCount(const ShadowKey& key);

/// The views a light needs: one; six for point lights and for spots too wide for one projection;
/// six from the middle of each quarter of a rectangle.
std::vector<ShadowView> shadowViews(const ShadowKey& key, const Bounds& bounds,
                                    std::uint32_t mapSize);

} // namespace limn::render
