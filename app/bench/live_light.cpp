// SPDX-License-Identifier: MIT
#include "app/bench/live_light.h"

#include "app/bench/light_place.h"

#include "engine/measure/compare.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

/// Sum over frames, pixels and channels of the product of two series' changes from frame to frame.
static double changes(std::span<const ImageF> a, std::span<const ImageF> b) {
    double sum = 0;
    for (std::size_t k = 1; k < a.size(); ++k)
        for (std::size_t p = 0; p < a[k].rgb.size(); ++p)
            sum += double(glm::dot(a[k].rgb[p] - a[k - 1].rgb[p], b[k].rgb[p] - b[k - 1].rgb[p]));
    return sum;
}

Scene withLightsMoved(const Scene& scene, float share) {
    Scene moved = scene;
    const glm::vec3 goal = scene.bounds.lower + scene.bounds.size() * glm::vec3(0.4f, 0.5f, 0.45f);
    const float c = std::cos(share), s = std::sin(share);
    for (Light& light : moved.lights) {
        const glm::vec3 d = light.direction;
        if (light.kind == LightKind::Directional)
            light.direction = glm::vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
        else
            light.position = glm::mix(light.position, goal, share);
    }
    if (scene.lights.empty()) { // every kind of sky reads one of these
        moved.sky.radiance *= 1 + share;
        moved.sky.strength *= 1 + share;
        for (Material& material : moved.materials)
            material.emission *= 1 + share;
    }
    return moved;
}

double distanceOf(const ImageF& a, const ImageF& b) {
    double sum = 0;
    for (std::size_t p = 0; p < a.rgb.size(); ++p)
        sum += double(glm::dot(a.rgb[p] - b.rgb[p], a.rgb[p] - b.rgb[p]));
    return sum > 0 ? std::sqrt(sum / (3 * double(a.rgb.size()))) / meanOf(b) : 0;
}

double flickerOf(std::span<const ImageF> frames, std::span<const ImageF> truth,
                 std::span<const ImageF> truth2) {
    double mean = 0;
    for (std::size_t k = 0; k < truth.size(); ++k)
        mean += (meanOf(truth[k]) + meanOf(truth2[k])) / (2 * double(truth.size()));
    const double count = 3 * double(frames[0].rgb.size()) * double(frames.size() - 1);
    const double shown = std::sqrt(changes(frames, frames) / count),
                 wanted = std::sqrt(std::max(changes(truth, truth2), 0.) / count);
    return shown == wanted ? 0 : (shown - wanted) / mean;
}

MotionTruth renderMotion(const TraceScene& trace, const ReferenceOptions& view) {
    MotionTruth truth;
    for (int k = 0; k < kMotionFrames; ++k) {
        const Scene scene = withLightsMoved(trace.scene(), kMotionStep * float(k));
        const TraceScene moved(scene, trace);
        // Frames share their seed, and so do most of their noise.
        ReferenceOptions options = view;
        for (std::vector<ImageF>* series : {&truth.first, &truth.second}) {
            options.seed = series == &truth.first ? 1 : 2;
            series->push_back(renderReference(moved, options).image);
        }
    }
    return truth;
}

LiveLight::LiveLight(std::unique_ptr<Lighting> lighting, const Scene& scene,
                     const TraceScene& trace, const LightmapLayout& layout,
                     const FieldRenderOptions& view)
    : m_scene(scene), m_trace(trace), m_layout(layout), m_view(view),
      m_driver(std::move(lighting)) {
    m_view.samplesPerPixel = 1; // the same points in every frame
}

void LiveLight::update(const Scene& scene) {
    const Viewpoint view = viewpointOf(m_view.camera, {m_view.width, m_view.height});
    m_driver.step({.scene = scene, .trace = &m_trace, .view = &view}, LightingDriver::Rest::All);
}

/// False if cancelled.
bool LiveLight::converge(const Scene& scene, const Progress& progress) {
    m_driver.lightChanged();
    for (std::uint32_t k = 0; !m_driver.done() && k < kMaxUpdates; ++k) {
        if (progress.cancelled())
            return false;
        update(scene);
    }
    return true;
}

ImageF LiveLight::picture() const {
    return renderLight(m_trace, *m_driver.lighting(), m_layout, m_view);
}

std::optional<double> LiveLight::flicker(const MotionTruth& truth, const Progress& progress) {
    if (!converge(m_scene, progress))
        return {};
    std::vector<ImageF> frames = {picture()};
    for (int k = 1; k < kMotionFrames; ++k) {
        if (progress.cancelled())
            return {};
        m_driver.lightChanged();
        update(withLightsMoved(m_scene, kMotionStep * float(k)));
        frames.push_back(picture());
    }
    return flickerOf(frames, truth.first, truth.second);
}

std::optional<std::uint32_t> LiveLight::lag(const Progress& progress) {
    constexpr double kNear = 0.05;
    const Scene jumped = withLightsMoved(m_scene, 0.5f);
    if (!converge(jumped, progress))
        return {};
    const ImageF goal = picture();
    if (!converge(m_scene, progress))
        return {};
    m_driver.lightChanged();
    for (std::uint32_t updates = 1; updates <= kMaxUpdates && !progress.cancelled(); ++updates) {
        update(jumped);
        if (distanceOf(picture(), goal) <= kNear)
            return updates;
    }
    return {};
}

} // namespace limn
