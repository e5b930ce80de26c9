// SPDX-License-Identifier: MIT
#include "app/editor/viewport_picture.h"

#include "editor_ui/panels/overlay_panel.h"
#include "engine/techniques/device/device_table.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include <glm/common.hpp>

namespace limn {

using Clock = std::chrono::steady_clock;

namespace {

constexpr double kMovingMs = 60;      // a picture while things move should take no longer
constexpr double kRestSeconds = 0.25; // how long nothing moves before all pixels are drawn
constexpr float kMinScale = 0.25f;    // of the window's pixels, per axis
/// Automatic exposure follows the picture in steps of at least this [EV].
constexpr float kExposureStep = 0.1f;
constexpr float kScaleStep = 1.f / 16; // so that the size does not change with every picture

/// The bake of the technique that lights the scene; null members where it precomputes nothing.
BakedScene litBake(const Session& session) {
    const Technique* technique = session.lightingTechnique();
    return technique && technique->precomputation ? session.baked() : BakedScene{};
}

LitBy litBy(const Session& session) {
    return {session.lightingTechnique(), litBake(session).bake};
}

} // namespace

float ViewportPicture::chooseScale(glm::uvec2 full) const {
    const double all = m_msPerPixel * double(full.x) * double(full.y),
                 maxMs = std::max(kMovingMs - m_shadowMs, kMovingMs / 4);
    if (m_msPerPixel == 0) // not known: the first picture of hundreds of lights may take a minute
        return kMinScale;
    if (all <= maxMs)
        return 1;
    const float wanted = float(std::sqrt(maxMs / all));
    return std::clamp(std::floor(wanted / kScaleStep) * kScaleStep, kMinScale, 1.f);
}

void ViewportPicture::takeRelit(Session& session) {
    EditorState& state = session.state;
    RelightPlace& place = state.relightPlace;
    const Technique* technique = findTechnique(session.scene()->technique.technique);
    if (m_drawn.lit == litBy(session)) {
        if (place.refusal != m_drawn.refusal && !m_drawn.refusal.empty())
            state.log.push_back(
                {LogLine::Level::Warning, "Bounced light stays on the CPU: " + m_drawn.refusal});
        place.refusal = m_drawn.refusal;
        if (m_drawn.lit.technique)
            place.times = m_drawn.times;
    }
    place.gpuCan =
        m_drawn.error.empty() && place.refusal.empty() && technique && lightsOnDevice(*technique);
    if (!session.viewportRelights())
        return;
    state.relight = m_drawn.relight;
    const OverlayKind* kind = state.overlay.options.kind;
    if (!kind || !m_drawn.snapshot || !isMadeOf(*kind, m_drawn.snapshot.get()))
        return;
    if (m_drawn.snapshot != state.overlay.source)
        setOverlaySource(state.overlay, m_drawn.snapshot, m_drawn.snapshotScene);
    state.overlay.light = m_drawn.snapshot;
}

void ViewportPicture::takeDrawn(Session& session) {
    EditorState& state = session.state;
    DrawnPicture drawn = m_job.result();
    if (!drawn.error.empty() && m_drawn.error.empty())
        state.log.push_back({LogLine::Level::Error, "No more pictures: " + drawn.error});
    m_drawn = std::move(drawn);
    if (m_drawn.linear)
        session.setPicture(m_drawn.linear);
    takeRelit(session);
    ViewState& view = state.view;
    if (view.autoExposure && m_drawn.metered &&
        std::abs(*m_drawn.metered - view.exposureEv) > kExposureStep)
        view.exposureEv = *m_drawn.metered;
    if (!m_drawn.image)
        return;
    const Image& image = *m_drawn.image;
    const ViewportStats& stats = m_drawn.stats;
    m_shadowMs = stats.shadowMs;
    m_msPerPixel = (stats.totalMs - stats.shadowMs) / (double(image.width) * double(image.height));
    FrameStatus& frame = state.frame;
    frame.uploadMs = stats.uploadMs;
    frame.shadowMs = stats.shadowMs;
    frame.surfacesMs = stats.geometryMs;
    frame.shadeMs = stats.indirectMs + stats.directMs;
    frame.viewportMs = stats.totalMs;
    frame.shadowMapsDrawn = stats.shadowMapsDrawn;
    frame.surfacesDrawn = stats.geometryDrawn;
    frame.gpuBytes = stats.gpuBytes;
    frame.nearLight = m_drawn.nearLight;
    frame.gathers = m_drawn.gathers;
    frame.gathered = m_drawn.gathered;
    frame.width = image.width;
    frame.height = image.height;
    frame.pictures = m_drawn.number;
    state.overlay.legend = m_drawn.legend;
}

/// Measures once per bake, or per technique that needs none and may light by lamps alone, when
/// nothing else runs that it would delay or that would distort it.
bool ViewportPicture::measureNow(const Session& session) {
    const EditorState& state = session.state;
    const RelightPlace& place = state.relightPlace;
    const LitBy lit = litBy(session);
    const bool due = place.wanted == RelightOn::Auto && place.gpuCan && !place.times &&
                     lit.technique && !litBake(session).preview && state.trace &&
                     m_drawn.lit == lit && m_measured != lit &&
                     (lit.bake || !session.scene()->lights.empty());
    const BakeFreshness freshness = state.bake.freshness;
    if (!due || m_drawn.running || m_reduced || !session.idle() ||
        (freshness != BakeFreshness::UpToDate && freshness != BakeFreshness::NotUsed))
        return false;
    m_measured = lit;
    return true;
}

/// Keeps a picture of the other technique beside the newest one, of its size and exposure.
void ViewportPicture::updateOther(Session& session) {
    const ShownScene& lit = session.other();
    if (!lit.scene || !m_shown) {
        m_otherJob = nullptr;
        m_other = {};
        m_otherLit = {};
        return;
    }
    const bool fresh = !m_otherJob;
    if (fresh)
        m_otherJob = std::make_unique<RenderJob>(m_validate, m_wake);
    if (fresh || m_otherLit != lit || m_otherOptions != m_options) {
        m_otherLit = lit;
        m_otherOptions = m_options;
        PictureRequest request;
        request.scene = lit.scene;
        request.layout = lit.layout;
        request.field = lit.field;
        request.options = m_options;
        request.moving = m_reduced;
        m_otherJob->draw(std::move(request));
    }
    const bool failed = !m_other.error.empty();
    m_other = m_otherJob->result();
    if (!failed && !m_other.error.empty())
        session.state.log.push_back(
            {LogLine::Level::Error, "No picture of the other technique: " + m_other.error});
    // References count their pictures from 1, too.
    constexpr std::uint64_t kOfOther = std::uint64_t(1) << 63;
    m_compared = {m_other.image, kOfOther | m_other.number, {}};
}

std::vector<std::string> ViewportPicture::validationMessages() const {
    std::vector<std::string> all = m_job.validationMessages();
    if (m_otherJob)
        std::ranges::move(m_otherJob->validationMessages(), std::back_inserter(all));
    return all;
}

void ViewportPicture::update(Session& session) {
    EditorState& state = session.state;
    takeDrawn(session);
    const ViewState& view = state.view;
    const glm::uvec2 full = glm::max(glm::uvec2(view.size), glm::uvec2(1));
    Shown shown{view.view,
                view.inspection,
                view.tonemap,
                view.exposureEv,
                view.autoExposure,
                view.camera,
                full,
                session.scene(),
                session.layout(),
                session.field(),
                {},
                nullptr,
                session.lit(),
                litBy(session),
                session.viewportRelights(),
                needsReference(state.compare.mode),
                !session.other().scene};
    if (state.overlay.options.kind) {
        shown.overlay = state.overlay.options;
        shown.overlaySource = state.overlay.source;
    }
    m_compared = session.compared();
    m_split = state.compare.split;
    updateOther(session);
    const bool changed = m_shown != shown;
    const auto now = Clock::now();
    const bool resting = std::chrono::duration<double>(now - m_changed).count() >= kRestSeconds;
    const bool measure = !changed && measureNow(session);
    if (!changed && !measure && !(m_reduced && resting))
        return;
    if (changed)
        m_changed = now;
    const float scale = changed ? chooseScale(full) : 1;
    m_reduced = scale < 1;
    const glm::uvec2 size = glm::max(glm::uvec2(glm::vec2(full) * scale), glm::uvec2(1));
    m_options = {.view = view.view,
                 .camera = view.camera,
                 .width = size.x,
                 .height = size.y,
                 .tonemap = view.tonemap,
                 .exposureEv = view.exposureEv,
                 .inspection = view.inspection};
    m_job.draw({shown.scene, shown.layout, shown.field, m_options, shown.linear && !m_reduced,
                view.autoExposure, m_reduced, shown.gather, shown.overlay, shown.overlaySource,
                state.overlay.scene, shown.light, shown.lit.technique, litBake(session),
                shown.relight, measure ? state.trace : nullptr});
    m_drawn = m_job.result();
    if (shown.relight)
        state.relight = m_drawn.relight;
    m_shown = std::move(shown);
}

/// The picture with what it is compared with from `column` on. Both have the same size.
Image ViewportPicture::withCompared(const Image& image, std::uint32_t column) const {
    Image both = image;
    for (std::size_t y = 0; y < image.height; ++y) {
        const std::size_t row = y * image.width * 4;
        std::copy(m_compared.image->rgba.begin() + std::ptrdiff_t(row + column * 4),
                  m_compared.image->rgba.begin() + std::ptrdiff_t(row + image.width * 4),
                  both.rgba.begin() + std::ptrdiff_t(row + column * 4));
    }
    return both;
}

WindowPicture ViewportPicture::record(VkCommandBuffer cmd, const ViewState& view) {
    if (!m_drawn.image)
        return {};
    const Image& drawn = *m_drawn.image;
    const bool compare = m_compared.image && m_compared.image->width == drawn.width &&
                         m_compared.image->height == drawn.height;
    const auto column = std::uint32_t(std::lround(m_split * float(drawn.width)));
    const OnDevice wanted{m_drawn.number, compare ? m_compared.number : 0, compare ? column : 0};
    if (m_onDevice != wanted) {
        const Image image = compare ? withCompared(drawn, column) : drawn;
        gpu::ImageDesc desc = gpu::ImageDesc::texture(image.width, image.height,
                                                      VK_FORMAT_R8G8B8A8_UNORM, 1, "picture");
        desc.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        m_image = gpu::Image(m_device, desc);
        gpu::uploadImage(m_device, cmd, m_image, std::as_bytes(std::span(image.rgba)));
        m_onDevice = wanted;
    }
    const glm::ivec2 begin(view.origin);
    return {m_image.handle, {drawn.width, drawn.height}, begin, begin + glm::ivec2(view.size)};
}

double ViewportPicture::secondsToNext() const {
    if (!m_reduced)
        return -1;
    const double since = std::chrono::duration<double>(Clock::now() - m_changed).count();
    return std::max(kRestSeconds - since, 0.005);
}

} // namespace limn
