// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/gltf/gltf_uri.h"

#include <cstdint>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace limn {

/// A glTF as tinygltf reads it, its buffers loaded, its images still encoded. Nothing in `model`
/// has been checked beyond JSON types: every index, offset and number must be validated by who uses
/// it.
struct GltfFile {
    tinygltf::Model model;
    std::vector<std::vector<std::uint8_t>>
        encodedImages;                      ///< per image; empty: in a buffer view, or missing
    std::vector<std::string> imageProblems; ///< per image: why its file was not read; empty: it was
    std::uint64_t hash = 0;                 ///< of the main file and the buffers
};

/// Fails, without the path in the message, on files that are no glTF 2.0, on missing buffers and on
/// required extensions we lack. An image that cannot be read is no failure.
Result<GltfFile> readGltfFile(const std::string& path, FileReach reach, const MemoryBudget& memory);

} // namespace limn
