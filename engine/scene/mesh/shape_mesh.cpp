// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/shape_mesh.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

/// Sides of what is round. A chord of 1/48 of a circle is off by 0.2 % of the radius.
static constexpr std::uint32_t kSides = 48;

namespace {

struct Vertex {
    glm::vec3 position, normal;
};

} // namespace

/// Adds a sheet of nu x nv quads, whose front is where u x v points. TEXCOORD_0 is (u, 1 - v),
/// since its v points down.
static void addSheet(Mesh& mesh, std::uint32_t nu, std::uint32_t nv,
                     const std::function<Vertex(float, float)>& vertex) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (std::uint32_t j = 0; j <= nv; ++j)
        for (std::uint32_t i = 0; i <= nu; ++i) {
            const float u = float(i) / float(nu), v = float(j) / float(nv);
            const Vertex point = vertex(u, v);
            mesh.positions.push_back(point.position);
            mesh.normals.push_back(point.normal);
            mesh.uv0.emplace_back(u, 1 - v);
        }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        // Triangles at a pole have no area.
        const glm::vec3 *p = &mesh.positions[a], *q = &mesh.positions[b], *r = &mesh.positions[c];
        if (*p != *q && *q != *r && *r != *p)
            mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    for (std::uint32_t j = 0; j < nv; ++j)
        for (std::uint32_t i = 0; i < nu; ++i) {
            const std::uint32_t a = first + j * (nu + 1) + i, b = a + nu + 1;
            add(a, a + 1, b + 1);
            add(a, b + 1, b);
        }
}

/// Adds a square of side 1 around `centre`, spanned by two unit vectors.
static void addSquare(Mesh& mesh, glm::vec3 centre, glm::vec3 u, glm::vec3 v) {
    addSheet(mesh, 1, 1, [&](float s, float t) {
        return Vertex{centre + (s - 0.5f) * u + (t - 0.5f) * v, glm::cross(u, v)};
    });
}

/// A direction in the plane y = 0; the same for u = 0 and u = 1.
static glm::vec3 around(float u) {
    const auto side = std::uint32_t(std::lround(u * float(kSides))) % kSides;
    const float angle = 2 * std::numbers::pi_v<float> * float(side) / float(kSides);
    return {std::sin(angle), 0, std::cos(angle)};
}

static void addBox(Mesh& mesh) {
    constexpr glm::vec3 kMiddle(0, 0.5f, 0);
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.f, 1.f}) {
            glm::vec3 normal(0), up(0);
            normal[axis] = sign;
            up[axis == 1 ? 2 : 1] = axis == 1 ? -sign : 1.f;
            addSquare(mesh, kMiddle + 0.5f * normal, glm::cross(up, normal), up);
        }
}

static void addSphere(Mesh& mesh) {
    constexpr std::uint32_t kRings = kSides / 2;
    addSheet(mesh, kSides, kRings, [](float u, float v) {
        const auto ring = std::uint32_t(std::lround(v * float(kRings)));
        const float polar = std::numbers::pi_v<float> * v;
        const bool pole = ring == 0 || ring == kRings;
        const float height = pole ? (ring == 0 ? -1.f : 1.f) : -std::cos(polar);
        const float radius = pole ? 0 : std::sin(polar);
        const glm::vec3 normal = glm::normalize(radius * around(u) + glm::vec3(0, height, 0));
        return Vertex{0.5f * normal + glm::vec3(0, 0.5f, 0), normal};
    });
}

/// Adds a disc of radius 0.5 at a height, which faces `sign` along y.
static void addDisc(Mesh& mesh, float height, float sign) {
    const glm::vec3 normal(0, sign, 0), centre(0, height, 0);
    const auto first = std::uint32_t(mesh.positions.size());
    const auto add = [&](glm::vec3 offset) {
        mesh.positions.push_back(centre + offset);
        mesh.normals.push_back(normal);
        mesh.uv0.emplace_back(0.5f + offset.x, 0.5f + sign * offset.z);
    };
    add(glm::vec3(0));
    for (std::uint32_t i = 0; i < kSides; ++i)
        add(0.5f * around(float(i) / float(kSides)));
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const std::uint32_t a = first + 1 + i, b = first + 1 + (i + 1) % kSides;
        mesh.indices.insert(mesh.indices.end(), {first, sign > 0 ? a : b, sign > 0 ? b : a});
    }
}

static void addCylinder(Mesh& mesh) {
    addSheet(mesh, kSides, 1, [](float u, float v) {
        return Vertex{0.5f * around(u) + glm::vec3(0, v, 0), around(u)};
    });
    addDisc(mesh, 0, -1);
    addDisc(mesh, 1, 1);
}

const char* shapeName(Shape shape) {
    switch (shape) {
    case Shape::Plane:
        return "Plane";
    case Shape::Box:
        return "Box";
    case Shape::Sphere:
        return "Sphere";
    case Shape::Cylinder:
        return "Cylinder";
    }
    return "";
}

std::string shapePath(Shape shape) {
    std::string name = shapeName(shape);
    name[0] = char(name[0] - 'A' + 'a');
    return "shape:" + name;
}

std::optional<Shape> shapeOfPath(std::string_view path) {
    for (const Shape shape : kShapes)
        if (path == shapePath(shape))
            return shape;
    return {};
}

Mesh shapeMesh(Shape shape) {
    Mesh mesh;
    mesh.name = shapeName(shape);
    switch (shape) {
    case Shape::Plane:
        addSquare(mesh, glm::vec3(0), {0, 0, 1}, {1, 0, 0});
        break;
    case Shape::Box:
        addBox(mesh);
        break;
    case Shape::Sphere:
        addSphere(mesh);
        break;
    case Shape::Cylinder:
        addCylinder(mesh);
        break;
    }
    return mesh;
}

} // namespace limn
