// SPDX-License-Identifier: MIT
#include "app/bench/live_light.h"

#include "app/bench/light_place.h"

#include "engine/measure/compare.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

double distanceOf(const ImageF& a, const ImageF& b) {
    double sum = 0;
    for (std::size_t p = 0; p < a.rgb.size(); ++p)
        sum += double(glm::dot(a.rgb[p] - b.rgb[p], a.rgb[p] - b.rgb[p]));
    return sum > 0 ? std::sqrt(sum / (3 * double(a.rgb.size()))) / meanOf(b) : 0;
}

double largestDifference(const ImageF& a, const ImageF& b) {
    double maximum = 0;
    for (std::size_t p = 0; p < a.rgb.size(); ++p)
        for (int c = 0; c < 3; ++c)
            maximum = std::max(maximum, std::abs(double(a.rgb[p][c]) - double(b.rgb[p][c])));
    return maximum > 0 ? maximum / meanOf(b) : 0;
}

LiveLight::LiveLight(std::unique_ptr<Lighting> lighting, const Scene& scene,
                     const TraceScene& trace, const LightmapLayout& layout,
                     const FieldRenderOptions& view)
    : m_scene(scene), m_trace(trace), m_layout(layout), m_view(view),
      m_driver(std::move(lighting)) {
    m_view.samplesPerPixel = 1; // the same points in every frame
}

void LiveLight::update(const Scene& scene, const TraceScene& trace, const Camera& camera) {
    const Viewpoint view = viewpointOf(camera, {m_view.width, m_view.height});
    m_driver.step({.scene = scene, .trace = &trace, .view = &view}, LightingDriver::Rest::All);
}

/// False if cancelled.
bool LiveLight::converge(const Scene& scene, const Progress& progress) {
    m_driver.lightChanged();
    for (std::uint32_t k = 0; !m_driver.done() && k < kMaxUpdates; ++k) {
        if (progress.cancelled())
            return false;
        update(scene, m_trace, m_view.camera);
    }
    return true;
}

ImageF LiveLight::picture(const TraceScene& trace) const {
    return renderLight(trace, *m_driver.lighting(), m_layout, m_view);
}

std::optional<double> LiveLight::flicker(const MotionTruth& truth, const Progress& progress) {
    if (truth.pixels.empty() || !converge(m_scene, progress))
        return {};
    std::vector<ImageF> frames = {pickedPixels(picture(m_trace), truth.pixels)};
    for (int k = 1; k < kMotionFrames; ++k) {
        if (progress.cancelled())
            return {};
        const MotionFrame frame = motionFrame(truth.motion, m_scene, m_view.camera, k);
        std::optional<TraceScene> moved;
        if (truth.motion == Motion::Objects)
            moved.emplace(frame.scene, m_trace);
        const TraceScene& trace = moved ? *moved : m_trace;
        if (truth.motion != Motion::Camera) // the driver knows another view by itself
            m_driver.lightChanged();
        update(frame.scene, trace, frame.camera);
        frames.push_back(pickedPixels(picture(trace), truth.pixels));
    }
    return flickerOf(frames, truth.first, truth.second);
}

std::optional<std::uint32_t> LiveLight::lag(const Progress& progress) {
    constexpr double kNear = 0.05;
    const Scene jumped = withLightsMoved(m_scene, 0.5f);
    if (!converge(jumped, progress))
        return {};
    const ImageF goal = picture(m_trace);
    if (!converge(m_scene, progress))
        return {};
    m_driver.lightChanged();
    for (std::uint32_t updates = 1; updates <= kMaxUpdates && !progress.cancelled(); ++updates) {
        update(jumped, m_trace, m_view.camera);
        if (distanceOf(picture(m_trace), goal) <= kNear)
            return updates;
    }
    return {};
}

} // namespace limn
