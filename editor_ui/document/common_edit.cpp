// SPDX-License-Identifier: MIT
#include "editor_ui/document/common_edit.h"

namespace limn {

template <class T>
static void copyField(const T& before, const T& after, T& other) {
    if (before != after)
        other = after;
}

/// Each component on its own, so that an edit of X leaves the other objects' Y alone.
template <class Vector>
static void copyComponents(const Vector& before, const Vector& after, Vector& other) {
    for (int i = 0; i < Vector::length(); ++i)
        copyField(before[i], after[i], other[i]);
}

static void copy(const Node& before, const Node& after, Node& other) {
    const Transform &from = before.transform, &to = after.transform;
    other.transform.translation += to.translation - from.translation;
    copyField(from.rotation, to.rotation, other.transform.rotation);
    copyComponents(from.scale, to.scale, other.transform.scale);
    copyField(before.visible, after.visible, other.visible);
    copyField(before.dynamic, after.dynamic, other.dynamic);
    copyField(before.texelDensity, after.texelDensity, other.texelDensity);
}

static void copy(const Light& before, const Light& after, Light& other) {
    copyField(before.kind, after.kind, other.kind);
    copyField(before.enabled, after.enabled, other.enabled);
    other.position += after.position - before.position;
    copyField(before.direction, after.direction, other.direction);
    copyComponents(before.color, after.color, other.color);
    copyField(before.strength, after.strength, other.strength);
    copyField(before.range, after.range, other.range);
    copyField(before.outerAngle, after.outerAngle, other.outerAngle);
    copyField(before.innerAngle, after.innerAngle, other.innerAngle);
    copyComponents(before.size, after.size, other.size);
    copyField(before.roll, after.roll, other.roll);
    copyField(before.profile, after.profile, other.profile);
}

static void copy(const Material& before, const Material& after, Material& other) {
    copyComponents(before.baseColor, after.baseColor, other.baseColor);
    copyField(before.metallic, after.metallic, other.metallic);
    copyField(before.roughness, after.roughness, other.roughness);
    copyComponents(before.emission, after.emission, other.emission);
    copyField(before.alphaMode, after.alphaMode, other.alphaMode);
    copyField(before.alphaCutoff, after.alphaCutoff, other.alphaCutoff);
    copyField(before.doubleSided, after.doubleSided, other.doubleSided);
    copyField(before.normalScale, after.normalScale, other.normalScale);
    copyField(before.transmission, after.transmission, other.transmission);
    copyField(before.ior, after.ior, other.ior);
    copyField(before.thickness, after.thickness, other.thickness);
    copyField(before.emissiveFlipbook.columns, after.emissiveFlipbook.columns,
              other.emissiveFlipbook.columns);
    copyField(before.emissiveFlipbook.rows, after.emissiveFlipbook.rows,
              other.emissiveFlipbook.rows);
    copyField(before.emissiveFlipbook.framesPerSecond, after.emissiveFlipbook.framesPerSecond,
              other.emissiveFlipbook.framesPerSecond);
}

static void copy(const Camera& before, const Camera& after, Camera& other) {
    other.eye += after.eye - before.eye;
    other.target += after.target - before.target;
    copyField(before.up, after.up, other.up);
    copyField(before.fovY, after.fovY, other.fovY);
}

template <class T>
static bool copyOf(const Object& before, const Object& after, Object& other) {
    const T *from = std::get_if<T>(&before), *to = std::get_if<T>(&after);
    T* target = std::get_if<T>(&other);
    if (!from || !to || !target)
        return false;
    copy(*from, *to, *target);
    return true;
}

void copyChanges(const Object& before, const Object& after, Object& other) {
    copyOf<Node>(before, after, other) || copyOf<Light>(before, after, other) ||
        copyOf<Material>(before, after, other) || copyOf<Camera>(before, after, other);
}

} // namespace limn
