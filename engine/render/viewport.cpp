// SPDX-License-Identifier: MIT
#include "engine/render/viewport.h"

#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/gpu/barrier.h"
#include "engine/gpu/timestamps.h"
#include "engine/gpu/vulkan_error.h"
#include "engine/render/frame_sets.h"
#include "engine/render/indirect_light.h"
#include "engine/render/passes/camera_view.h"
#include "engine/render/passes/direct_pass.h"
#include "engine/render/passes/geometry_passes.h"
#include "engine/render/passes/glass_pass.h"
#include "engine/render/passes/indirect_pass.h"
#include "engine/render/passes/mean_pass.h"
#include "engine/render/passes/near_pass.h"
#include "engine/render/passes/overlay_pass.h"
#include "engine/render/passes/sky_pass.h"
#include "engine/render/passes/tonemap_pass.h"
#include "engine/render/read_back.h"
#include "engine/render/shadows/light_table.h"
#include "engine/render/shadows/parted_lights.h"
#include "engine/render/shadows/shadow_maps.h"
#include "engine/render/surfaces/surface_images.h"
#include "engine/render/surfaces/surface_maps.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>

namespace limn {

using namespace render;
using shared::GpuFrame;

namespace {

static_assert(std::uint32_t(View::Direct) == VIEW_DIRECT && std::uint32_t(View::Lit) == VIEW_LIT &&
              std::uint32_t(View::Indirect) == VIEW_INDIRECT &&
              std::uint32_t(View::Irradiance) == VIEW_IRRADIANCE &&
              std::uint32_t(View::Albedo) == VIEW_ALBEDO &&
              std::uint32_t(View::Normals) == VIEW_NORMALS);

// Target sizes are rounded up to this, so that dragging a window's edge allocates rarely.
constexpr std::uint32_t kSizeStep = 128;

Extent steppedUp(Extent size) {
    const auto up = [](std::uint32_t n) { return (n + kSizeStep - 1) / kSizeStep * kSizeStep; };
    return {up(size.width), up(size.height)};
}

// How much a picture fades beneath an overlay.
constexpr float kOverlayFade = 0.8f;

/// Shadow maps, geometry, bounced light, direct light, tone mapping.
constexpr std::uint32_t kSteps = 5;

/// Resources of one frame in flight.
struct FrameSlot {
    gpu::Buffer frame; ///< mapped
    LightTable lights;
    std::optional<gpu::Timestamps> times; ///< of kSteps
    std::uint64_t submission = 0;
    std::uint32_t shadowMapsDrawn = 0;
    double uploadMs = 0;
    bool timed = false; ///< its timestamps were read
};

struct Targets {
    gpu::Image linear, color;
    gpu::Image behind;   ///< linear, without glass; made when first needed
    gpu::Image mean;     ///< of several linear images; the same
    gpu::Image metering; ///< made when first needed
};

} // namespace

struct Viewport::Impl {
    explicit Impl(gpu::Device& d);

    void ensureTargets(std::uint32_t width, std::uint32_t height);
    GeometryView viewOf(const ViewportOptions& options) const;
    std::vector<ShadowSlot> assignShadows(const ShadowCamera* camera);
    void writeFrame(FrameSlot& slot, const ViewportOptions& options,
                    const std::vector<ShadowSlot>& shadows, glm::vec2 point);
    void recordShadows(VkCommandBuffer cmd, FrameSlot& slot, std::uint32_t slotIndex, bool needed);
    void beginOnLinear(VkCommandBuffer cmd, const ViewportOptions& options);
    void recordIndirect(VkCommandBuffer cmd, const ViewportOptions& options,
                        std::uint32_t slotIndex);
    void recordDirect(VkCommandBuffer cmd, const ViewportOptions& options, std::uint32_t slotIndex);
    void recordBehindGlass(VkCommandBuffer cmd, GeometryView view, const ViewportOptions& options,
                           std::uint32_t slotIndex);
    void recordSurfaces(VkCommandBuffer cmd, const GeometryView& view,
                        const ViewportOptions& options, std::uint32_t slotIndex);
    void ensureLike(gpu::Image& image, const char* name);
    void recordTonemap(VkCommandBuffer cmd, const ViewportOptions& options, std::uint32_t slot);
    void recordOverlay(VkCommandBuffer cmd, const GeometryView& view,
                       const ViewportOptions& options, std::uint32_t slot);
    void readTimes(FrameSlot& slot);
    void draw(const ViewportOptions& options);
    /// What is shown of the samples drawn so far.
    const gpu::Image& shown() const { return samples > 1 ? targets.mean : targets.linear; }

    gpu::Device& device;
    MaterialSet materials;
    FrameSets sets;
    GeometryPasses geometry;
    SurfaceImages surfaces;
    SurfaceMaps surfaceMaps;
    IndirectPass indirectPass;
    NearPass nearPass;
    SkyPass sky;
    DirectPass direct;
    GlassPass glass;
    MeanPass mean;
    TonemapPass tonemap;
    OverlayPass overlay;
    ShadowMaps shadows;
    IndirectLight noIndirect; ///< a black field
    IndirectLight indirect;
    LightPipelineCache lightPipelines;
    std::shared_ptr<LightPass> lightPass; ///< null: none
    RenderScene scene;
    PartedLights parted;
    const std::vector<Light>& lights = parted.lights; ///< those that shine on anything
    LightTable relightTable;                          ///< of the last shadowedLights()
    std::vector<Light> relightLights;
    std::uint64_t relightScene = 0, relightDrawings = 0, relightVersion = 0;
    gpu::Timestamps relightTimes; ///< of the shadow maps for them
    std::uint64_t relightSubmission = 0;
    std::uint64_t maskVersion = 0; ///< increases when a material's alpha mask changed
    bool warnedLeftOut = false;
    bool coarseShadows = false;
    NearestSeen nearestSeen;
    Targets targets;
    std::array<FrameSlot, kFrameSlots> slots;
    std::uint64_t frames = 0;
    ViewportOptions last;      ///< those of the last frame
    std::uint32_t samples = 0; ///< frames drawn since the last render(), which it counts
    double pendingUploadMs = 0;
    ViewportStats stats;
};

Viewport::Impl::Impl(gpu::Device& d)
    : device(d), materials(d), sets(d), geometry(d, sets.layout().handle, materials.layout()),
      surfaces(d), surfaceMaps(d, sets.layout(), kFrameTypes),
      indirectPass(d, sets.layout().handle), nearPass(d, sets.layout().handle),
      sky(d, sets.layout().handle), direct(d, sets.layout().handle), glass(d, sets.layout().handle),
      mean(d), tonemap(d), overlay(d), shadows(d), noIndirect(uploadIndirectLight(d, {})),
      indirect(noIndirect), lightPipelines(d, sets.layout().handle), relightTimes(d, 1) {
    for (FrameSlot& slot : slots) {
        slot.frame = gpu::Buffer(d, {.size = sizeof(GpuFrame),
                                     .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                     .memory = gpu::MemoryKind::Upload,
                                     .name = "frame"});
        writeLightTable(d, slot.lights, {}, {}, {});
        slot.times.emplace(d, kSteps);
    }
}

void Viewport::Impl::ensureTargets(std::uint32_t w, std::uint32_t h) {
    if (targets.linear && w <= targets.linear.width && h <= targets.linear.height)
        return;
    const auto [tw, th] =
        steppedUp({std::max(w, targets.linear.width), std::max(h, targets.linear.height)});
    targets.linear =
        gpu::Image(device, gpu::ImageDesc::renderTarget(tw, th, kLinearFormat, "linear colour"));
    targets.color =
        gpu::Image(device, gpu::ImageDesc::renderTarget(tw, th, kColorFormat, "colour"));
    surfaces.ensure({tw, th});
}

GeometryView Viewport::Impl::viewOf(const ViewportOptions& options) const {
    GeometryView view = geometryView(options, scene.bounds, indirect.field->hasGrid());
    describeField(*indirect.field, view);
    view.reflectedApart = lightPass && lightPass->reflects();
    return view;
}

std::vector<ShadowSlot> Viewport::Impl::assignShadows(const ShadowCamera* camera) {
    std::vector<ShadowSlot> result =
        shadows.assign(lights, scene.bounds, scene.version + maskVersion, coarseShadows, camera);
    if (shadows.leftOut > 0 && !warnedLeftOut)
        logWarning(fmt::format("{} lights are dark in the viewport: room for {} shadow maps only",
                               shadows.leftOut, ShadowTiles::room(ShadowTiles::kMaxLevel)));
    warnedLeftOut = shadows.leftOut > 0;
    return result;
}

void Viewport::Impl::writeFrame(FrameSlot& slot, const ViewportOptions& options,
                                const std::vector<ShadowSlot>& shadowSlots, glm::vec2 point) {
    writeLightTable(device, slot.lights, lights, shadowSlots, shadows.views());
    GpuFrame frame{};
    frame.lightCount = slot.lights.count;
    frame.normalBias = ShadowMaps::kNormalBias;
    frame.lightBias = ShadowMaps::kLightBias;
    describeField(*indirect.field, frame);
    describePixels(options, scene.bounds, point, device.properties.limits.subPixelPrecisionBits,
                   frame);
    frame.lookupSize = scene.lookupSize;
    if (options.view == View::Lit)
        frame.background = sky.colour();
    std::memcpy(slot.frame.mapped, &frame, sizeof frame);
}

void Viewport::Impl::recordShadows(VkCommandBuffer cmd, FrameSlot& slot, std::uint32_t slotIndex,
                                   bool needed) {
    slot.shadowMapsDrawn = 0;
    const auto draw = [&](VkCommandBuffer c, const ShadowView& view, glm::vec3 light, float reach) {
        geometry.drawDepth(c, scene, materials, {view.toClip, light, reach}, slotIndex);
    };
    if (needed)
        slot.shadowMapsDrawn = shadows.record(cmd, draw);
    else
        shadows.prepare(cmd);
}

// Begins a rendering that draws over the linear image and keeps its contents.
void Viewport::Impl::beginOnLinear(VkCommandBuffer cmd, const ViewportOptions& options) {
    gpu::memoryBarrier(cmd, gpu::kColorWrite, gpu::kColorWrite);
    const std::array color = {attachment(
        targets.linear.view, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_ATTACHMENT_LOAD_OP_LOAD)};
    beginRendering(cmd, {options.width, options.height}, color, nullptr, false);
}

// Records everything except direct light.
void Viewport::Impl::recordIndirect(VkCommandBuffer cmd, const ViewportOptions& options,
                                    std::uint32_t slotIndex) {
    discardContents(cmd, targets.linear, gpu::kFragmentRead);
    const std::array color = {attachment(targets.linear.view,
                                         VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                         VK_ATTACHMENT_LOAD_OP_DONT_CARE)};
    beginRendering(cmd, {options.width, options.height}, color, nullptr, false);
    indirectPass.record(cmd, sets.set(slotIndex), options.view, options.diffuse, surfaces.drawn(),
                        slotIndex);
    vkCmdEndRendering(cmd);
    if (lightPass && showsBouncedLight(options.view)) {
        beginOnLinear(cmd, options);
        lightPass->record({cmd, sets.set(slotIndex), options.view, options.diffuse});
        vkCmdEndRendering(cmd);
    }
    if (options.view == View::Lit && sky.active()) {
        beginOnLinear(cmd, options);
        sky.record(cmd, sets.set(slotIndex), slotIndex);
        vkCmdEndRendering(cmd);
    }
    if (nearPass.active(options)) {
        beginOnLinear(cmd, options);
        nearPass.record(cmd, sets.set(slotIndex), options, *indirect.field, samples, slotIndex);
        vkCmdEndRendering(cmd);
    }
}

void Viewport::Impl::recordDirect(VkCommandBuffer cmd, const ViewportOptions& options,
                                  std::uint32_t slotIndex) {
    if (showsDirectLight(options.view) && !lights.empty()) {
        beginOnLinear(cmd, options);
        direct.record(cmd, sets.set(slotIndex), options.view);
        vkCmdEndRendering(cmd);
    }
}

void Viewport::Impl::recordSurfaces(VkCommandBuffer cmd, const GeometryView& view,
                                    const ViewportOptions& options, std::uint32_t slotIndex) {
    stats.geometryDrawn +=
        surfaces.record(cmd, geometry, scene, materials, view, {options.width, options.height},
                        slotIndex, sets.set(slotIndex));
}

// Makes `image` anew where its size is not that of the linear image.
void Viewport::Impl::ensureLike(gpu::Image& image, const char* name) {
    const gpu::Image& linear = targets.linear;
    if (image.width != linear.width || image.height != linear.height)
        image = gpu::Image(
            device, gpu::ImageDesc::renderTarget(linear.width, linear.height, kLinearFormat, name));
}

// Records the picture of what transmits no light.
void Viewport::Impl::recordBehindGlass(VkCommandBuffer cmd, GeometryView view,
                                       const ViewportOptions& options, std::uint32_t slotIndex) {
    ensureLike(targets.behind, "behind glass");
    view.throughGlass = true;
    recordSurfaces(cmd, view, options, slotIndex);
    recordIndirect(cmd, options, slotIndex);
    recordDirect(cmd, options, slotIndex);
    makeReadable(cmd, targets.linear);
    std::swap(targets.linear, targets.behind);
}

void Viewport::Impl::recordTonemap(VkCommandBuffer cmd, const ViewportOptions& options,
                                   std::uint32_t slot) {
    discardContents(cmd, targets.color,
                    gpu::kAllReads); // by whoever showed it, sampling or blitting
    const std::array color = {attachment(targets.color.view,
                                         VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                         VK_ATTACHMENT_LOAD_OP_DONT_CARE)};
    beginRendering(cmd, {options.width, options.height}, color, nullptr, false);
    const bool radiance = options.view != View::Albedo && options.view != View::Normals;
    tonemap.record(
        cmd, shown().view,
        {.exposure = radiance ? std::exp2(options.exposureEv) : 1.f,
         .curve = std::uint32_t(radiance ? options.tonemap : Tonemap::None),
         .fade = options.inspection != Inspection::None || overlay.active() ? kOverlayFade : 0,
         .invalid = options.inspection == Inspection::InvalidPixels ? 1U : 0U},
        slot);
    vkCmdEndRendering(cmd);
}

// Draws the overlay over the tone-mapped picture, so that its colours match the legend, and makes
// the picture readable.
void Viewport::Impl::recordOverlay(VkCommandBuffer cmd, const GeometryView& view,
                                   const ViewportOptions& options, std::uint32_t slot) {
    const bool wireframe = options.inspection == Inspection::Wireframe;
    if (overlay.active() || wireframe) {
        gpu::memoryBarrier(cmd, gpu::kColorWrite, gpu::kColorWrite);
        gpu::imageBarrier(cmd, surfaces.depth.handle, VK_IMAGE_ASPECT_DEPTH_BIT, gpu::kFragmentRead,
                          gpu::kDepthWrite);
        const std::array color = {attachment(targets.color.view,
                                             VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             VK_ATTACHMENT_LOAD_OP_LOAD)};
        const auto depth = attachment(surfaces.depth.view, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                      VK_ATTACHMENT_LOAD_OP_LOAD);
        beginRendering(cmd, {options.width, options.height}, color, &depth, true);
        overlay.record(cmd, scene, view,
                       2 * std::tan(options.camera.fovY / 2) / float(options.height), slot,
                       wireframe);
        vkCmdEndRendering(cmd);
        gpu::imageBarrier(cmd, surfaces.depth.handle, VK_IMAGE_ASPECT_DEPTH_BIT, gpu::kDepthWrite,
                          gpu::kFragmentRead);
        surfaces.forget();
    }
    gpu::Access after = gpu::kAllReads;
    after.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    gpu::imageBarrier(cmd, targets.color.handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kColorWrite,
                      after);
}

void Viewport::Impl::readTimes(FrameSlot& slot) {
    if (slot.timed || slot.submission == 0 || device.completed() < slot.submission)
        return;
    const std::span<const double> ms = slot.times->steps();
    stats.shadowMs = ms[0];
    stats.geometryMs = ms[1];
    stats.indirectMs = ms[2];
    stats.directMs = ms[3];
    stats.tonemapMs = ms[4];
    stats.totalMs = std::accumulate(ms.begin(), ms.end(), 0.0);
    stats.uploadMs = slot.uploadMs;
    slot.timed = true;
}

Viewport::Viewport(gpu::Device& device) : m_impl(std::make_unique<Impl>(device)) {}
Viewport::~Viewport() = default;

void Viewport::setScene(const Scene& scene, std::shared_ptr<const LightmapLayout> layout) {
    Stopwatch clock;
    updateRenderScene(m_impl->device, m_impl->scene, scene, std::move(layout));
    setLighting(scene);
    m_impl->pendingUploadMs += clock.lap();
}

void Viewport::setLighting(const Scene& scene) {
    m_impl->maskVersion += m_impl->materials.update(scene);
    m_impl->sky.set(scene.sky);
    m_impl->nearPass.set(scene, m_impl->scene.layout,
                         m_impl->scene.version + m_impl->materials.version);
    m_impl->parted.set(scene, m_impl->scene.version + m_impl->maskVersion);
    m_impl->stats.lightsOff = m_impl->parted.lightsOff;
}

void Viewport::setIndirect(const IndirectField& field, std::shared_ptr<LightPass> parts) {
    Stopwatch clock;
    for (const auto& part : field.parts)
        if (!parts && !part->reflects())
            logWarning(fmt::format("the light of a {} is missing in pictures of this device",
                                   part->name()));
    m_impl->indirect = uploadIndirectLight(m_impl->device, field, m_impl->indirect);
    m_impl->lightPass = std::move(parts);
    m_impl->pendingUploadMs += clock.lap();
}

void Viewport::setIndirect(std::shared_ptr<const GpuField> field,
                           std::shared_ptr<LightPass> parts) {
    m_impl->indirect = {.field = std::move(field)};
    m_impl->lightPass = std::move(parts);
}

void Viewport::setIndirect(std::shared_ptr<LightPass> pass) {
    assert(pass);
    m_impl->indirect = m_impl->noIndirect;
    m_impl->lightPass = std::move(pass);
}

LightPipelineCache& Viewport::lightPipelines() {
    return m_impl->lightPipelines;
}

void Viewport::setCoarseShadows(bool coarse) {
    m_impl->coarseShadows = coarse;
}

void Viewport::setOverlay(std::shared_ptr<const OverlayData> overlay) {
    Stopwatch clock;
    m_impl->overlay.set(std::move(overlay));
    m_impl->pendingUploadMs += clock.lap();
}

// Draws the next sample of the picture and shows the mean of all samples.
void Viewport::Impl::draw(const ViewportOptions& options) {
    const auto slotIndex = std::uint32_t(frames++ % kFrameSlots);
    FrameSlot& slot = slots[slotIndex];
    device.wait(slot.submission); // two frames ago
    readTimes(slot);
    Stopwatch clock;
    ensureTargets(options.width, options.height);
    const glm::vec2 point = samplePoint(samples);
    const bool lit = nearPass.prepare(options) || showsDirectLight(options.view);
    GeometryView view = viewOf(options);
    std::vector<ShadowSlot> shadowSlots(lights.size());
    if (lit) {
        const ShadowCamera camera = shadowCamera(options, view, scene, nearestSeen);
        shadowSlots = assignShadows(&camera);
    }
    if (samples > 0)
        view = throughPoint(view, point, options.width, options.height);
    writeFrame(slot, options, shadowSlots, point);
    sets.write(slotIndex, slot.frame, slot.lights, shadows, surfaces, scene.lookupSnaps);
    indirectPass.bind(*indirect.field, slotIndex);
    nearPass.bind(*indirect.field, slotIndex);
    sky.bind(slotIndex);
    materials.writeFactors(slotIndex);
    slot.uploadMs = pendingUploadMs + clock.lap();
    pendingUploadMs = 0;

    const VkCommandBuffer cmd = device.begin("viewport");
    slot.times->begin(cmd);
    recordShadows(cmd, slot, slotIndex, lit);
    slot.times->mark(cmd);
    const bool glassSeen = options.view == View::Lit && showsGlass(scene, materials, view);
    if (glassSeen)
        recordBehindGlass(cmd, view, options, slotIndex);
    recordSurfaces(cmd, view, options, slotIndex);
    slot.times->mark(cmd);
    recordIndirect(cmd, options, slotIndex);
    slot.times->mark(cmd);
    recordDirect(cmd, options, slotIndex);
    if (glassSeen) {
        beginOnLinear(cmd, options);
        glass.record(cmd, sets.set(slotIndex), targets.behind, slotIndex);
        vkCmdEndRendering(cmd);
    }
    makeReadable(cmd, targets.linear);
    slot.times->mark(cmd);
    if (samples > 0)
        mean.record(cmd, targets.linear, targets.mean, samples, {options.width, options.height},
                    slotIndex);
    ++samples;
    recordTonemap(cmd, options, slotIndex);
    recordOverlay(cmd, view, options, slotIndex);
    slot.times->mark(cmd);
    slot.submission = device.submit(cmd);
    slot.timed = false;
    stats.shadowMapsDrawn = slot.shadowMapsDrawn;
}

void Viewport::render(const ViewportOptions& options) {
    assert(options.width > 0 && options.height > 0);
    m_impl->samples = 0;
    m_impl->last = options;
    m_impl->draw(options);
}

std::uint32_t Viewport::refine() {
    Impl& v = *m_impl;
    assert(v.samples > 0);
    if (v.samples == 1) { // what render() drew becomes the mean, as a whole
        v.ensureLike(v.targets.mean, "mean colour");
        std::swap(v.targets.linear, v.targets.mean);
    }
    v.draw(v.last);
    return v.samples;
}

ShadowedLights Viewport::shadowedLights() {
    Impl& v = *m_impl;
    const auto slotIndex = std::uint32_t(v.frames % kFrameSlots); // the next frame's
    FrameSlot& slot = v.slots[slotIndex];
    v.device.wait(slot.submission);
    v.readTimes(slot);
    slot.timed = true;
    std::vector<ShadowSlot> shadows = v.assignShadows(nullptr);
    for (ShadowSlot& s : shadows) // surfels lie everywhere, and do not depend on the camera
        s.cascades = 0;
    writeLightTable(v.device, v.relightTable, v.lights, shadows, v.shadows.views());
    v.materials.writeFactors(slotIndex);
    v.device.wait(v.relightSubmission); // its timestamps will be overwritten
    const VkCommandBuffer cmd = v.device.begin("shadow maps");
    v.relightTimes.begin(cmd);
    v.recordShadows(cmd, slot, slotIndex, true);
    v.relightTimes.mark(cmd);
    v.relightSubmission = slot.submission = v.device.submit(cmd);
    v.stats.relightShadowMaps = slot.shadowMapsDrawn;
    const std::uint64_t sceneVersion = v.scene.version + v.maskVersion;
    if (v.relightVersion == 0 || v.relightLights != v.lights || v.relightScene != sceneVersion ||
        v.relightDrawings != v.shadows.drawings)
        ++v.relightVersion;
    v.relightLights = v.lights;
    v.relightScene = sceneVersion;
    v.relightDrawings = v.shadows.drawings;
    return {.lights = v.relightTable.lights.handle,
            .shadowViews = v.relightTable.shadowViews.handle,
            .atlas = v.shadows.atlasView(),
            .sampler = v.shadows.sampler(),
            .count = v.relightTable.count,
            .normalBias = ShadowMaps::kNormalBias,
            .lightBias = ShadowMaps::kSurfelLightBias,
            .shapes = v.relightTable.shapes,
            .casters = v.relightScene,
            .version = v.relightVersion};
}

void Viewport::drawSurfaceMaps(std::span<const SurfaceMapView> views, glm::uvec2 size,
                               const ReadSurfaceMap& read) {
    Impl& v = *m_impl;
    const auto slotIndex = std::uint32_t(v.frames % kFrameSlots); // the next frame's
    v.device.wait(v.slots[slotIndex].submission);
    v.materials.writeFactors(slotIndex);
    v.surfaceMaps.draw(v.geometry, v.scene, v.materials, v.sets.filler(), slotIndex, views, size,
                       read);
}

void Viewport::readSurfaces(const Camera& camera, glm::uvec2 size, const ReadSurfaceMap& read) {
    Impl& v = *m_impl;
    const auto slotIndex = std::uint32_t(v.frames % kFrameSlots); // the next frame's
    FrameSlot& slot = v.slots[slotIndex];
    v.device.wait(slot.submission);
    ViewportOptions options = v.last; // the next frame shows the same, except after a switch
    options.camera = camera;
    options.width = size.x, options.height = size.y;
    v.surfaces.ensure(steppedUp({size.x, size.y}));
    v.writeFrame(slot, options, std::vector<ShadowSlot>(v.lights.size()), glm::vec2(0));
    v.sets.write(slotIndex, slot.frame, slot.lights, v.shadows, v.surfaces, v.scene.lookupSnaps);
    v.materials.writeFactors(slotIndex);
    v.device.immediate("surfaces", [&](VkCommandBuffer cmd) {
        v.stats.geometryDrawn +=
            v.surfaces.record(cmd, v.geometry, v.scene, v.materials, v.viewOf(options),
                              {size.x, size.y}, slotIndex, v.sets.set(slotIndex));
        gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kAllReads);
        read(cmd, v.surfaceMaps.mapOf(v.surfaces, v.sets.filler()), 0);
    });
}

VkImageView Viewport::colorView() const {
    return m_impl->targets.color.view;
}

VkImage Viewport::colorImage() const {
    return m_impl->targets.color.handle;
}

ImageF Viewport::readLinear() {
    Impl& v = *m_impl;
    assert(v.frames > 0);
    return readLinearImage(v.device, v.shown(), v.last.width, v.last.height);
}

ImageF Viewport::readMetering() {
    Impl& v = *m_impl;
    assert(v.frames > 0);
    return readSampledImage(v.device, v.shown(), v.last.width, v.last.height, v.targets.metering);
}

Image Viewport::readTonemapped() {
    Impl& v = *m_impl;
    assert(v.frames > 0);
    return readColorImage(v.device, v.targets.color, v.last.width, v.last.height);
}

const ViewportStats& Viewport::stats() const {
    Impl& v = *m_impl;
    if (v.frames > 0)
        v.readTimes(v.slots[(v.frames - 1) % kFrameSlots]);
    if (v.relightSubmission > 0 && v.device.completed() >= v.relightSubmission)
        v.stats.relightShadowMs = v.relightTimes.steps()[0];
    v.stats.lightsLeftOut = v.shadows.leftOut;
    v.device.collect();
    v.stats.gpuBytes = v.device.memory.bytesInUse;
    return v.stats;
}

} // namespace limn
