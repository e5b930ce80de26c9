// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo_math.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace limn {

namespace {

constexpr float kArrowPixels = 90;
constexpr float kGrabPixels = 8;
constexpr float kPlaneBegin = 0.25f, kPlaneEnd = 0.5f; // of the arrow's length
constexpr float kParallel = 0.02f;                     // sine of 1.1 degrees

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
        break;
    }
    return glm::vec3(0);
}

static bool isPlane(Handle handle) {
    return handle >= Handle::YZ;
}

std::array<glm::vec3, 4> planeHandle(Handle handle, glm::vec3 origin, float length) {
    const glm::vec3 n = handleAxis(handle);
    const glm::vec3 a(n.y, n.z, n.x), b(n.z, n.x, n.y);
    const float lo = kPlaneBegin * length, hi = kPlaneEnd * length;
    return {origin + a * lo + b * lo, origin + a * hi + b * lo, origin + a * hi + b * hi,
            origin + a * lo + b * hi};
}

glm::vec3 arrowTip(Handle handle, glm::vec3 origin, float length) {
    return origin + handleAxis(handle) * length;
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
    return glm::length(glm::cross(glm::normalize(origin - picture.camera.eye), axis));
}

static bool arrowUnderMouse(const Picture& picture, Handle handle, glm::vec3 origin, float length,
                            glm::vec2 mouse, float& best) {
    const auto from = toPixel(picture, origin);
    const auto to = toPixel(picture, arrowTip(handle, origin, length));
    if (!from || !to || sineToView(picture, origin, handleAxis(handle)) < 4 * kParallel)
        return false;
    const float d = distanceToSegment(mouse, *from, *to);
    if (d > kGrabPixels || d >= best)
        return false;
    best = d;
    return true;
}

static bool planeUnderMouse(const Picture& picture, Handle handle, glm::vec3 origin, float length,
                            glm::vec2 mouse) {
    const auto corners = planeHandle(handle, origin, length);
    std::array<glm::vec2, 4> pixels;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto p = toPixel(picture, corners[i]);
        if (!p)
            return false;
        pixels[i] = *p;
    }
    const float facing =
        std::abs(glm::dot(glm::normalize(origin - picture.camera.eye), handleAxis(handle)));
    return facing > 4 * kParallel && insideQuad(mouse, pixels);
}

Handle handleAt(const Picture& picture, glm::vec3 origin, glm::vec2 mouse) {
    const float length = arrowLength(picture, origin);
    Handle found = Handle::None;
    float best = 1e9f;
    for (Handle h : {Handle::X, Handle::Y, Handle::Z})
        if (arrowUnderMouse(picture, h, origin, length, mouse, best))
            found = h;
    if (found != Handle::None)
        return found;
    for (Handle h : {Handle::YZ, Handle::ZX, Handle::XY})
        if (planeUnderMouse(picture, h, origin, length, mouse))
            return h;
    return Handle::None;
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

std::optional<glm::vec3> dragDisplacement(const Picture& picture, Handle handle, glm::vec3 origin,
                                          glm::vec2 start, glm::vec2 now) {
    if (handle == Handle::None)
        return {};
    const glm::vec3 axis = handleAxis(handle), eye = picture.camera.eye;
    const glm::vec3 d0 = pixelDirection(picture, start), d1 = pixelDirection(picture, now);
    if (isPlane(handle)) {
        const auto a = onPlane(origin, axis, eye, d0), b = onPlane(origin, axis, eye, d1);
        if (!a || !b)
            return {};
        return *b - *a;
    }
    const auto a = alongAxis(origin, axis, eye, d0), b = alongAxis(origin, axis, eye, d1);
    if (!a || !b)
        return {};
    return axis * (*b - *a);
}

glm::vec3 snapped(glm::vec3 displacement, float step) {
    return {std::round(displacement.x / step) * step, std::round(displacement.y / step) * step,
            std::round(displacement.z / step) * step};
}

} // namespace limn
