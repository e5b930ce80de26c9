// SPDX-License-Identifier: MIT
#include "app/bench/smooth_motion.h"

#include "app/bench/moving_lights.h"

#include "engine/core/parallel.h"
#include "engine/measure/compare.h"
#include "engine/shading/pixel_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Points of a pixel that are to be seen, from its upper left corner [pixels].
constexpr std::array<glm::vec2, 5> kPlaces = {{{0.5f, 0.5f}, {0, 0}, {1, 0}, {0, 1}, {1, 1}}};

/// A camera and what it looks at.
struct Watcher {
    const TraceScene* trace;
    PixelRays rays;

    /// Whether its picture shows a point that is clear of its surface.
    bool sees(glm::vec3 p) const { return rays.pixelOf(p) && !trace->blocked(rays.eye, p); }
};

/// Sum over frames, pixels and channels of the product of two series' changes from frame to frame.
double changes(std::span<const ImageF> a, std::span<const ImageF> b) {
    double sum = 0;
    for (std::size_t k = 1; k < a.size(); ++k)
        for (std::size_t p = 0; p < a[k].rgb.size(); ++p)
            sum += double(glm::dot(a[k].rgb[p] - a[k - 1].rgb[p], b[k].rgb[p] - b[k - 1].rgb[p]));
    return sum;
}

} // namespace

glm::vec3 turned(glm::vec3 direction, float angle) {
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * direction.x + s * direction.z, direction.y, c * direction.z - s * direction.x};
}

Scene withLightsMoved(const Scene& scene, float share) {
    Scene moved = scene;
    const glm::vec3 goal = scene.bounds.lower + scene.bounds.size() * glm::vec3(0.4f, 0.5f, 0.45f);
    for (Light& light : moved.lights) {
        if (light.kind == LightKind::Directional)
            light.direction = turned(light.direction, share);
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

MotionFrame motionFrame(Motion motion, const Scene& scene, const Camera& camera, int k) {
    MotionFrame frame{scene, camera};
    switch (motion) {
    case Motion::Lights:
        frame.scene = withLightsMoved(scene, kMotionStep * float(k));
        break;
    case Motion::Camera: {
        const glm::vec3 forward = camera.target - camera.eye,
                        right = glm::cross(forward, camera.up);
        const float length = glm::length(right); // 0: it looks straight up or down
        if (length > 0)
            frame.camera.eye +=
                right * (kCameraStep * float(k) * glm::length(scene.bounds.size()) / length);
        frame.camera.target = frame.camera.eye + turned(forward, kMotionStep * float(k));
        break;
    }
    case Motion::Objects:
        moveObjects(frame.scene, scene, k);
        break;
    }
    return frame;
}

/// Whether a point of the standing picture is to be compared, and all watchers see it.
static bool isCompared(Motion motion, const Ray& ray, std::span<const Watcher> watchers) {
    const TraceScene& standing = *watchers[0].trace;
    const Hit hit = standing.closestHit(ray);
    if (!hit || (motion == Motion::Objects && standing.scene().instances[hit.instance].dynamic))
        return false;
    const glm::vec3 n = hit.frontFace ? hit.geometricNormal : -hit.geometricNormal;
    const glm::vec3 p = standing.clearOf(hit.position, n);
    return std::ranges::all_of(watchers.subspan(1), [&](const Watcher& w) { return w.sees(p); });
}

std::vector<std::uint32_t> comparedPixels(Motion motion, const TraceScene& trace,
                                          const ReferenceOptions& view) {
    std::vector<std::uint32_t> pixels(std::size_t(view.width) * view.height);
    std::iota(pixels.begin(), pixels.end(), 0U);
    if (motion == Motion::Lights)
        return pixels;
    std::vector<std::unique_ptr<const TraceScene>> moved;
    std::vector<Watcher> watchers = {{&trace, {view.camera, view.width, view.height}}};
    for (int k = 1; k < kMotionFrames; ++k) {
        const MotionFrame frame = motionFrame(motion, trace.scene(), view.camera, k);
        const TraceScene* seen = &trace;
        if (motion == Motion::Objects)
            seen = moved.emplace_back(std::make_unique<const TraceScene>(frame.scene, trace)).get();
        watchers.push_back({seen, {frame.camera, view.width, view.height}});
    }
    std::vector<std::uint8_t> compared(pixels.size());
    parallelRanges(pixels.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::vec2 corner(float(i % view.width), float(i / view.width));
            compared[i] = std::ranges::all_of(kPlaces, [&](glm::vec2 place) {
                return isCompared(motion, watchers[0].rays.through(corner + place), watchers);
            });
        }
    });
    std::erase_if(pixels, [&](std::uint32_t pixel) { return compared[pixel] == 0; });
    return pixels;
}

ImageF pickedPixels(const ImageF& image, std::span<const std::uint32_t> pixels) {
    ImageF row{std::uint32_t(pixels.size()), 1, {}};
    for (const std::uint32_t pixel : pixels)
        row.rgb.push_back(image.rgb[pixel]);
    return row;
}

MotionTruth renderMotion(Motion motion, const TraceScene& trace, const ReferenceOptions& view,
                         const ReferenceSet& standing) {
    MotionTruth truth{.motion = motion, .pixels = comparedPixels(motion, trace, view)};
    if (motion == Motion::Camera) {
        truth.first = {pickedPixels(standing.first(), truth.pixels)};
        truth.second = {pickedPixels(standing.second(), truth.pixels)};
        return truth;
    }
    for (int k = 0; k < kMotionFrames; ++k) {
        const TraceScene moved(motionFrame(motion, trace.scene(), view.camera, k).scene, trace);
        // Frames share their seed, and so do most of their noise.
        ReferenceOptions options = view;
        for (std::vector<ImageF>* series : {&truth.first, &truth.second}) {
            options.seed = series == &truth.first ? 1 : 2;
            series->push_back(pickedPixels(renderReference(moved, options).image, truth.pixels));
        }
    }
    return truth;
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

} // namespace limn
