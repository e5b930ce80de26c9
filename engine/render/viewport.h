// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/render/gpu_field.h"
#include "engine/render/light_pass.h"
#include "engine/render/shadowed_lights.h"
#include "engine/render/surface_map.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
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
    /// Rays of each sample of a pixel that look for surfaces nearer than half a texel of the
    /// lightmap, whose own light then takes the place of the field's, as nearCorrection() does; 0:
    /// none. Dynamic objects and cutouts are not found.
    std::uint32_t nearRays = 0;
    bool diffuse = true;  ///< shows bounced light that surfaces reflect diffusely; else only glossy
    float exposureEv = 0; ///< colour is multiplied by 2^exposureEv before tone mapping
    /// Wireframe needs a device that fills polygons with lines; on others, surfaces are grey.
    Inspection inspection = Inspection::None;

    bool operator==(const ViewportOptions&) const = default;
};

struct ViewportStats {
    /// GPU times of the last completed frame.
    double uploadMs = 0, shadowMs = 0, geometryMs = 0, indirectMs = 0, directMs = 0, totalMs = 0;
    double tonemapMs = 0; ///< includes the overlay
    /// Lights with at least one redrawn shadow map; 0 if no light, object or camera changed.
    std::uint32_t shadowMapsDrawn = 0;
    /// Times that triangles were drawn: not if camera, objects and materials are unchanged.
    std::uint64_t geometryDrawn = 0;
    double relightShadowMs = 0;          ///< shadow maps of the last completed shadowedLights()
    std::uint32_t relightShadowMaps = 0; ///< drawn by the last shadowedLights()
    std::uint32_t lightsOff = 0;     ///< lights that are off, black or too far to reach the scene
    std::uint32_t lightsLeftOut = 0; ///< lights left dark: no room for their shadow maps
    std::uint64_t gpuBytes = 0;
};

/// The Vulkan viewport. It renders into its own images, with or without a window, and uploads only
/// what changed since the last call.
class Viewport {
public:
    explicit Viewport(gpu::Device& device);
    ~Viewport();

    /// Sets geometry, textures and instance transforms. A null `layout` means that there is no bake
    /// yet and hence no lightmap (indirect light is 0). Cheap if the assets and layout pointers
    /// equal those of the last call and only transforms differ.
    void setScene(const Scene& scene, std::shared_ptr<const LightmapLayout> layout);

    /// Sets lights, materials and sky. Cheap enough to call every frame.
    void setLighting(const Scene& scene);

    /// Uploads indirect light. The version is ignored, because fields of two bakes may share one.
    /// `parts` draws what the field's parts hold; null: that is missing in pictures, in which
    /// glossy surfaces then reflect the harmonics.
    void setIndirect(const IndirectField& field, std::shared_ptr<LightPass> parts = nullptr);
    /// Uses indirect light that was computed on the viewport's device; must not be null. Nothing is
    /// uploaded; whatever the owner writes later appears in subsequent frames. `parts`: what is
    /// added to it; null: nothing.
    void setIndirect(std::shared_ptr<const GpuField> field,
                     std::shared_ptr<LightPass> parts = nullptr);
    /// Uses indirect light of a technique's own kind; must not be null. It replaces all other.
    void setIndirect(std::shared_ptr<LightPass> pass);

    /// Pipelines for the passes of setIndirect().
    LightPipelineCache& lightPipelines();

    /// Returns the lights of the last setLighting() with their shadow maps, after redrawing maps
    /// that are out of date. PointIrradiance lights points with them. The result is valid until the
    /// next call of a non-const function; the result of the previous call must no longer be in use.
    ShadowedLights shadowedLights();

    /// Draws the scene as each of `views` sees it, one after the other into the same images of
    /// `size` texels, and lets `read` record compute shaders that read them. Waits for the GPU.
    void drawSurfaceMaps(std::span<const SurfaceMapView> views, glm::uvec2 size,
                         const ReadSurfaceMap& read);

    /// Lets `read` record compute shaders that read the surfaces of a picture of `size` pixels. If
    /// the next render() is of it and has the last one's view, it draws no triangles again. Waits
    /// for the GPU.
    void readSurfaces(const Camera& camera, glm::uvec2 size, const ReadSurfaceMap& read);

    /// Sets whether shadow maps drawn from now on have half as many texels across, as suits moving
    /// scenes. Turning it off causes coarse maps to be redrawn. Initially false.
    void setCoarseShadows(bool coarse);

    /// Sets the overlay of subsequent pictures, which fade to grey beneath it. Uploads only if the
    /// pointer changed. Null draws no overlay and costs nothing. The layout is that of setScene().
    void setOverlay(std::shared_ptr<const OverlayData> overlay);

    /// Records and submits one frame to the viewport's own colour target, tone-mapped 8-bit
    /// sRGB-encoded.
    void render(const ViewportOptions& options);

    /// Draws the picture of the last render() once more, through other points of its pixels, and
    /// shows the mean of all that were drawn since; returns their number. The mean tends to the
    /// picture under a box filter of a pixel's width. Nothing that the viewport shows may have
    /// changed since. Surface images are drawn anew each time.
    std::uint32_t refine();

    /// The tone-mapped result of the last render(), in SHADER_READ_ONLY_OPTIMAL.
    VkImageView colorView() const;
    /// The image of colorView(), in the same layout. The picture fills the corner (0, 0, width,
    /// height) of the last ViewportOptions; the rest is unused, so changing the size every frame
    /// costs nothing (for example, half the size while things move). View and image stay the same
    /// until the size exceeds all previous sizes. The window blits from the image (created with
    /// VK_IMAGE_USAGE_TRANSFER_SRC_BIT), because ImGui 1.86's backend draws no textures except its
    /// font.
    VkImage colorImage() const;

    /// The linear, scene-referred result of the last render() and the calls of refine() after it,
    /// without the overlay. Waits for the GPU.
    ImageF readLinear();
    /// 64 x 36 pixels of readLinear(), spread evenly over the picture: for meteredExposure().
    ImageF readMetering();
    /// The tone-mapped result as on screen, RGBA8. Waits for the GPU.
    Image readTonemapped();

    const ViewportStats& stats() const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace limn
