// SPDX-License-Identifier: MIT
#include "engine/gallery/hostile_shapes.h"

#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

using glm::dvec3;

void addTriangle(Mesh& mesh, dvec3 a, dvec3 b, dvec3 c) {
    for (const dvec3 p : {a, b, c}) {
        mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
        mesh.positions.push_back(glm::vec3(p));
    }
}

void addFaces(Mesh& mesh, dvec3 lower, dvec3 upper, unsigned faces, bool inward) {
    const dvec3 d = upper - lower;
    for (int k = 0; k < 6; ++k) {
        if ((faces >> k & 1U) == 0)
            continue;
        const int axis = k / 2;
        dvec3 o = lower, a(0), b(0);
        a[(axis + 1) % 3] = d[(axis + 1) % 3];
        b[(axis + 2) % 3] = d[(axis + 2) % 3];
        if (k % 2 == 1)
            o[axis] = upper[axis];
        if ((k % 2 == 1) == inward)
            std::swap(a, b);
        addTriangle(mesh, o, o + a, o + a + b);
        addTriangle(mesh, o, o + a + b, o + b);
    }
}

static void divide(Mesh& mesh, const std::array<dvec3, 3>& t, int levels, dvec3 centre,
                   double radius, bool inward) {
    if (levels > 0) {
        const dvec3 ab = glm::normalize(t[0] + t[1]), bc = glm::normalize(t[1] + t[2]),
                    ca = glm::normalize(t[2] + t[0]);
        for (const std::array<dvec3, 3>& part :
             {std::array<dvec3, 3>{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}})
            divide(mesh, part, levels - 1, centre, radius, inward);
        return;
    }
    for (const int k : {0, inward ? 2 : 1, inward ? 1 : 2}) {
        mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
        mesh.positions.push_back(glm::vec3(centre + t[std::size_t(k)] * radius));
        mesh.normals.push_back(glm::vec3(inward ? -t[std::size_t(k)] : t[std::size_t(k)]));
    }
}

void addBall(Mesh& mesh, dvec3 centre, double radius, int levels, bool inward) {
    for (int octant = 0; octant < 8; ++octant) {
        const dvec3 x(octant & 1 ? -1 : 1, 0, 0), y(0, octant & 2 ? -1 : 1, 0),
            z(0, 0, octant & 4 ? -1 : 1);
        const bool odd = std::popcount(unsigned(octant)) % 2 == 1;
        divide(mesh, odd ? std::array{x, z, y} : std::array{x, y, z}, levels, centre, radius,
               inward);
    }
}

void addNeedles(Mesh& mesh, double length, double thinness, int count, RandomStream& random) {
    for (int k = 0; k < count; ++k) {
        const dvec3 along(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        const dvec3 across(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        addTriangle(mesh, dvec3(0), along * length,
                    along * (length / 2) + across * (length * thinness));
    }
}

void addHills(Mesh& mesh, dvec3 size, int n, RandomStream& random) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (int z = 0; z <= n; ++z)
        for (int x = 0; x <= n; ++x)
            mesh.positions.push_back(glm::vec3(
                size * dvec3(double(x) / n - 0.5, 0.2 * random.number() / n, double(z) / n - 0.5)));
    const auto row = std::uint32_t(n + 1);
    for (std::uint32_t z = 0; z + 1 < row; ++z)
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t a = first + z * row + x, b = a + row;
            for (const std::uint32_t i : {a, b, b + 1, a, b + 1, a + 1})
                mesh.indices.push_back(i);
        }
}

} // namespace limn
