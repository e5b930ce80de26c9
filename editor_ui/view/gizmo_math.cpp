// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo_math.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat4x4.hpp>

namespace limn {

namespace {

constexpr float kArrowPixels = 90;
constexpr float kGrabPixels = 8;
constexpr float kPlaneBegin = 0.25f, kPlaneEnd = 0.5f; // of the arrow's length
constexpr float kParallel = 0.02f;                     // sine of 1.1 degrees
constexpr float kEdgeOn = 0.15f;                       // sine of 8.6 degrees
constexpr int kRingSteps = 64;

} // namespace

std::optional<glm::vec2> toPixel(const Picture& picture, glm::vec3 world) {
    const glm::vec3 v = viewMatrix(picture.camera) * glm::vec4(world, 1);
    if (!(v.z < -1e-6f))
        return {};
    const float h = std::tan(picture.camera.fovY / 2);
    const glm::vec2 ndc = glm::vec2(v.x / (h * picture.aspect()), v.y / h) / -v.z;
    return picture.origin + picture.size * (glm::vec2(ndc.x, -ndc.y) * 0.5f + 0.5f);
}

glm::vec3 pixelDirection(const Picture& picture, glm::vec2 pixel) {
    const glm::vec2 ndc = (pixel - picture.origin) / picture.size * 2.f - 1.f;
    return glm::normalize(rayDirection(picture.camera, picture.aspect(), ndc.x, -ndc.y));
}

float arrowLength(const Picture& picture, glm::vec3 origin) {
    const glm::vec3 v = viewMatrix(picture.camera) * glm::vec4(origin, 1);
    const float worldPerPixel =
        2 * std::tan(picture.camera.fovY / 2) * std::max(-v.z, 1e-6f) / picture.size.y;
    return kArrowPixels * worldPerPixel;
}

glm::vec3 handleAxis(Handle handle) {
    switch (handle) {
    case Handle::X:
    case Handle::YZ:
        return {1, 0, 0};
    case Handle::Y:
    case Handle::ZX:
        return {0, 1, 0};
    case Handle::Z:
    case Handle::XY:
        return {0, 0, 1};
    case Handle::None:
    case Handle::All:
        break;
    }
    return glm::vec3(0);
}

static bool isPlane(Handle handle) {
    return handle == Handle::YZ || handle == Handle::ZX || handle == Handle::XY;
}

static glm::vec3 worldAxis(Handle handle, const GizmoFrame& frame) {
    return frame.axes * handleAxis(handle);
}

glm::vec3 towardsEye(const Picture& picture, glm::vec3 origin) {
    return glm::normalize(picture.camera.eye - origin);
}

std::array<glm::vec3, 4> planeHandle(Handle handle, const GizmoFrame& frame, float length) {
    const glm::vec3 n = handleAxis(handle), origin = frame.origin;
    const glm::vec3 a = frame.axes * glm::vec3(n.y, n.z, n.x);
    const glm::vec3 b = frame.axes * glm::vec3(n.z, n.x, n.y);
    const float lo = kPlaneBegin * length, hi = kPlaneEnd * length;
    return {origin + a * lo + b * lo, origin + a * hi + b * lo, origin + a * hi + b * hi,
            origin + a * lo + b * hi};
}

glm::vec3 arrowTip(Handle handle, const GizmoFrame& frame, float length) {
    return frame.origin + worldAxis(handle, frame) * length;
}

glm::vec3 ringPoint(glm::vec3 origin, glm::vec3 normal, float radius, float angle) {
    const glm::vec3 other = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 a = glm::normalize(glm::cross(other, normal)), b = glm::cross(normal, a);
    return origin + (a * std::cos(angle) + b * std::sin(angle)) * radius;
}

static float distanceToSegment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 d = b - a;
    const float length2 = glm::dot(d, d);
    const float t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.f, 1.f) : 0.f;
    return glm::length(p - (a + d * t));
}

static float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

static bool insideQuad(glm::vec2 p, const std::array<glm::vec2, 4>& q) {
    int positive = 0, negative = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const float c = cross(q[(i + 1) % 4] - q[i], p - q[i]);
        positive += c > 0;
        negative += c < 0;
    }
    return positive == 0 || negative == 0;
}

/// Sine of the angle between an axis and the line of sight.
static float sineToView(const Picture& picture, glm::vec3 origin, glm::vec3 axis) {
    return glm::length(glm::cross(towardsEye(picture, origin), axis));
}

/// Distance of the mouse from an arrow; std::nullopt if the arrow cannot be picked [px].
static std::optional<float> toArrow(const Picture& picture, Handle handle, const GizmoFrame& frame,
                                    float length, glm::vec2 mouse) {
    const auto from = toPixel(picture, frame.origin);
    const auto to = toPixel(picture, arrowTip(handle, frame, length));
    const float sine = sineToView(picture, frame.origin, worldAxis(handle, frame));
    if (!from || !to || sine < 4 * kParallel)
        return {};
    return distanceToSegment(mouse, *from, *to);
}

/// Distance of the mouse from the half of a ring that faces the eye [px].
static std::optional<float> toRing(const Picture& picture, Handle handle, const GizmoFrame& frame,
                                   float radius, glm::vec2 mouse) {
    const glm::vec3 normal = worldAxis(handle, frame), eye = towardsEye(picture, frame.origin);
    std::optional<float> best;
    for (int i = 0; i < kRingSteps; ++i) {
        const auto pointAt = [&](int step) {
            return ringPoint(frame.origin, normal, radius,
                             glm::two_pi<float>() * float(step) / kRingSteps);
        };
        if (glm::dot(pointAt(i) - frame.origin, eye) < -kParallel * radius)
            continue;
        const auto a = toPixel(picture, pointAt(i)), b = toPixel(picture, pointAt(i + 1));
        if (a && b)
            best = std::min(best.value_or(1e9f), distanceToSegment(mouse, *a, *b));
    }
    return best;
}

static bool planeUnderMouse(const Picture& picture, Handle handle, const GizmoFrame& frame,
                            float length, glm::vec2 mouse) {
    const auto corners = planeHandle(handle, frame, length);
    std::array<glm::vec2, 4> pixels;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto p = toPixel(picture, corners[i]);
        if (!p)
            return false;
        pixels[i] = *p;
    }
    const float facing =
        std::abs(glm::dot(towardsEye(picture, frame.origin), worldAxis(handle, frame)));
    return facing > 4 * kParallel && insideQuad(mouse, pixels);
}

/// Whether the mouse is over the handle of all axes: a disc in the middle for Move, a ring around
/// the other handles for Rotate and Scale.
static bool allUnderMouse(const Picture& picture, Tool tool, const GizmoFrame& frame,
                          glm::vec2 mouse) {
    const auto middle = toPixel(picture, frame.origin);
    if (!middle)
        return false;
    const float distance = glm::length(mouse - *middle);
    return tool == Tool::Move ? distance < kGrabPixels
                              : std::abs(distance - kOuterRing * kArrowPixels) < kGrabPixels;
}

Handle handleAt(const Picture& picture, Tool tool, const GizmoFrame& frame, glm::vec2 mouse) {
    if (tool == Tool::Select)
        return Handle::None;
    const float length = arrowLength(picture, frame.origin);
    if (tool == Tool::Move && allUnderMouse(picture, tool, frame, mouse))
        return Handle::All;
    Handle found = Handle::None;
    float best = kGrabPixels;
    for (Handle h : {Handle::X, Handle::Y, Handle::Z}) {
        const auto d = tool == Tool::Rotate ? toRing(picture, h, frame, length, mouse)
                                            : toArrow(picture, h, frame, length, mouse);
        if (d && *d < best)
            best = *d, found = h;
    }
    if (found != Handle::None)
        return found;
    if (tool != Tool::Rotate)
        for (Handle h : {Handle::YZ, Handle::ZX, Handle::XY})
            if (planeUnderMouse(picture, h, frame, length, mouse))
                return h;
    return allUnderMouse(picture, tool, frame, mouse) ? Handle::All : Handle::None;
}

/// Parameter along `axis` from `origin` of the point closest to the ray from `eye`.
static std::optional<float> alongAxis(glm::vec3 origin, glm::vec3 axis, glm::vec3 eye,
                                      glm::vec3 d) {
    const float ad = glm::dot(axis, d);
    const float denominator = 1 - ad * ad; // sin^2 of the angle between them
    if (denominator < kParallel * kParallel)
        return {};
    const glm::vec3 w = eye - origin;
    return (glm::dot(w, axis) - glm::dot(w, d) * ad) / denominator;
}

static std::optional<glm::vec3> onPlane(glm::vec3 origin, glm::vec3 normal, glm::vec3 eye,
                                        glm::vec3 d) {
    const float facing = glm::dot(normal, d);
    if (std::abs(facing) < kParallel)
        return {};
    const float t = glm::dot(normal, origin - eye) / facing;
    if (!(t > 0))
        return {};
    return eye + d * t;
}

std::optional<glm::vec3> dragDisplacement(const Picture& picture, Handle handle,
                                          const GizmoFrame& frame, glm::vec2 start, glm::vec2 now) {
    if (handle == Handle::None)
        return {};
    const glm::vec3 eye = picture.camera.eye, origin = frame.origin;
    const glm::vec3 d0 = pixelDirection(picture, start), d1 = pixelDirection(picture, now);
    if (handle == Handle::All || isPlane(handle)) {
        const glm::vec3 normal =
            handle == Handle::All ? towardsEye(picture, origin) : worldAxis(handle, frame);
        const auto a = onPlane(origin, normal, eye, d0), b = onPlane(origin, normal, eye, d1);
        if (!a || !b)
            return {};
        return *b - *a;
    }
    const glm::vec3 axis = worldAxis(handle, frame);
    const auto a = alongAxis(origin, axis, eye, d0), b = alongAxis(origin, axis, eye, d1);
    if (!a || !b)
        return {};
    return axis * (*b - *a);
}

/// How far the mouse went along a ring that is seen edge-on, where it is nearest to the eye, in
/// radii.
static std::optional<float> alongRing(const Picture& picture, glm::vec3 origin, glm::vec3 normal,
                                      glm::vec2 moved) {
    const glm::vec3 eye = towardsEye(picture, origin);
    const glm::vec3 nearest = glm::normalize(eye - normal * glm::dot(eye, normal));
    const float radius = arrowLength(picture, origin), step = 0.01f * radius;
    const glm::vec3 from = origin + nearest * radius;
    const auto a = toPixel(picture, from),
               b = toPixel(picture, from + glm::cross(normal, nearest) * step);
    if (!a || !b)
        return {};
    const glm::vec2 perStep = *b - *a;
    const float squared = glm::dot(perStep, perStep);
    return squared > 0 ? std::optional(glm::dot(moved, perStep) / squared * step / radius)
                       : std::nullopt;
}

std::optional<float> dragAngle(const Picture& picture, Handle handle, const GizmoFrame& frame,
                               glm::vec2 start, glm::vec2 now) {
    if (handle == Handle::None)
        return {};
    const glm::vec3 origin = frame.origin, eye = picture.camera.eye;
    const glm::vec3 sight = towardsEye(picture, origin);
    const glm::vec3 normal = handle == Handle::All ? sight : worldAxis(handle, frame);
    if (std::abs(glm::dot(normal, sight)) < kEdgeOn)
        return alongRing(picture, origin, normal, now - start);
    const auto a = onPlane(origin, normal, eye, pixelDirection(picture, start));
    const auto b = onPlane(origin, normal, eye, pixelDirection(picture, now));
    if (!a || !b)
        return {};
    const glm::vec3 from = *a - origin, to = *b - origin;
    return std::atan2(glm::dot(normal, glm::cross(from, to)), glm::dot(from, to));
}

std::optional<float> dragFactor(const Picture& picture, Handle handle, const GizmoFrame& frame,
                                glm::vec2 start, glm::vec2 now) {
    if (handle == Handle::X || handle == Handle::Y || handle == Handle::Z) {
        const glm::vec3 axis = worldAxis(handle, frame), eye = picture.camera.eye;
        const auto a = alongAxis(frame.origin, axis, eye, pixelDirection(picture, start));
        const auto b = alongAxis(frame.origin, axis, eye, pixelDirection(picture, now));
        if (!a || !b || std::abs(*a) < 0.01f * arrowLength(picture, frame.origin))
            return {};
        return *b / *a;
    }
    const auto middle = toPixel(picture, frame.origin);
    if (handle == Handle::None || !middle || glm::length(start - *middle) < 1)
        return {};
    return glm::length(now - *middle) / glm::length(start - *middle);
}

glm::vec3 snapped(glm::vec3 value, float step) {
    return {std::round(value.x / step) * step, std::round(value.y / step) * step,
            std::round(value.z / step) * step};
}

} // namespace limn
