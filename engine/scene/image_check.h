// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace limn {

/// Whether no Huffman table of a JPEG holds more codes than its 256 symbols, and every scan's
/// tables are there. stb 2.27 writes those of a longer one over whatever lies behind the table, and
/// decodes by what memory happened to hold. Says nothing of what else may be wrong.
bool jpegTablesFit(std::span<const std::uint8_t> file);

/// Whether each chunk of a PNG, up to the one that ends it, lies within the file. stb allocates
/// what a chunk claims before it reads it.
bool pngChunksFit(std::span<const std::uint8_t> file);

} // namespace limn
