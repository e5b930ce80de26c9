// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/json/json.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// How a glTF file stores geometry; ExportSettings has the same switches.
struct GltfPacking {
    bool quantize = false; ///< vertices as integers, by KHR_mesh_quantization
    bool meshopt = false;  ///< compressed, by EXT_meshopt_compression, where that takes fewer bytes
};

/// The buffer of a glTF file with its buffer views and accessors. Each add() appends an accessor
/// with a buffer view of its own, aligned to 4 bytes, and returns the accessor's index.
struct GltfBuffer {
    GltfPacking packing;
    std::string bytes;
    Json views = Json::array();
    Json accessors = Json::array();
    /// Bytes of what is compressed before it was; 0: nothing is. Its views lie in a second buffer
    /// of that size, which has no data.
    std::size_t unpackedBytes = 0;

    /// Vertex attributes. Texture coordinates and colours outside [0, 1] are stored as floats
    /// whatever the packing.
    std::size_t addNormals(std::span<const glm::vec3> values);
    std::size_t addTangents(std::span<const glm::vec4> values);
    std::size_t addTexCoords(std::span<const glm::vec2> values);
    std::size_t addColors(std::span<const glm::vec4> values);

    /// Positions, with their bounds, as glTF demands. `toObject` becomes what takes stored
    /// positions to those given.
    std::size_t addPositions(std::span<const glm::vec3> values, glm::mat4& toObject);

    /// Vertex indices, with 16 bits each if there are fewer than 65 535 vertices. Where they are
    /// compressed, triangles change their order.
    std::size_t addIndices(std::span<const std::uint32_t> values, std::size_t vertices);

    /// A file, without an accessor. Returns the index of its view.
    std::size_t addFile(std::string_view file);
};

/// A binary glTF file (.glb) of a document whose only buffer with data, without a URI, is `buffer`.
/// Fails where its lengths, which have 32 bits, do not suffice.
Result<std::string> binaryGltf(const Json& document, const std::string& buffer);

} // namespace limn
