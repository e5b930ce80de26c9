// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace limn {

/// A vector of floats, doubles or integers as a list of three numbers.
template <class T>
nlohmann::ordered_json vectorJson(const glm::vec<3, T>& v) {
    return {v.x, v.y, v.z};
}

} // namespace limn
