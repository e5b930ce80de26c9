// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace limn {

/// Where the bytes of a buffer or an image are that is not in a buffer view.
struct GltfSource {
    bool isBuffer = false;
    std::size_t index = 0;    ///< in the root's `buffers` or `images`
    std::string uri;          ///< of a file or of data; empty: those of the binary chunk
    std::uint64_t length = 0; ///< of a buffer; its file may be longer
    std::string problem;      ///< why it has none, or empty
};

/// Makes the JSON plain for tinygltf, and returns the sources in the order in which it reads them:
/// buffers, then images. Whole numbers written as 1.0 become integers, because tinygltf takes those
/// in extensions and in some fields for missing. Every source gets a file name in place of its URI,
/// because tinygltf decodes data of a few media types only, and loses count of images without data.
/// Channels of animations get a node where they have none, and primitives that Draco packs lose
/// their indices, which it holds. Images with neither a URI nor a buffer view, or with both, get a
/// problem. `json` has passed checkGltfSchema().
std::vector<GltfSource> makePlain(nlohmann::json& json, bool hasBinary);

} // namespace limn
