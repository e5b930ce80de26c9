// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace limn {

// Bytes of the glTF extension EXT_meshopt_compression, without loss.

/// `count` vertices of `stride` bytes each, a multiple of 4 up to 256, in mode ATTRIBUTES.
std::string meshoptVertices(const void* vertices, std::size_t count, std::size_t stride);

/// Triangles in mode TRIANGLES. A triangle may come back with another corner first.
std::string meshoptTriangles(std::span<const std::uint32_t> indices, std::size_t vertices);

/// The triangles in an order in which neighbours follow each other, which takes fewer bytes.
std::vector<std::uint32_t> orderedTriangles(std::span<const std::uint32_t> indices,
                                            std::size_t vertices);

} // namespace limn
