// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/gltf_file.h"

namespace limn {

/// Whether what the file describes fits into memory once it is read: images as texels, vertices
/// and triangles of all primitives, nodes of EXT_mesh_gpu_instancing. Two kilobytes can stand for
/// gigabytes: of images that compress well, of zeros, of accessors that many share. Names the part
/// that is largest. What is malformed counts nothing; its reader refuses it.
Result<void> checkGltfSize(const GltfFile& file, const MemoryBudget& memory);

} // namespace limn
