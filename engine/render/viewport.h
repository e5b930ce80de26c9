// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/field/indirect_field.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/render/gpu_field.h"
#include "engine/render/shadowed_lights.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

namespace limn {

namespace gpu {
class Device;
}
struct OverlayData;

struct ViewportOptions {
    View view = View::Lit;
    Camera camera;
    std::uint32_t width = 1280, height = 720;
    Tonemap tonemap = Tonemap::Aces;
    float exposureEv = 0; ///< colour is multiplied by 2^exposureEv before tone mapping
};

struct ViewportStats {
    /// Of the last frame that is done, the GPU's clock.
    double uploadMs = 0, shadowMs = 0, geometryMs = 0, indirectMs = 0, directMs = 0, totalMs = 0;
    double tonemapMs = 0; ///< with the overlay
    /// Lights of which any was drawn; 0 when no light, object or camera changed.
    std::uint32_t shadowMapsDrawn = 0;
    /// Frames for which triangles were drawn: not where camera, objects and materials are those of
    /// the frame before, and only its light is new.
    std::uint64_t geometryDrawn = 0;
    double relightShadowMs = 0;          ///< shadow maps of the last shadowedLights() that is done
    std::uint32_t relightShadowMaps = 0; ///< drawn by the last shadowedLights()
    std::uint32_t lightsOff = 0;         ///< off, black or out of reach of the scene
    std::uint32_t lightsLeftOut = 0;     ///< dark, for lack of room for their shadow maps
    std::uint64_t gpuBytes = 0;
};

/// The Vulkan viewport, headless and windowed alike: it renders into its own images.
/// Uploads only what changed since the last call.
class Viewport {
public:
    explicit Viewport(gpu::Device& device);
    ~Viewport();

    /// Geometry, textures, instance transforms. `layout` null: no bake yet, so no lightmap
    /// (indirect light is 0). Cheap when assets and layout pointers are those of the last call and
    /// only transforms differ.
    void setScene(const Scene& scene, std::shared_ptr<const LightmapLayout> layout);

    /// Lights, materials and sky: cheap, every frame if need be.
    void setLighting(const Scene& scene);

    /// Indirect light; uploads it, whatever its version: fields of two bakes may have the same.
    void setIndirect(const IndirectField& field);
    /// The same from where it was worked out: nothing is uploaded, and what its owner writes later
    /// shows in the frames after that. On the viewport's device; not null.
    void setIndirect(std::shared_ptr<const GpuField> field);

    /// The lights of the last setLighting() with their shadow maps, drawn where they are out of
    /// date: what GpuRelighter lights surfels with. Good until the next call of a function that is
    /// not const; nobody may still read those of the last call.
    ShadowedLights shadowedLights();

    /// Shadow maps that are drawn from now on have half as many texels across, for while things
    /// move; without it those that have are drawn anew. False at first.
    void setCoarseShadows(bool coarse);

    /// What is drawn over the pictures from now on, which fade to grey beneath it; uploads only if
    /// the pointer is new. Null: nothing, at no cost. The layout is that of setScene.
    void setOverlay(std::shared_ptr<const OverlayData> overlay);

    /// Records and submits one frame to the viewport's own colour target, tone-mapped 8-bit
    /// sRGB-encoded.
    void render(const ViewportOptions& options);

    /// The tone-mapped result of the last render(): a sampled image in SHADER_READ_ONLY_OPTIMAL,
    /// for ImGui::Image.
    VkImageView colorView() const;
    /// Its image, in the same layout: the picture is its corner (0, 0, width, height) of the last
    /// ViewportOptions, and the rest is spare, so a size that changes every frame costs nothing
    /// (half the size while things move, say). View and image stay the same until the size grows
    /// beyond any before. The window blits from it (created with VK_IMAGE_USAGE_TRANSFER_SRC_BIT).
    /// ImGui 1.86's backend draws no textures but its font.
    VkImage colorImage() const;

    /// The linear, scene-referred result of the last render(), without the overlay. Waits for the
    /// GPU.
    ImageF readLinear();
    /// The tone-mapped result, RGBA8, as on screen. Waits for the GPU.
    Image readTonemapped();

    const ViewportStats& stats() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace limn
