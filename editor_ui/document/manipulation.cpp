// SPDX-License-Identifier: MIT
#include "editor_ui/document/manipulation.h"

#include "editor_ui/document/light_angles.h"
#include "editor_ui/document/object_rules.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

/// The rotation nearest to a matrix; the identity for a singular one. A mirrored matrix counts as
/// its negative.
/// Higham. Computing the Polar Decomposition - with Applications. 1986
static glm::dmat3 nearestRotation(glm::dmat3 m) {
    const double volume = glm::determinant(m);
    if (!std::isfinite(volume) || volume == 0)
        return glm::dmat3(1);
    m *= 1 / std::cbrt(volume); // also turns a mirrored matrix into its negative
    for (int i = 0; i < 40; ++i)
        m = 0.5 * (m + glm::transpose(glm::inverse(m)));
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(glm::length(m[c]) - 1) < 1e-3))
            return glm::dmat3(1);
    return m;
}

static glm::dmat4 parentToWorld(const Document& document, const Node& node) {
    return Placements(document).of(node.parent).toWorld;
}

static glm::dvec3 movedPoint(const Manipulation& manipulation, glm::dvec3 p) {
    const glm::dmat3 axes(manipulation.axes);
    const glm::dvec3 from = p - glm::dvec3(manipulation.pivot);
    const glm::dvec3 scaled =
        axes * (glm::dvec3(manipulation.scale) * (glm::transpose(axes) * from));
    return glm::dvec3(manipulation.pivot) + glm::dquat(manipulation.turn) * scaled +
           glm::dvec3(manipulation.move);
}

/// What the scale does to lengths along a unit vector; negative where it mirrors it.
static float factorAlong(const Manipulation& manipulation, glm::vec3 axis) {
    const glm::vec3 inAxes = glm::transpose(manipulation.axes) * axis,
                    scaled = manipulation.scale * inAxes;
    return glm::dot(inAxes, scaled) < 0 ? -glm::length(scaled) : glm::length(scaled);
}

/// `scale` times `factor`, held within the limits, or within those of `scale` if it is beyond them.
static float limitedScale(float scale, float factor) {
    const float size = std::abs(scale), wanted = scale * factor;
    const float limited =
        std::clamp(std::abs(wanted), std::min(kMinNodeScale, size), std::max(kMaxNodeScale, size));
    return std::copysign(limited, wanted);
}

static bool turns(const Manipulation& manipulation) {
    return manipulation.turn != glm::quat(1, 0, 0, 0);
}

static void manipulate(const Document& document, Node& node, const Manipulation& manipulation) {
    const glm::dmat4 parent = parentToWorld(document, node);
    const glm::dmat3 linear(parent);
    Transform& t = node.transform;
    const glm::dvec3 from = parent * glm::dvec4(t.translation, 1),
                     to = movedPoint(manipulation, from);
    if (to != from)
        t.translation += glm::inverse(linear) * (to - from);
    if (manipulation.scale != glm::vec3(1)) {
        const glm::dmat3 axes = linear * glm::mat3_cast(glm::dquat(t.rotation));
        for (int i = 0; i < 3; ++i)
            t.scale[i] = limitedScale(
                t.scale[i], manipulation.alongOwnAxes
                                ? manipulation.scale[i]
                                : factorAlong(manipulation, glm::vec3(glm::normalize(axes[i]))));
    }
    if (turns(manipulation)) {
        const glm::dquat toWorld = glm::quat_cast(nearestRotation(linear));
        t.rotation =
            glm::quat(glm::normalize(glm::inverse(toWorld) * glm::dquat(manipulation.turn) *
                                     toWorld * glm::dquat(t.rotation)));
    }
}

static void manipulate(const Document& document, Light& light, const Manipulation& manipulation) {
    const bool rectangle = light.kind == LightKind::Rectangle;
    const glm::mat3 axes = ownAxes(document, light);
    light.position = glm::vec3(movedPoint(manipulation, light.position));
    if (rectangle && manipulation.scale != glm::vec3(1))
        for (int i = 0; i < 2; ++i)
            light.size[i] =
                std::clamp(light.size[i] * std::abs(manipulation.alongOwnAxes
                                                        ? manipulation.scale[i]
                                                        : factorAlong(manipulation, axes[i])),
                           kMinLightSize, kMaxLightSize);
    if (!turns(manipulation) || !hasDirection(light))
        return;
    light.direction = glm::normalize(manipulation.turn * light.direction);
    if (rectangle || profileOf(light))
        light.roll = rollTowards(light, manipulation.turn * axes[0]);
}

static void manipulate(const Document&, Camera& camera, const Manipulation& manipulation) {
    const glm::vec3 ahead = camera.target - camera.eye;
    camera.eye = glm::vec3(movedPoint(manipulation, camera.eye));
    camera.target = camera.eye + manipulation.turn * ahead;
    if (turns(manipulation))
        camera.up = glm::normalize(manipulation.turn * camera.up);
}

Object manipulated(const Document& document, const Object& object,
                   const Manipulation& manipulation) {
    Object after = object;
    if (auto* node = std::get_if<Node>(&after))
        manipulate(document, *node, manipulation);
    else if (auto* light = std::get_if<Light>(&after))
        manipulate(document, *light, manipulation);
    else if (auto* camera = std::get_if<Camera>(&after))
        manipulate(document, *camera, manipulation);
    return isValid(after) ? after : object;
}

Transform transformed(const glm::dmat4& matrix, const Transform& transform) {
    const glm::dmat3 linear(matrix);
    const glm::dmat3 axes = linear * glm::mat3_cast(glm::dquat(transform.rotation));
    const double side = glm::determinant(linear) < 0 ? -1 : 1; // nearestRotation() takes -linear
    Transform after;
    after.translation = matrix * glm::dvec4(transform.translation, 1);
    after.rotation = glm::quat(
        glm::normalize(glm::quat_cast(nearestRotation(linear)) * glm::dquat(transform.rotation)));
    for (int i = 0; i < 3; ++i)
        after.scale[i] = float(side * glm::length(axes[i]) * double(transform.scale[i]));
    return after;
}

glm::mat3 ownAxes(const Document& document, const Object& object) {
    if (const auto* node = std::get_if<Node>(&object))
        return glm::mat3(nearestRotation(glm::dmat3(parentToWorld(document, *node)) *
                                         glm::mat3_cast(glm::dquat(node->transform.rotation))));
    if (const auto* camera = std::get_if<Camera>(&object))
        return glm::transpose(glm::mat3(viewMatrix(*camera)));
    const auto* light = std::get_if<Light>(&object);
    if (!light || !hasDirection(*light))
        return glm::mat3(1);
    const LightRectangle r = lightRectangle(*light);
    const glm::vec3 x = glm::normalize(r.halfWidth), y = glm::normalize(r.halfHeight);
    return {x, y, glm::cross(x, y)};
}

} // namespace limn
