// SPDX-License-Identifier: MIT
#include "engine/relight/blockers.h"

#include "engine/core/hash.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

float areaOf(glm::vec3 s) {
    return 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
}

Bounds boundsOf(const Mesh& mesh, const glm::mat3& toBox) {
    Bounds b{glm::vec3(1e30f), glm::vec3(-1e30f)};
    for (const std::uint32_t i : mesh.indices) {
        b.lower = glm::min(b.lower, toBox * mesh.positions[i]);
        b.upper = glm::max(b.upper, toBox * mesh.positions[i]);
    }
    return b;
}

/// Axes along the legs of the first triangle, which on a box has a right angle; else the object's.
glm::mat3 axesOf(const Mesh& mesh) {
    const auto k = mesh.triangle(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 corner = mesh.positions[k[i]], a = mesh.positions[k[(i + 1) % 3]] - corner,
                        b = mesh.positions[k[(i + 2) % 3]] - corner;
        const float lengths = glm::length(a) * glm::length(b);
        if (lengths > 0 && std::abs(glm::dot(a, b)) < 1e-4f * lengths) {
            const glm::vec3 x = glm::normalize(a), z = glm::normalize(glm::cross(a, b));
            return glm::transpose(glm::mat3(x, glm::cross(z, x), z));
        }
    }
    return glm::mat3(1);
}

/// All vertices lie on the sides of `box`, whose area the triangles have.
bool isBox(const Mesh& mesh, const glm::mat3& toBox, const Bounds& box) {
    const glm::vec3 size = box.size();
    const float near = 1e-4f * std::max({size.x, size.y, size.z});
    for (const std::uint32_t i : mesh.indices) {
        const glm::vec3 p = toBox * mesh.positions[i],
                        d = glm::min(glm::abs(p - box.lower), glm::abs(p - box.upper));
        if (!(std::min({d.x, d.y, d.z}) <= near))
            return false;
    }
    float area = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto k = mesh.triangle(t);
        area += 0.5f * glm::length(glm::cross(mesh.positions[k[1]] - mesh.positions[k[0]],
                                              mesh.positions[k[2]] - mesh.positions[k[0]]));
    }
    return std::abs(area - areaOf(size)) <= 0.01f * area;
}

/// False where it cannot block.
bool place(const Instance& instance, Blocker& b) {
    const glm::mat3 object(instance.toWorld),
        linear = object * glm::transpose(b.shape->toBox); // from the box's axes to the world
    const Bounds& box = b.shape->box;
    b.toBox = glm::inverse(linear);
    b.origin = glm::vec3(instance.toWorld[3]);
    b.bounds = {glm::vec3(1e30f), glm::vec3(-1e30f)};
    for (unsigned k = 0; k < 8; ++k) {
        const glm::vec3 side(k & 1U, k >> 1 & 1U, k >> 2),
            corner = b.origin + linear * glm::mix(box.lower, box.upper, side);
        b.bounds.lower = glm::min(b.bounds.lower, corner);
        b.bounds.upper = glm::max(b.bounds.upper, corner);
    }
    b.centre = b.origin + linear * box.centre();
    for (unsigned k = 0; k < 4; ++k) { // the other corners are as far
        const glm::vec3 side(k & 1U, k >> 1, 1);
        b.radius = std::max(b.radius, glm::length(linear * ((side - 0.5f) * box.size())));
    }
    return b.radius > 0 && std::isfinite(b.radius) && std::isfinite(glm::length(b.centre)) &&
           std::abs(glm::determinant(linear)) > 0 && std::isfinite(glm::determinant(b.toBox));
}

} // namespace

BlockerShape blockerShape(const Scene& scene, std::uint32_t mesh) {
    const Mesh& m = scene.assets->meshes[mesh];
    const glm::mat3 axes = axesOf(m);
    BlockerShape shape{axes, boundsOf(m, axes), nullptr};
    if (isBox(m, axes, shape.box))
        return shape;
    shape = {glm::mat3(1), boundsOf(m, glm::mat3(1)), nullptr};
    Scene alone;
    alone.assets = scene.assets;
    alone.materials.resize(1);
    alone.instances.resize(1);
    alone.instances[0].mesh = mesh;
    shape.triangles = std::make_unique<const TraceScene>(alone);
    return shape;
}

std::vector<Blocker> sceneBlockers(const Scene& scene, BlockerShapes& shapes) {
    std::vector<Blocker> blockers;
    for (const Instance& instance : scene.instances) {
        if (!instance.dynamic || scene.meshOf(instance).indices.empty())
            continue;
        auto& shape = shapes[instance.mesh];
        if (!shape)
            shape = std::make_shared<const BlockerShape>(blockerShape(scene, instance.mesh));
        Blocker b;
        b.shape = shape;
        if (place(instance, b))
            blockers.push_back(std::move(b));
    }
    return blockers;
}

std::uint64_t hashBlockers(const Scene& scene) {
    std::uint64_t h = 0;
    for (const Instance& i : scene.instances)
        if (i.dynamic)
            h = hashBytes(&i.toWorld, sizeof i.toWorld, hashValue(i.mesh, h + 1));
    return h;
}

void block(const Blocker& blocker, glm::vec3 from, ConeSamples& samples) {
    const std::size_t count = samples.count;
    const glm::mat3& m = blocker.toBox;
    const glm::vec3 o = m * (from - blocker.origin);
    float ix[ConeSamples::kMost], iy[ConeSamples::kMost], iz[ConeSamples::kMost];
    int hit[ConeSamples::kMost];
    // Of a direction along a side a large number stands for the infinite inverse: no 0 times inf.
    const auto inverse = [](float v) {
        return 1 / (std::abs(v) > 1e-18f ? v : std::copysign(1e-18f, v));
    };
    for (std::size_t k = 0; k < count; ++k) {
        const float x = samples.x[k], y = samples.y[k], z = samples.z[k];
        ix[k] = inverse(m[0].x * x + m[1].x * y + m[2].x * z);
        iy[k] = inverse(m[0].y * x + m[1].y * y + m[2].y * z);
        iz[k] = inverse(m[0].z * x + m[1].z * y + m[2].z * z);
    }
    const Bounds& box = blocker.shape->box;
    const glm::vec3 l = box.lower - o, u = box.upper - o;
    for (std::size_t k = 0; k < count; ++k) {
        const float ax = l.x * ix[k], bx = u.x * ix[k], ay = l.y * iy[k], by = u.y * iy[k],
                    az = l.z * iz[k], bz = u.z * iz[k];
        const float first =
            std::max(std::max(std::min(ax, bx), std::min(ay, by)), std::max(std::min(az, bz), 0.f));
        const float last = std::min(std::min(std::max(ax, bx), std::max(ay, by)), std::max(az, bz));
        hit[k] = int(first <= last) & int(last > 0) & int(first < samples.tMost[k]);
    }
    const TraceScene* triangles = blocker.shape->triangles.get();
    for (std::size_t k = 0; k < count; ++k) {
        if (!hit[k] || samples.blocked[k])
            continue;
        // As long in the object's space as in the world: t is the same.
        const glm::vec3 d = m * glm::vec3(samples.x[k], samples.y[k], samples.z[k]);
        samples.blocked[k] = !triangles || triangles->occluded({o, d, 0, samples.tMost[k]});
    }
}

} // namespace limn
