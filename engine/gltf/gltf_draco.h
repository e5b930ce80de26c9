// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"

#include <tiny_gltf.h>

namespace limn {

/// Decodes the primitives that KHR_draco_mesh_compression packs, in parallel, and gives them
/// accessors of plain floats and indices. Fails, naming the primitive, on what is malformed and on
/// what would not fit into memory.
Result<void> unpackDraco(tinygltf::Model& model, const MemoryBudget& memory);

} // namespace limn
