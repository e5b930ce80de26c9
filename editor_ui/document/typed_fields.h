// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Euler angles as typed by the user, valid while the object still has `rotation`.
struct EulerEdit {
    ObjectId id = 0;
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 degrees{0};
};

/// What is typed into the inspector's field that takes a light's strength with any unit.
struct TypedLight {
    std::string text, problem; ///< why the text means nothing; empty: it does
    ObjectId light = 0;        ///< that it is typed for
};

} // namespace limn
