// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/lightmap_layout.h"
#include "engine/core/result.h"
#include "engine/files/relight_choice.h"
#include "engine/relight/relight.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

#include <functional>
#include <memory>
#include <string>

namespace limn {

struct OverlayData;

/// Bounced light as a CPU works it out, and what that took.
struct CpuLight {
    const IndirectField& field;
    RelightStats stats;
};

struct RenderRequest {
    View view = View::Lit;
    Camera camera;
    std::uint32_t width = 1280, height = 720;
    Tonemap tonemap = Tonemap::Aces;
    float exposureEv = 0;
    bool tonemapped = false;          ///< the picture is wanted, not only the numbers
    std::string device;               ///< part of the Vulkan device's name; empty: the best
    std::shared_ptr<const Bake> bake; ///< null: nothing is baked
    /// Lights `bake` on the CPU. Empty: no indirect light.
    std::function<CpuLight()> relight;
    RelightOn relightOn = RelightOn::Cpu; ///< Gpu: the device that draws lights `bake` instead
    std::shared_ptr<const OverlayData> overlay; ///< drawn over the picture; null: nothing
};

struct RenderedImage {
    ImageF linear;
    Image picture; ///< tone-mapped, where asked for
    std::string device;
    std::string relightDevice; ///< empty: there is no indirect light
    RelightStats relight;
};

/// One picture by the Vulkan viewport. Fails when there is no such device, when the bake is too
/// large to be lit on it, or when this build has no Vulkan.
Result<RenderedImage> renderOnGpu(const Scene& scene, const RenderRequest& request);

/// The same picture without Vulkan: ray-traced, hard shadows, 16 samples per pixel, no specular.
/// `request.device` and `request.relightOn` are not looked at.
RenderedImage renderOnCpu(const Scene& scene, const RenderRequest& request);

} // namespace limn
