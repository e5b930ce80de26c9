// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

namespace limn {

/// Checks the types of the glTF 2.0 fields that Limn reads, their required presence, array lengths
/// and the range of every index. tinygltf leaves out silently what has the wrong type; we name it
/// ("nodes[3].rotation: not 4 numbers"). Extension and extras objects are not entered.
Result<void> checkGltfSchema(const nlohmann::json& root);

} // namespace limn
