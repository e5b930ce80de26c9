// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limn::simple {

/// Scenes made of a few known shapes, for tests. Fills the fields that tracing and shading read.
struct SceneBuilder {
    std::shared_ptr<Assets> assets = std::make_shared<Assets>();
    Scene scene;

    std::uint32_t addMaterial(const Material& m) {
        scene.materials.push_back(m);
        return std::uint32_t(scene.materials.size() - 1);
    }
    std::uint32_t addMesh(Mesh mesh) {
        assets->meshes.push_back(std::move(mesh));
        return std::uint32_t(assets->meshes.size() - 1);
    }
    Instance& addInstance(std::uint32_t mesh, glm::mat4 toWorld = glm::mat4(1),
                          bool dynamic = false) {
        Instance i;
        i.mesh = mesh;
        i.material = assets->meshes[mesh].material;
        i.node = ObjectId(scene.instances.size() + 1);
        i.dynamic = dynamic;
        i.toWorld = toWorld;
        const glm::mat3 a(toWorld);
        i.normalToWorld =
            glm::mat3(glm::cross(a[1], a[2]), glm::cross(a[2], a[0]), glm::cross(a[0], a[1]));
        if (glm::determinant(a) < 0)
            i.normalToWorld = -i.normalToWorld;
        scene.instances.push_back(i);
        return scene.instances.back();
    }
    Instance& add(Mesh mesh, glm::mat4 toWorld = glm::mat4(1), bool dynamic = false) {
        return addInstance(addMesh(std::move(mesh)), toWorld, dynamic);
    }
    /// Sets the bounds and hands the scene out.
    Scene build() {
        scene.assets = assets;
        glm::vec3 lower(std::numeric_limits<float>::max()), upper(-lower);
        for (const Instance& i : scene.instances)
            for (glm::vec3 p : scene.meshOf(i).positions) {
                const glm::vec3 w(i.toWorld * glm::vec4(p, 1));
                lower = glm::min(lower, w);
                upper = glm::max(upper, w);
            }
        scene.bounds = lower.x <= upper.x ? Bounds{lower, upper} : Bounds{};
        return scene;
    }
};

inline Material lambert(glm::vec3 albedo, glm::vec3 emission = glm::vec3(0)) {
    Material m;
    m.baseColor = glm::vec4(albedo, 1);
    m.emission = emission;
    return m;
}

/// Fills the shading normals with those of the triangles, which then share no vertices.
inline Mesh flatShaded(const std::vector<glm::vec3>& corners, std::uint32_t material) {
    Mesh m;
    m.material = material;
    m.positions = corners;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const glm::vec3 n =
            glm::normalize(glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]));
        m.normals.insert(m.normals.end(), 3, n);
        for (std::size_t k = 0; k < 3; ++k)
            m.indices.push_back(std::uint32_t(i + k));
    }
    return m;
}

/// Parallelogram with corner `o`, sides `a` and `b`, facing cross(a, b); uv (0,0) at o, (1,1)
/// opposite.
inline Mesh quad(glm::vec3 o, glm::vec3 a, glm::vec3 b, std::uint32_t material = 0) {
    Mesh m;
    m.material = material;
    m.positions = {o, o + a, o + a + b, o + b};
    m.normals.assign(4, glm::normalize(glm::cross(a, b)));
    m.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    m.indices = {0, 1, 2, 0, 2, 3};
    return m;
}

/// Axis-parallel box. Its front looks outward, or inward where asked.
inline Mesh box(glm::vec3 lower, glm::vec3 upper, bool inward, std::uint32_t material = 0) {
    std::vector<glm::vec3> corners;
    const glm::vec3 d = upper - lower;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            glm::vec3 o = lower, a(0), b(0);
            a[(axis + 1) % 3] = d[(axis + 1) % 3];
            b[(axis + 2) % 3] = d[(axis + 2) % 3];
            if (side == 1)
                o[axis] = upper[axis];
            if ((side == 1) == inward)
                std::swap(a, b);
            corners.insert(corners.end(), {o, o + a, o + a + b, o, o + a + b, o + b});
        }
    return flatShaded(corners, material);
}

/// Icosahedron divided `levels` times, on the sphere of radius r: 20 * 4^levels triangles that
/// share their vertices.
inline Mesh sphere(float r, int levels, bool inward, std::uint32_t material = 0) {
    const float t = (1 + std::sqrt(5.f)) / 2;
    std::vector<glm::vec3> p = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
    std::vector<std::uint32_t> idx = {0, 11, 5, 0, 5,  1,  0,  1,  7,  0,  7, 10, 0, 10, 11,
                                      1, 5,  9, 5, 11, 4,  11, 10, 2,  10, 7, 6,  7, 1,  8,
                                      3, 9,  4, 3, 4,  2,  3,  2,  6,  3,  6, 8,  3, 8,  9,
                                      4, 9,  5, 2, 4,  11, 6,  2,  10, 8,  6, 7,  9, 8,  1};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [entry, isNew] =
                middles.try_emplace(std::minmax(a, b), std::uint32_t(p.size()));
            if (isNew)
                p.push_back(glm::normalize(glm::normalize(p[a]) + glm::normalize(p[b])));
            return entry->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t i = 0; i < idx.size(); i += 3) {
            const std::uint32_t a = idx[i], b = idx[i + 1], c = idx[i + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        idx = std::move(finer);
    }
    Mesh m;
    m.material = material;
    for (glm::vec3 q : p) {
        m.normals.push_back(glm::normalize(q) * (inward ? -1.f : 1.f));
        m.positions.push_back(glm::normalize(q) * r);
    }
    if (inward)
        for (std::size_t i = 0; i < idx.size(); i += 3)
            std::swap(idx[i + 1], idx[i + 2]);
    m.indices = idx;
    return m;
}

inline double areaOf(const Mesh& m) {
    double area = 0;
    for (std::size_t t = 0; t < m.triangleCount(); ++t) {
        const std::array<std::uint32_t, 3> k = m.triangle(t);
        area += 0.5 * double(glm::length(glm::cross(m.positions[k[1]] - m.positions[k[0]],
                                                    m.positions[k[2]] - m.positions[k[0]])));
    }
    return area;
}

} // namespace limn::simple
