// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <string>

namespace limn {

/// Writes 32-bit float RGB EXR, linear, row 0 at the top. The old file is kept until the new one is
/// complete.
Result<void> writeExr(const std::string& path, const ImageF& image);

/// Reads an EXR or .hdr with R, G, B channels. Fails, before allocating, if it would not fit into
/// memory.
Result<ImageF> readFloatImage(const std::string& path, const MemoryBudget& memory = {});

/// Writes an 8-bit PNG without converting the values. The old file is kept until the new one is
/// complete.
Result<void> writePng(const std::string& path, const Image& image);

/// The bytes of the file that writePng() writes.
Result<std::string> encodePng(const Image& image);

/// Reads a PNG or a JPEG, whatever the file's extension.
Result<Image> readPng(const std::string& path);

} // namespace limn
