// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/gltf/gltf_file.h"

#include <cstdint>
#include <string_view>

namespace limn {

/// Whether what the file describes fits into memory once it is read: images as texels, vertices
/// and triangles of all primitives, nodes of EXT_mesh_gpu_instancing. Two kilobytes can stand for
/// gigabytes: of images that compress well, of zeros, of accessors that many share. Names the part
/// that is largest. What is malformed counts nothing; its reader refuses it.
Result<void> checkGltfSize(const GltfFile& file, const MemoryBudget& memory);

/// About what parsing a glTF's JSON takes: at most, found with files of nothing but zeros or empty
/// nodes, and up to five times what it really is.
std::uint64_t jsonBytes(std::string_view text);

} // namespace limn
