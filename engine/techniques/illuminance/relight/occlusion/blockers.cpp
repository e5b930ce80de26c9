// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/occlusion/blockers.h"

#include "engine/core/hash.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// Scale of a matrix that only rotates and scales uniformly, up to rounding; else 0.
float uniformScale(const glm::mat3& m) {
    const glm::mat3 products = glm::transpose(m) * m;
    const float square = std::max({products[0][0], products[1][1], products[2][2]});
    const glm::mat3 rest = products - glm::mat3(square);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(rest[i][k]) <= 1e-4f * square))
                return 0;
    return 1.001f * std::sqrt(square);
}

/// Places a blocker by its instance. Returns false where it cannot block.
bool place(const Instance& instance, Blocker& b) {
    const glm::mat3 linear(instance.toWorld);
    const Bounds& box = b.shape->box;
    b.toObject = glm::inverse(linear);
    b.origin = glm::vec3(instance.toWorld[3]);
    b.bounds = kNoBounds;
    for (unsigned k = 0; k < 8; ++k) {
        const glm::vec3 side(k & 1U, k >> 1 & 1U, k >> 2);
        extend(b.bounds, b.origin + linear * glm::mix(box.lower, box.upper, side));
    }
    b.centre = b.origin + linear * box.centre();
    for (unsigned k = 0; k < 4; ++k) { // the opposite corners are as far away
        const glm::vec3 side(k & 1U, k >> 1, 1);
        b.radius = std::max(b.radius, glm::length(linear * ((side - 0.5f) * box.size())));
    }
    if (const float scale = uniformScale(linear); b.shape->outerBall > 0 && scale > 0)
        b.radius = std::min(b.radius, b.shape->outerBall * scale);
    return b.radius > 0 && std::isfinite(b.radius) && std::isfinite(glm::length(b.centre)) &&
           std::abs(glm::determinant(linear)) > 0 && std::isfinite(glm::determinant(b.toObject));
}

} // namespace

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

} // namespace limn
