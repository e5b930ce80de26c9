// SPDX-License-Identifier: MIT
#include "editor_ui/view/camera_control.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

namespace {

/// An offset in polar form about +Y.
struct Polar {
    float yaw = 0, pitch = 0, length = 1;
};

constexpr float kPitchLimit = 1.5533f; // 89 degrees: the view matrix keeps +Y up

} // namespace

static Polar polar(glm::vec3 v) {
    const float length = glm::length(v);
    if (!(length > 0))
        return {0, 0, 1};
    return {std::atan2(v.x, v.z), std::asin(std::clamp(v.y / length, -1.f, 1.f)), length};
}

static glm::vec3 offset(Polar p) {
    p.pitch = std::clamp(p.pitch, -kPitchLimit, kPitchLimit);
    return p.length * glm::vec3(std::cos(p.pitch) * std::sin(p.yaw), std::sin(p.pitch),
                                std::cos(p.pitch) * std::cos(p.yaw));
}

/// Rows: right, up, backward of the camera.
static glm::mat3 axes(const Camera& camera) {
    return glm::transpose(glm::mat3(viewMatrix(camera)));
}

glm::vec3 forward(const Camera& camera) {
    const glm::vec3 ahead = camera.target - camera.eye;
    const float length = glm::length(ahead);
    return length > 0 ? ahead / length : glm::vec3(0, 0, -1);
}

void setTargetDepth(Camera& camera, glm::vec3 point) {
    const glm::vec3 ahead = forward(camera);
    if (const float depth = glm::dot(point - camera.eye, ahead); depth > 0)
        camera.target = camera.eye + ahead * depth;
}

void orbit(Camera& camera, glm::vec3 pivot, float yaw, float pitch) {
    camera.up = {0, 1, 0};
    Polar p = polar(camera.eye - camera.target);
    const glm::vec3 inCamera = glm::transpose(axes(camera)) * (camera.eye - pivot);
    p.yaw += yaw;
    p.pitch += pitch;
    // The offset alone decides how the turned camera's axes lie.
    const glm::vec3 back = offset(p);
    Camera turned{.eye = back, .target = {}, .up = camera.up};
    camera.eye = pivot + axes(turned) * inCamera;
    camera.target = camera.eye - back;
}

void pan(Camera& camera, float right, float up) {
    const float height = 2 * std::tan(camera.fovY / 2) * glm::length(camera.target - camera.eye);
    const glm::mat3 a = axes(camera);
    const glm::vec3 shift = (a[0] * right + a[1] * up) * height;
    camera.eye += shift;
    camera.target += shift;
}

void zoom(Camera& camera, glm::vec3 point, float steps) {
    const glm::vec3 back = camera.eye - point, ahead = forward(camera);
    const float length = std::max(glm::length(back), 1e-6f);
    const float factor = std::clamp(length * std::pow(0.9f, steps), 1e-3f, 1e6f) / length;
    const float depth = std::clamp(glm::length(camera.target - camera.eye) * factor, 1e-3f, 1e6f);
    camera.eye = point + back * factor;
    camera.target = camera.eye + ahead * depth;
}

void look(Camera& camera, float yaw, float pitch) {
    Polar p = polar(camera.target - camera.eye);
    p.yaw -= yaw;
    p.pitch += pitch;
    camera.up = {0, 1, 0};
    camera.target = camera.eye + offset(p);
}

void fly(Camera& camera, float right, float up, float forward) {
    const glm::mat3 a = axes(camera);
    const glm::vec3 shift = a[0] * right + a[1] * up - a[2] * forward;
    camera.eye += shift;
    camera.target += shift;
}

void focus(Camera& camera, const Bounds& bounds) {
    float radius = glm::length(bounds.size()) / 2;
    if (!(radius > 0))
        radius = 1;
    glm::vec3 back = camera.eye - camera.target;
    back = glm::dot(back, back) > 0 ? glm::normalize(back) : glm::vec3(0, 0, 1);
    camera.target = bounds.centre();
    camera.eye = camera.target + back * (radius / std::sin(camera.fovY / 2));
}

void lookFrom(Camera& camera, Side side) {
    constexpr float kQuarter = glm::half_pi<float>();
    Polar p = polar(camera.eye - camera.target);
    p.pitch = 0;
    switch (side) {
    case Side::Front:
        p.yaw = 0;
        break;
    case Side::Back:
        p.yaw = 2 * kQuarter;
        break;
    case Side::Right:
        p.yaw = kQuarter;
        break;
    case Side::Left:
        p.yaw = -kQuarter;
        break;
    case Side::Top:
        p.yaw = 0, p.pitch = kQuarter;
        break;
    case Side::Bottom:
        p.yaw = 0, p.pitch = -kQuarter;
        break;
    }
    camera.up = {0, 1, 0};
    camera.eye = camera.target + offset(p);
}

} // namespace limn
