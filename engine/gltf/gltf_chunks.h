// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <optional>
#include <string_view>

namespace limn {

/// Parts of a .gltf or .glb file, within its bytes.
struct GltfChunks {
    std::string_view json;
    std::optional<std::string_view> binary; ///< of a .glb that has such a chunk
};

/// Divides a file into its parts. Chunks of unknown type are passed over, as glTF 2.0 says. Fails
/// on what is neither glTF nor a GLB of version 2, and on chunks that exceed the file.
Result<GltfChunks> splitGltf(std::string_view bytes);

} // namespace limn
