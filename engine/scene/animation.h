// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace limn {

enum class Interpolation : std::uint8_t { Linear, Step, CubicSpline };

/// Values of one or several numbers at times that ascend, as glTF 2.0 has them.
struct KeyedValues {
    std::vector<float> times;  ///< not empty [s]
    std::vector<float> values; ///< of a key after the other; of splines, its tangents around it
    Interpolation interpolation = Interpolation::Linear;

    std::size_t width() const; ///< numbers of a key
};

/// The values at a time; those of the first or last key before or after them. `isRotation`: four
/// numbers x, y, z, w are interpolated on the sphere.
std::vector<double> valuesAt(const KeyedValues& keys, double seconds, bool isRotation);

enum class AnimatedProperty : std::uint8_t {
    Translation,
    Rotation,
    Scale, ///< of a node
    Color,
    Strength,
    Range ///< of a light
};

/// How a property of an object changes with time.
struct AnimationTrack {
    ObjectId object = 0;
    AnimatedProperty property = AnimatedProperty::Translation;
    KeyedValues keys;
};

/// A light or a camera, which documents place in the world, and the node that carries it.
struct CarriedObject {
    ObjectId object = 0, node = 0;
};

/// The animation of a scene file.
struct SceneAnimation {
    std::vector<AnimationTrack> tracks;
    std::vector<CarriedObject> carried;

    double duration() const; ///< time of the last key [s]
};

/// The document as the animation has it after some seconds. Objects that are gone, or are no longer
/// of the track's kind, are left out. What users moved by hand, and is not animated itself, keeps
/// its place relative to what carries it.
Document posedDocument(const Document& document, const SceneAnimation& animation, double seconds);

/// Makes the nodes with meshes that the animation moves dynamic, which a bake leaves out.
void makeMovingDynamic(Document& document, const SceneAnimation& animation);

} // namespace limn
