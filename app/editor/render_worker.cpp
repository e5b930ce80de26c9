// SPDX-License-Identifier: MIT
#include "app/editor/render_worker.h"

#include "app/editor/measure_relight.h"
#include "editor_ui/jobs/scene_changes.h"
#include "engine/scene/exposure.h"
#include "engine/scene/tone_map.h"
#include "engine/techniques/device/device_table.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace limn {

using Clock = std::chrono::steady_clock;

/// While a picture is gathered.
static constexpr std::chrono::seconds kShowGatheredEvery{1};

static double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

static std::unique_ptr<gpu::Device> openDevice(bool validate) {
    auto device = gpu::createDevice({.validation = validate});
    if (!device)
        throw std::runtime_error(device.error().message);
    return std::move(*device);
}

RenderWorker::RenderWorker(bool validate) : device(openDevice(validate)), viewport(*device) {}

void RenderWorker::takeLitBy(const PictureRequest& request) {
    if (request.litBy() == shown.litBy())
        return;
    dropLighting();
    m_litOf = nullptr;
    relight = {};
    refusal.clear();
    times.reset();
    if (!request.technique)
        return;
    const VkPhysicalDeviceProperties& p = device->properties;
    m_timesKey = relightTimesKey(p.deviceName, p.driverVersion,
                                 sizeClassOf(*request.technique, request.lit.bake.get()));
    times = rememberedRelightTimes(defaultRelightTimesFile(), m_timesKey);
}

void RenderWorker::takeScene(const PictureRequest& request) {
    const bool newScene = request.scene != shown.scene, newLayout = request.layout != shown.layout;
    if (!newScene && !newLayout)
        return;
    if (!shown.scene || newLayout || !sameGeometry(*shown.scene, *request.scene))
        viewport.setScene(*request.scene, request.layout);
    viewport.setLighting(*request.scene);
}

void RenderWorker::dropLighting() {
    m_driver = LightingDriver();
}

void RenderWorker::makeLighting(const PictureRequest& request) {
    if (m_driver.lighting() || !refusal.empty())
        return;
    auto made = lightOnDevice(*request.technique, *device, viewport, request.lit.prepared());
    if (!made) {
        refusal = made.error().message;
        return;
    }
    m_driver = LightingDriver(std::move(*made));
}

void RenderWorker::measure(const PictureRequest& request) {
    if (!request.measure || !request.technique || times)
        return;
    makeLighting(request);
    if (!m_driver.lighting())
        return;
    const auto onCpu = request.technique->light(request.lit.prepared());
    times =
        measureRelight(viewport, *m_driver.lighting(), *onCpu, *request.scene, *request.measure);
    // Where there is no folder to keep it in, it is measured again next time.
    if (times)
        (void)rememberRelightTimes(defaultRelightTimesFile(), m_timesKey, *times);
    viewport.setLighting(*request.scene);
    m_ownField = true;
    m_litOf = nullptr;
}

// Bounces for as long as the last picture took, so that half of the time goes to the light and half
// to showing it.
void RenderWorker::bounce(const PictureRequest& request, const std::atomic<bool>& hurry) {
    const bool finer = m_litMoving && !request.moving;
    m_litMoving = request.moving;
    if (m_litOf != request.scene || finer) {
        m_litOf = request.scene;
        m_litScene =
            !request.lit.bake || sameStaticGeometry(*request.lit.scene, *request.scene)
                ? request.scene
                : std::make_shared<const Scene>(relitScene(*request.lit.scene, *request.scene));
        m_driver.lightChanged();
    }
    const auto start = Clock::now();
    const ViewportOptions& o = request.options;
    const Viewpoint view = viewpointOf(o.camera, {o.width, o.height});
    m_driver.viewIs(view);
    const bool lightOverlay = request.overlay.kind && request.overlay.kind->showsLight;
    const LightingInput input{.scene = *m_litScene,
                              .view =
                                  lightOverlay ? viewForAll(*m_driver.lighting(), view) : &view};
    using Rest = LightingDriver::Rest;
    const bool newLight = !m_driver.converged();
    while (!m_driver.converged()) {
        countUpdate(relight, m_driver, m_driver.step(input, Rest::Later));
        if (hurry || msSince(start) >= m_pictureMs)
            break;
    }
    // Lights what has come into view and, if there is time, the rest.
    if (m_driver.converged())
        m_driver.step(input, newLight && hurry ? Rest::Later : hurry ? Rest::Seen : Rest::All);
    m_ownField = true;
}

void RenderWorker::takeField(const PictureRequest& request) {
    dropLighting();
    // The relighter's field stays until its replacement exists.
    const bool gone = !request.technique && !request.field && (m_ownField || shown.field);
    if (!gone && !(request.field && (m_ownField || request.field != shown.field)))
        return;
    showLight(request.technique, *device, viewport,
              request.field ? *request.field : IndirectField{});
    m_ownField = false;
}

// Overlays of a technique without a bake are made of its light alone.
void RenderWorker::takeSnapshot(const PictureRequest& request) {
    const OverlayKind* kind = request.overlay.kind;
    if (!kind || !m_driver.lighting() || request.technique->precomputation ||
        &techniqueOf(*kind) != request.technique) {
        snapshot = nullptr;
        snapshotScene = nullptr;
    } else if (!snapshot || m_snapshotCalls != relight.calls) {
        snapshot = m_driver.lighting()->snapshot();
        snapshotScene = m_litScene;
        m_snapshotCalls = relight.calls;
    }
}

void RenderWorker::makeOverlay(const PictureRequest& request) {
    const OverlayKind* kind = request.overlay.kind;
    const bool newMaterials = kind && kind->showsMaterials && request.scene != shown.scene &&
                              (!shown.scene || shown.scene->materials != request.scene->materials);
    const bool light = kind && kind->showsLight, here = m_driver.lighting() && !snapshot;
    const bool newLight = light && (request.light != shown.light || here);
    if (request.overlaySource == shown.overlaySource && request.overlay == shown.overlay &&
        !newMaterials && !newLight)
        return;
    overlay = nullptr;
    if (request.overlaySource && kind) {
        const auto lit = light && here ? m_driver.lighting()->snapshot() : request.light;
        overlay = std::make_shared<const OverlayData>(request.overlaySource->overlay(
            request.overlay, relitScene(*request.overlayScene, *request.scene), lit.get()));
    }
    viewport.setOverlay(overlay);
}

DrawnImages RenderWorker::readImages() {
    DrawnImages images;
    images.shown = std::make_shared<const Image>(viewport.readTonemapped());
    if (shown.linear)
        images.linear = std::make_shared<const LinearPicture>(
            LinearPicture{viewport.readLinear(), shown.options.camera, shown.options.view});
    return images;
}

bool worthRefining(std::uint32_t samples, double sampleMs) {
    return samples < kScreenSamples.perPixel && samples * sampleMs <= kMaxRefineMs;
}

/// Whether a picture may be refined and gathered once it is drawn. Something drawn over it would
/// jitter, and is drawn over a faded picture, to which no light can be added.
static bool canBeRefined(const PictureRequest& request) {
    return !request.moving && !request.overlay.kind &&
           request.options.inspection == Inspection::None;
}

bool RenderWorker::refining() const {
    return m_samples > 0 && worthRefining(m_samples, m_pictureMs) && canBeRefined(shown) &&
           !bouncing();
}

static bool canGather(const PictureRequest& request) {
    const BakedScene& lit = request.lit;
    return request.gather && canBeRefined(request) && showsBouncedLight(request.options.view) &&
           request.technique && (request.field || request.relight) && lit.bake && lit.trace &&
           !lit.preview && sameStaticGeometry(*lit.scene, *request.scene);
}

/// Returns false if the technique has nothing to gather from.
bool RenderWorker::takeGatheredFrom() {
    const Scene& scene = *shown.scene;
    if (m_fromScene != shown.scene || m_fromBake != shown.lit.bake) {
        m_from.trace = std::make_shared<const TraceScene>(scene, *shown.lit.trace);
        m_from.layout = {shown.lit.bake, &shown.lit.bake->layout()}; // lives as long as the bake
        const Lighting* here = m_driver.lighting();
        m_from.emitted = here ? here->emittedField(scene)
                              : shown.technique->light(shown.lit.prepared())->emittedField(scene);
        m_fromScene = shown.scene;
        m_fromBake = shown.lit.bake;
    }
    m_from.field = m_driver.lighting()
                       ? std::make_shared<const IndirectField>(m_driver.lighting()->readField())
                       : shown.field;
    return m_from.emitted && m_from.field;
}

bool RenderWorker::beginGathering(const std::atomic<bool>& hurry) {
    m_gathers = takeGatheredFrom();
    if (!m_gathers)
        return false;
    const ViewportOptions& o = shown.options;
    FieldRenderOptions options;
    options.view = o.view;
    options.camera = o.camera;
    options.width = o.width;
    options.height = o.height;
    options.samplesPerPixel = kScreenSamples.perPixel;
    options.gatherRays = kScreenSamples.gatherRays;
    auto gather = std::make_unique<RestGather>(m_from, std::move(options));
    m_gathers = gather->any();
    if (!m_gathers)
        return false;
    ImageF drawn = viewport.readLinear();
    ViewportOptions rest = o;
    rest.diffuse = false;
    viewport.render(rest);
    for (std::uint32_t n = 1; n < m_samples; ++n) {
        if (hurry)
            return false;
        viewport.refine();
    }
    gather->begin(std::move(drawn), viewport.readLinear());
    m_gather = std::move(gather);
    return true;
}

std::optional<DrawnImages> RenderWorker::gather(const std::atomic<bool>& hurry) {
    if (!m_gather && !beginGathering(hurry))
        return {};
    if (!m_gather->addRows(kShowGatheredEvery, hurry))
        return {};
    const ViewportOptions& o = shown.options;
    DrawnImages images;
    images.shown = std::make_shared<const Image>(
        toneMappedImage(m_gather->picture(), o.tonemap, o.exposureEv));
    if (shown.linear)
        images.linear = std::make_shared<const LinearPicture>(
            LinearPicture{m_gather->picture(), o.camera, o.view});
    return images;
}

std::optional<DrawnImages> RenderWorker::refine(const std::atomic<bool>& hurry) {
    const std::uint32_t wanted = std::min(2 * std::bit_floor(m_samples), kScreenSamples.perPixel);
    if (m_samples == 1 && showsNearLight()) { // the first sample, which was to be fast, has none
        ViewportOptions near = shown.options;
        near.nearRays = kScreenSamples.nearRays;
        viewport.render(near);
    }
    while (m_samples < wanted) {
        if (hurry)
            return {};
        m_samples = viewport.refine();
    }
    return readImages();
}

DrawnImages RenderWorker::draw(PictureRequest request, const std::atomic<bool>& hurry) {
    takeLitBy(request);
    takeScene(request);
    measure(request);
    request.measure = nullptr;
    viewport.setCoarseShadows(request.moving);
    const bool here = request.relight && request.technique;
    if (here)
        makeLighting(request);
    if (here && m_driver.lighting())
        bounce(request, hurry);
    else
        takeField(request);
    const auto start = Clock::now();
    m_gather.reset();
    m_gathers = canGather(request);
    takeSnapshot(request);
    makeOverlay(request);
    viewport.render(request.options);
    shown = std::move(request);
    m_samples = 1;
    DrawnImages images = readImages();
    m_pictureMs = msSince(start);
    const View view = shown.options.view;
    if (shown.meter && view != View::Albedo && view != View::Normals)
        images.metered = meteredExposure(viewport.readMetering());
    relight.running = bouncing();
    return images;
}

} // namespace limn
