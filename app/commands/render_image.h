// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/files/relight_choice.h"
#include "engine/lighting/lighting.h"
#include "engine/lighting/precomputed.h"
#include "engine/lighting/technique.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace limn {

struct FieldRenderOptions;
struct OverlayData;

/// Bounced light computed on the CPU, and the report of that computation.
struct CpuLight {
    const IndirectField& field;
    LightingReport report;
};

struct RenderRequest {
    View view = View::Lit;
    Camera camera;
    std::uint32_t width = 1280, height = 720;
    Tonemap tonemap = Tonemap::Aces;
    float exposureEv = 0;
    std::uint32_t samplesPerPixel = kFileSamples.perPixel; ///< box filter; at least 1
    std::uint32_t nearRays = kFileSamples.nearRays;        ///< of each sample; 0: none
    std::uint32_t gatherRays = kFileSamples.gatherRays;    ///< the same; 0: none
    Inspection inspection = Inspection::None;              ///< of RenderedImage::picture
    bool tonemapped = false;                               ///< RenderedImage::picture is wanted too
    std::shared_ptr<const LightmapLayout> layout;          ///< of the light; null: there is none
    /// Computes the light on the CPU; `reflections` as LightingInput::reflections. Empty: no
    /// indirect light.
    std::function<CpuLight(bool reflections)> relight;
    /// Lighting::emittedField() of the light that `relight` computed; empty: there is none.
    std::function<std::shared_ptr<const IndirectField>()> emitted;
    const Technique* technique = nullptr; ///< of the light, on either device; null: there is none
    Prepared prepared;                    ///< by the technique, where it precomputes
    bool lightAll = false;                ///< on a device, light also what the picture hides
    RelightOn relightOn = RelightOn::Cpu; ///< Gpu: the drawing device lights it instead
    std::shared_ptr<const OverlayData> overlay; ///< drawn over the picture; null: nothing
};

struct RenderedImage {
    ImageF linear;
    Image picture; ///< tone-mapped, where asked for
    std::string device;
    std::string relightDevice; ///< empty: there is no indirect light
    LightingReport relight;
    std::uint64_t reflections = 0;        ///< as ReflectionCounts::all, on the CPU
    std::uint64_t unknownReflections = 0; ///< as ReflectionCounts::unknown
};

/// The options with which renderField() draws the picture, without bounced light.
FieldRenderOptions fieldOptions(const RenderRequest& request);

/// RenderedImage::picture without overlay and inspection.
Image toneMappedAs(const RenderRequest& request, const ImageF& linear);

/// Draws pictures one after the other and keeps what the next one can use.
using DrawPicture =
    std::function<Result<RenderedImage>(const Scene& scene, const RenderRequest& request)>;

/// Draws with the Vulkan viewport on the device whose name contains `device`; empty selects the
/// best. Fails if there is none. Drawing fails if the picture is larger than the device allows,
/// and, where RelightOn::Gpu is asked for, if the technique lights on the CPU only or the bake is
/// too large for the device. Fails in a program without Vulkan.
Result<DrawPicture> drawingOnGpu(const std::string& device);

/// The same picture without Vulkan: ray-traced.
/// `request.relightOn` and `request.inspection` are ignored.
RenderedImage renderOnCpu(const Scene& scene, const RenderRequest& request);

} // namespace limn
