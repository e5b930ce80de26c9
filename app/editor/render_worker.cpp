// SPDX-License-Identifier: MIT
#include "app/editor/render_worker.h"

#include "app/editor/measure_relight.h"

#include <chrono>
#include <stdexcept>
#include <utility>

namespace limn {

using Clock = std::chrono::steady_clock;

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

void RenderWorker::takeBake(const PictureRequest& request) {
    if (request.lit.bake == shown.lit.bake)
        return;
    m_relighter = nullptr;
    m_litOf = nullptr;
    m_seen = {};
    m_whole = m_everWhole = false;
    relight = {};
    refusal.clear();
    times.reset();
    if (!request.lit.bake)
        return;
    const VkPhysicalDeviceProperties& p = device->properties;
    m_timesKey = relightTimesKey(p.deviceName, p.driverVersion, *request.lit.bake);
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

void RenderWorker::makeRelighter(const PictureRequest& request) {
    if (m_relighter || !refusal.empty())
        return;
    auto made = ViewportRelighter::create(*device, request.lit.bake);
    if (made)
        m_relighter = std::move(*made);
    else
        refusal = made.error().message;
    relight.converged = m_whole = m_everWhole = false;
    relight.bounces = 0;
}

void RenderWorker::measure(const PictureRequest& request) {
    if (!request.measure || !request.lit.bake || times)
        return;
    makeRelighter(request);
    if (!m_relighter)
        return;
    times = measureRelight(viewport, *m_relighter, *request.scene, *request.measure);
    // Where there is no folder to keep it in, it is measured again next time.
    (void)rememberRelightTimes(defaultRelightTimesFile(), m_timesKey, *times);
    viewport.setLighting(*request.scene);
    m_ownField = true;
    m_litOf = nullptr;
}

// For as long as the last picture took: half of the time goes to the light, half to showing it.
void RenderWorker::bounce(const PictureRequest& request, const std::atomic<bool>& hurry) {
    const bool finer = m_litMoving && !request.moving;
    m_litMoving = request.moving;
    if (m_litOf != request.scene || finer) {
        m_litOf = request.scene;
        m_litScene =
            sameStaticGeometry(*request.lit.scene, *request.scene)
                ? request.scene
                : std::make_shared<const Scene>(relitScene(*request.lit.scene, *request.scene));
        relight.converged = m_whole = false;
        relight.bounces = 0;
    }
    const auto start = Clock::now();
    const CacheFlags* seen = seenBy(request);
    const auto light = [&](std::uint32_t bounces, const CacheFlags* wanted) {
        const RelightStats stats = m_relighter->relight(viewport, *m_litScene, bounces, {}, wanted);
        m_whole = stats.cachesUnseen == 0;
        m_everWhole |= m_whole;
        return stats;
    };
    const bool newLight = !relight.converged;
    while (!relight.converged) {
        relight.last = light(bouncesPerCall(request.scene->bake.maxBounces), seen);
        countUpdate(relight, request.scene->bake.maxBounces);
        if (hurry || msSince(start) >= m_pictureMs)
            break;
    }
    // What has come into view, and where there is time for it the rest.
    if (relight.converged && !m_whole && !(newLight && hurry))
        light(0, hurry ? seen : nullptr);
    m_ownField = true;
}

/// Null: all, as at first, so that there is light wherever somebody looks later.
const CacheFlags* RenderWorker::seenBy(const PictureRequest& request) {
    if (!m_everWhole || showsLight(request.overlay.kind))
        return nullptr;
    const ViewportOptions& o = request.options;
    return &seenFrom(m_seen, *request.lit.scene, *request.lit.bake,
                     {o.camera, float(o.width) / float(o.height)});
}

void RenderWorker::takeField(const PictureRequest& request) {
    m_relighter = nullptr;
    // The relighter's field stays until the one that replaces it is there.
    const bool gone = !request.lit.bake && (m_ownField || shown.field);
    if (!gone && !(request.field && (m_ownField || request.field != shown.field)))
        return;
    viewport.setIndirect(request.field ? *request.field : IndirectField{});
    m_ownField = false;
}

static LitBake readLit(const GpuRelighter& gpu) {
    LitBake lit;
    for (const glm::vec3 b : gpu.readRadiosity())
        lit.radiosity.emplace_back(b, 0);
    lit.cacheSh = gpu.readCacheSh();
    lit.bands = int(gpu.field()->bands);
    return lit;
}

void RenderWorker::makeOverlay(const PictureRequest& request) {
    // Albedo is the one thing it shows that can change without a bake.
    const bool newAlbedo = request.overlay.kind == Overlay::Surfels &&
                           request.scene != shown.scene &&
                           (!shown.scene || shown.scene->materials != request.scene->materials);
    const bool light = showsLight(request.overlay.kind);
    const bool newLight = light && (request.light != shown.light || m_relighter);
    if (request.bake == shown.bake && request.overlay == shown.overlay && !newAlbedo && !newLight)
        return;
    overlay = nullptr;
    if (request.bake && request.overlay.kind != Overlay::None) {
        const std::shared_ptr<const LitBake> lit =
            light && m_relighter ? std::make_shared<const LitBake>(readLit(m_relighter->gpu()))
                                 : request.light;
        overlay = std::make_shared<const OverlayData>(
            limn::makeOverlay(*request.bake, relitScene(*request.bakedScene, *request.scene),
                              request.overlay, lit.get()));
    }
    viewport.setOverlay(overlay);
}

Image RenderWorker::draw(PictureRequest request, const std::atomic<bool>& hurry) {
    takeBake(request);
    takeScene(request);
    measure(request);
    request.measure = nullptr;
    viewport.setCoarseShadows(request.moving);
    const bool here = request.relight && request.lit.bake;
    if (here)
        makeRelighter(request);
    if (here && m_relighter)
        bounce(request, hurry);
    else
        takeField(request);
    const auto start = Clock::now();
    makeOverlay(request);
    viewport.render(request.options);
    shown = std::move(request);
    Image image = viewport.readTonemapped();
    m_pictureMs = msSince(start);
    relight.running = bouncing();
    return image;
}

} // namespace limn
