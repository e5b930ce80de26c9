// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/lightmap_layout.h"
#include "engine/core/result.h"
#include "engine/relight/indirect_field.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

#include <memory>
#include <string>

namespace limn {

struct OverlayData;

struct RenderRequest {
    View view = View::Lit;
    Camera camera;
    std::uint32_t width = 1280, height = 720;
    Tonemap tonemap = Tonemap::Aces;
    float exposureEv = 0;
    bool tonemapped = false;              ///< the picture is wanted, not only the numbers
    std::string device;                   ///< part of the Vulkan device's name; empty: the best
    const IndirectField* field = nullptr; ///< null: no indirect light
    std::shared_ptr<const LightmapLayout> layout;
    std::shared_ptr<const OverlayData> overlay; ///< drawn over the picture; null: nothing
};

struct RenderedImage {
    ImageF linear;
    Image picture; ///< tone-mapped, where asked for
    std::string device;
};

/// One picture by the Vulkan viewport. Fails when there is no such device, or this build has no
/// Vulkan.
Result<RenderedImage> renderOnGpu(const Scene& scene, const RenderRequest& request);

/// The same picture without Vulkan: ray-traced, hard shadows, 16 samples per pixel, no specular.
/// `request.device` is not looked at.
RenderedImage renderOnCpu(const Scene& scene, const RenderRequest& request);

} // namespace limn
