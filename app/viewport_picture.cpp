// SPDX-License-Identifier: MIT
#include "app/viewport_picture.h"

#include <algorithm>
#include <cmath>

namespace limn {

using Clock = std::chrono::steady_clock;

namespace {

constexpr double kMovingMs = 45;       // a picture while things move should take no longer
constexpr double kRestSeconds = 0.2;   // how long nothing moves before all pixels are drawn
constexpr float kLeastScale = 0.2f;    // of the window's pixels, per axis
constexpr float kScaleStep = 1.f / 16; // so that the size does not change with every picture

} // namespace

bool ViewportPicture::uploadChanges(const Session& session) {
    const bool newScene = session.scene() != m_scene, newLayout = session.layout() != m_layout;
    if (newScene || newLayout) {
        const bool geometry = !m_scene || newLayout || !sameGeometry(*m_scene, *session.scene());
        if (geometry)
            m_viewport.setScene(*session.scene(), session.layout());
        m_viewport.setLighting(*session.scene());
        m_scene = session.scene();
        m_layout = session.layout();
    }
    const bool newField = session.field() != m_field;
    if (newField) {
        m_field = session.field();
        m_viewport.setIndirect(m_field ? *m_field : IndirectField{});
    }
    return newScene || newLayout || newField;
}

float ViewportPicture::chooseScale(glm::uvec2 full, bool moving) const {
    const double all = m_msPerPixel * double(full.x) * double(full.y);
    if (!moving || all <= kMovingMs)
        return 1;
    const float wanted = float(std::sqrt(kMovingMs / all));
    return std::clamp(std::floor(wanted / kScaleStep) * kScaleStep, kLeastScale, 1.f);
}

void ViewportPicture::update(Session& session) {
    EditorState& state = session.state;
    const ViewState& view = state.view;
    const glm::uvec2 full = glm::max(glm::uvec2(view.size), glm::uvec2(1));
    const bool uploaded = uploadChanges(session);
    const Shown shown{view.view, view.tonemap, view.exposureEv, view.camera, full};
    const auto now = Clock::now();
    const bool changed = uploaded || m_shown != shown;
    if (changed)
        m_changed = now;
    const bool moving = std::chrono::duration<double>(now - m_changed).count() < kRestSeconds;
    if (changed || (m_reduced && !moving)) {
        const float scale = chooseScale(full, moving && m_shown.has_value());
        m_size = glm::max(glm::uvec2(glm::vec2(full) * scale), glm::uvec2(1));
        m_reduced = scale < 1;
        m_viewport.render({.view = view.view,
                           .camera = view.camera,
                           .width = m_size.x,
                           .height = m_size.y,
                           .tonemap = view.tonemap,
                           .exposureEv = view.exposureEv});
        m_shown = shown;
        ++state.frame.pictures;
    }
    const ViewportStats& stats = m_viewport.stats();
    if (stats.totalMs > 0 && m_size.x > 0)
        m_msPerPixel = stats.totalMs / (double(m_size.x) * double(m_size.y));
    FrameStatus& frame = state.frame;
    frame.uploadMs = stats.uploadMs;
    frame.shadowMs = stats.shadowMs;
    frame.shadeMs = stats.shadeMs;
    frame.viewportMs = stats.totalMs;
    frame.shadowMapsDrawn = stats.shadowMapsDrawn;
    frame.gpuBytes = stats.gpuBytes;
    frame.width = m_size.x;
    frame.height = m_size.y;
}

WindowPicture ViewportPicture::picture(const ViewState& view) const {
    if (m_size.x == 0)
        return {};
    const glm::ivec2 begin(view.origin);
    return {m_viewport.colorImage(), m_size, begin, begin + glm::ivec2(view.size)};
}

double ViewportPicture::secondsToNext() const {
    if (!m_reduced)
        return -1;
    const double since = std::chrono::duration<double>(Clock::now() - m_changed).count();
    return std::max(kRestSeconds - since, 0.001);
}

} // namespace limn
