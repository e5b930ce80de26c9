// SPDX-License-Identifier: MIT
#include "engine/render/passes/camera_view.h"

#include "engine/render/position_error.h"
#include "engine/render/surface_map.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_transform.hpp>

namespace limn {

namespace {

struct DepthRange {
    float zNear = 0, zFar = 0; ///< [m]
};

// Depth runs from 1 to 0 in floating point, so a near plane this close costs no precision.
DepthRange depthRange(const Camera& camera, const Bounds& bounds) {
    const glm::vec3 reach =
        glm::max(glm::abs(bounds.lower - camera.eye), glm::abs(bounds.upper - camera.eye));
    const float zFar = std::max(glm::length(reach) * 1.01f, 1e-6f);
    return {zFar * 1e-5f, zFar};
}

} // namespace

SurfaceMapView surfaceMapOf(const Camera& camera, float aspect, const Bounds& bounds) {
    const DepthRange range = depthRange(camera, bounds);
    return {projectionMatrix(camera, aspect, range.zFar, range.zNear) * viewMatrix(camera)};
}

} // namespace limn

namespace limn::render {

GeometryView geometryView(const ViewportOptions& options, const Bounds& bounds, bool grid) {
    const float aspect = float(options.width) / float(options.height);
    GeometryView view;
    view.view = options.view;
    view.toClip = surfaceMapOf(options.camera, aspect, bounds).toClip;
    view.eye = options.camera.eye;
    view.grid = grid;
    return view;
}

glm::vec2 samplePoint(std::uint32_t number) {
    constexpr std::uint32_t kHighest = 0x80000000U;
    std::uint32_t x = kHighest, y = kHighest, bit = kHighest, row = kHighest;
    for (std::uint32_t rest = number; rest != 0; rest >>= 1, bit >>= 1, row ^= row >> 1)
        if (rest & 1) {
            x ^= bit;
            y ^= row;
        }
    return glm::vec2(x >> 8, y >> 8) * 0x1p-24f - 0.5f;
}

GeometryView throughPoint(GeometryView view, glm::vec2 point, std::uint32_t width,
                          std::uint32_t height) {
    // Clip space points upwards.
    const glm::vec2 shift = glm::vec2(-2, 2) * point / glm::vec2(width, height);
    view.toClip = glm::translate(glm::mat4(1), glm::vec3(shift, 0)) * view.toClip;
    return view;
}

void describePixels(const ViewportOptions& options, const Bounds& bounds, glm::vec2 point,
                    std::uint32_t subPixelBits, shared::GpuFrame& frame) {
    const glm::vec2 size(options.width, options.height);
    const float aspect = size.x / size.y;
    frame.eye = options.camera.eye;
    frame.rayCentre = rayDirection(options.camera, aspect, 0, 0);
    frame.rayRight = rayDirection(options.camera, aspect, 1, 0) - frame.rayCentre;
    frame.rayUp = rayDirection(options.camera, aspect, 0, 1) - frame.rayCentre;
    const glm::vec2 shift = 2.f * point / size;
    frame.rayCentre += shift.x * frame.rayRight - shift.y * frame.rayUp;
    frame.pixelSize = 1.f / size;
    frame.positionError = positionError(frame.rayRight, frame.rayUp, frame.pixelSize, subPixelBits);
    // Depth is (a + b / distance) with a, b of the projection's third row.
    const DepthRange range = depthRange(options.camera, bounds);
    const glm::mat4 projection = projectionMatrix(options.camera, aspect, range.zFar, range.zNear);
    frame.depthOffset = projection[2][2];
    frame.depthScale = projection[3][2];
}

ShadowCamera shadowCamera(const ViewportOptions& options, const GeometryView& view,
                          const RenderScene& scene, NearestSeen& seen) {
    if (seen.toClip != view.toClip || seen.scene != scene.version)
        seen = {view.toClip, scene.version, nearestInSight(scene, view.toClip, view.eye)};
    const float aspect = float(options.width) / float(options.height);
    const glm::vec3 forward = rayDirection(options.camera, aspect, 0, 0);
    const glm::vec3 corner = rayDirection(options.camera, aspect, 1, 1);
    return {.eye = view.eye,
            .forward = forward,
            .tanCorner = glm::length(corner - forward),
            .nearest = seen.distance,
            .pixel = 2 * std::tan(options.camera.fovY / 2) / float(options.height)};
}

} // namespace limn::render
