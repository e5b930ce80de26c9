// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"

#include <tiny_gltf.h>

namespace limn {

/// Unpacks the buffer views that EXT_meshopt_compression packs, each into a buffer of its own.
/// Fails, naming the view, on what is malformed and on what would not fit into memory.
Result<void> unpackMeshopt(tinygltf::Model& model, const MemoryBudget& memory);

} // namespace limn
