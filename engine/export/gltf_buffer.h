// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/json/json.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// The buffer of a glTF file with its buffer views and accessors. Each add() appends an accessor
/// with a buffer view of its own, aligned to 4 bytes, and returns the accessor's index.
struct GltfBuffer {
    std::string bytes;
    Json views = Json::array();
    Json accessors = Json::array();

    /// Vertex attributes. The accessor of positions states their bounds, as glTF demands.
    std::size_t add(std::span<const glm::vec2> values);
    std::size_t add(std::span<const glm::vec3> values);
    std::size_t add(std::span<const glm::vec4> values);
    std::size_t addPositions(std::span<const glm::vec3> values);

    /// Vertex indices, with 16 bits each if there are fewer than 65 535 vertices.
    std::size_t addIndices(std::span<const std::uint32_t> values, std::size_t vertices);

    /// A file, without an accessor. Returns the index of its view.
    std::size_t addFile(std::string_view file);
};

/// A binary glTF file (.glb) of a document whose only buffer, without a URI, is `buffer`. Fails
/// where its lengths, which have 32 bits, do not suffice.
Result<std::string> binaryGltf(const Json& document, const std::string& buffer);

} // namespace limn
