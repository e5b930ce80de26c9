// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"

#include <glm/vec3.hpp>

namespace limn {

/// A vector of floats, doubles or integers as a list of three numbers.
template <class T>
Json vectorJson(const glm::vec<3, T>& v) {
    return {v.x, v.y, v.z};
}

} // namespace limn
