// SPDX-License-Identifier: MIT
#include "engine/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

static constexpr float kFovY = 0.9f;

namespace {

/// The four upright sides of the scene's bounds and how its surfaces stand to them.
struct Sides {
    /// Share of the side covered by upright surfaces near it that face inward: -x, +x, -z, +z.
    std::array<float, 4> walls{};
};

} // namespace

/// Area of triangles facing inward within a fifth of the bounds from each side, over the side's
/// area.
static Sides measureSides(const Scene& scene) {
    const Bounds& bounds = scene.bounds;
    const glm::vec3 size = glm::max(bounds.size(), 1e-12f);
    std::array<double, 4> area{};
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshOf(instance);
        const bool bothFaces = scene.materialOf(instance).doubleSided;
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
            const auto [a, b, c] = mesh.triangle(t);
            const auto world = [&](std::uint32_t i) {
                return glm::vec3(instance.toWorld * glm::vec4(mesh.positions[i], 1));
            };
            const glm::vec3 p = world(a), q = world(b), r = world(c);
            glm::vec3 twice = glm::cross(q - p, r - p);
            if (glm::determinant(glm::mat3(instance.toWorld)) < 0)
                twice = -twice;
            const glm::vec3 at = ((p + q + r) / 3.f - bounds.lower) / size;
            for (const int axis : {0, 2}) {
                const auto side = std::size_t(axis == 0 ? 0 : 2);
                const double facing = double(twice[axis]) / 2; // > 0: seen from +axis
                if (at[axis] < 0.2f && (facing > 0 || bothFaces))
                    area[side] += std::abs(facing);
                if (at[axis] > 0.8f && (facing < 0 || bothFaces))
                    area[side + 1] += std::abs(facing);
            }
        }
    }
    Sides sides;
    for (std::size_t i = 0; i < 4; ++i)
        sides.walls[i] = float(area[i] / double(size.y * (i < 2 ? size.z : size.x)));
    return sides;
}

static Camera lookAt(glm::vec3 eye, glm::vec3 target) {
    Camera camera;
    camera.name = "Default view";
    camera.eye = eye;
    camera.target = target;
    camera.fovY = kFovY;
    return camera;
}

/// Distance from which a ball of radius r fills the view's height.
static float distanceFor(float r) {
    return r / std::sin(kFovY / 2);
}

/// From above a corner, all of it in view.
static Camera fromCorner(const Bounds& bounds) {
    const float radius = std::max(glm::length(bounds.size()) / 2, 1e-6f);
    const glm::vec3 way = glm::normalize(glm::vec3(1, 0.6f, 1.4f));
    return lookAt(bounds.centre() + way * distanceFor(radius), bounds.centre());
}

/// Into a box through its one open side (0 -x, 1 +x, 2 -z, 3 +z), as one looks at a stage.
static Camera throughSide(const Bounds& bounds, std::size_t side) {
    const int axis = side < 2 ? 0 : 2;
    const float sign = side % 2 == 0 ? -1.f : 1.f;
    const glm::vec3 half = bounds.size() / 2.f;
    const float edge = std::max(half.y, half[axis == 0 ? 2 : 0]);
    glm::vec3 eye = bounds.centre();
    eye[axis] += sign * (half[axis] + 1.05f * edge / std::tan(kFovY / 2));
    return lookAt(eye, bounds.centre());
}

/// Inside, near one end of the longer way, at a quarter of the height, looking along it and
/// slightly up.
static Camera alongHall(const Bounds& bounds) {
    const glm::vec3 size = bounds.size();
    const int axis = size.x >= size.z ? 0 : 2;
    glm::vec3 eye = bounds.centre(), target = eye;
    eye[axis] += 0.35f * size[axis];
    target[axis] -= 0.25f * size[axis];
    eye.y = bounds.lower.y + 0.25f * size.y;
    target.y = bounds.lower.y + 0.32f * size.y;
    return lookAt(eye, target);
}

/// A room has walls that face inward on at least three of its four sides. With one side open it is
/// looked into from there; closed, from inside. Anything else is an object, seen from a corner.
static Camera defaultView(const Scene& scene) {
    const Sides sides = measureSides(scene);
    constexpr float kWall = 0.3f; // windows and doors may take the rest
    const auto open = std::ranges::count_if(sides.walls, [](float w) { return w < kWall; });
    if (open == 0)
        return alongHall(scene.bounds);
    if (open == 1)
        return throughSide(
            scene.bounds, std::size_t(std::ranges::min_element(sides.walls) - sides.walls.begin()));
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
