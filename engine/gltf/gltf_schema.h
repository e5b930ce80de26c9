// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

namespace limn {

/// Checks the types, required presence and array lengths of the glTF 2.0 fields that Limn reads,
/// and the range of every index. tinygltf silently ignores fields of the wrong type; this check
/// names them ("nodes[3].rotation: not 4 numbers"). Extension and extras objects are not checked.
Result<void> checkGltfSchema(const nlohmann::json& root);

} // namespace limn
