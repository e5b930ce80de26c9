// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/gltf/gltf_file.h"

#include <cstdint>
#include <string_view>

namespace limn {

/// Checks whether the decoded contents of the file fit into memory: images as texels, vertices and
/// triangles of all primitives, nodes of EXT_mesh_gpu_instancing. Two kilobytes can stand for
/// gigabytes, by images that compress well, zeros or shared accessors. The message names the
/// largest part. Malformed parts count as nothing; their readers reject them.
Result<void> checkGltfSize(const GltfFile& file, const MemoryBudget& memory);

/// Estimated memory for parsing a glTF's JSON [bytes]: an upper bound, measured with files of
/// nothing but zeros or empty nodes, and up to five times the actual amount.
std::uint64_t jsonBytes(std::string_view text);

} // namespace limn
