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

/// A glTF as read by tinygltf, with its buffers loaded and its images still encoded. Only the JSON
/// types in `model` have been checked: its users must validate every index, offset and number.
struct GltfFile {
    tinygltf::Model model;
    std::vector<std::vector<std::uint8_t>>
        encodedImages;                      ///< per image; empty: in a buffer view, or missing
    std::vector<std::string> imageProblems; ///< per image: why its file could not be read, or empty
    std::uint64_t hash = 0;                 ///< of the main file and the buffers
};

/// Reads a glTF file. Fails, without the path in the message, on files that are not glTF 2.0, on
/// missing buffers and on unsupported required extensions. An image that cannot be read is not a
/// failure.
Result<GltfFile> readGltfFile(const std::string& path, FileReach reach, const MemoryBudget& memory);

} // namespace limn
