// SPDX-License-Identifier: MIT
#include "engine/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

static constexpr float kFovY = 0.9f;

/// A wall is upright, lies in the outer tenth of the bounds, and covers two fifths of its side;
/// windows and doors may take the rest. In the rooms and objects measured, walls cover at least
/// 0.6, objects at most 0.2.
static constexpr float kNear = 0.1f;
static constexpr float kUpright = 0.8f; ///< cosine to the side's normal
static constexpr float kWall = 0.4f;

/// Share of the longer horizontal side that a room is at least as high as. Flatter scenes are
/// landscapes and courts, whose objects have inward-facing sides, too.
static constexpr float kFlat = 1.f / 40;

/// Adds the triangles of one instance to the inward-facing wall area of each side [m^2].
static void addWalls(const Scene& scene, const Instance& instance, std::array<double, 4>& area) {
    const Mesh& mesh = scene.meshOf(instance);
    const bool bothFaces = scene.materialOf(instance).doubleSided;
    const glm::vec3 size = glm::max(scene.bounds.size(), 1e-12f);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        const glm::vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
        const glm::vec3 twice = instance.normalToWorld * glm::cross(q - p, r - p);
        const glm::vec3 centre = instance.toWorld * glm::vec4((p + q + r) / 3.f, 1);
        const glm::vec3 position = (centre - scene.bounds.lower) / size;
        for (const int axis : {0, 2}) {
            if (std::abs(twice[axis]) < kUpright * glm::length(twice))
                continue;
            const std::size_t side = axis == 0 ? 0 : 2;
            if (position[axis] < kNear && (twice[axis] > 0 || bothFaces))
                area[side] += std::abs(double(twice[axis])) / 2;
            if (position[axis] > 1 - kNear && (twice[axis] < 0 || bothFaces))
                area[side + 1] += std::abs(double(twice[axis])) / 2;
        }
    }
}

/// Share of each upright side (-x, +x, -z, +z) of the bounds that walls facing inward cover.
static std::array<float, 4> measureWalls(const Scene& scene) {
    std::array<double, 4> area{};
    for (const Instance& instance : scene.instances)
        addWalls(scene, instance, area);
    const glm::vec3 size = glm::max(scene.bounds.size(), 1e-12f);
    std::array<float, 4> walls{};
    for (std::size_t i = 0; i < 4; ++i)
        walls[i] = float(area[i] / double(size.y * (i < 2 ? size.z : size.x)));
    return walls;
}

static Camera lookAt(glm::vec3 eye, glm::vec3 target) {
    Camera camera;
    camera.name = "Default view";
    camera.eye = eye;
    camera.target = target;
    camera.fovY = kFovY;
    return camera;
}

/// Distance at which a sphere of radius r fills the view's height.
static float distanceFor(float r) {
    return r / std::sin(kFovY / 2);
}

/// Camera above a corner that sees the whole bounding box.
static Camera fromCorner(const Bounds& bounds) {
    const float radius = std::max(glm::length(bounds.size()) / 2, 1e-6f);
    const glm::vec3 way = glm::normalize(glm::vec3(1, 0.6f, 1.4f));
    return lookAt(bounds.centre() + way * distanceFor(radius), bounds.centre());
}

/// Camera that looks into a box through its one open side (0 -x, 1 +x, 2 -z, 3 +z), like a stage.
static Camera throughSide(const Bounds& bounds, std::size_t side) {
    const int axis = side < 2 ? 0 : 2;
    const float sign = side % 2 == 0 ? -1.f : 1.f;
    const glm::vec3 half = bounds.size() / 2.f;
    const float edge = std::max(half.y, half[axis == 0 ? 2 : 0]);
    glm::vec3 eye = bounds.centre();
    eye[axis] += sign * (half[axis] + 1.05f * edge / std::tan(kFovY / 2));
    return lookAt(eye, bounds.centre());
}

/// Camera inside, near one end of the longer horizontal axis, at a quarter of the height, looking
/// along that axis and slightly up.
static Camera alongHall(const Bounds& bounds) {
    const glm::vec3 size = bounds.size();
    const int axis = size.x >= size.z ? 0 : 2;
    glm::vec3 eye = bounds.centre(), target = eye;
    eye[axis] += 0.3f * size[axis];
    target[axis] -= 0.25f * size[axis];
    eye.y = bounds.lower.y + 0.25f * size.y;
    target.y = bounds.lower.y + 0.32f * size.y;
    return lookAt(eye, target);
}

/// A room is not flat and has inward-facing walls on at least three of its four sides. With one
/// side open the camera looks in from there; if closed, it is inside. Anything else is an object,
/// seen from a corner.
static Camera defaultView(const Scene& scene) {
    const glm::vec3 size = scene.bounds.size();
    if (size.y < kFlat * std::max(size.x, size.z))
        return fromCorner(scene.bounds);
    const std::array<float, 4> walls = measureWalls(scene);
    const auto open = std::ranges::count_if(walls, [](float w) { return w < kWall; });
    if (open == 0)
        return alongHall(scene.bounds);
    if (open == 1)
        return throughSide(scene.bounds,
                           std::size_t(std::ranges::min_element(walls) - walls.begin()));
    return fromCorner(scene.bounds);
}

Camera chooseCamera(const Scene& scene, const std::optional<std::string>& name) {
    for (const Camera& camera : scene.cameras)
        if (!name || camera.name == *name)
            return camera;
    if (!scene.cameras.empty())
        return scene.cameras.front();
    return defaultView(scene);
}

} // namespace limn
