// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <string>

namespace limn {

/// 32-bit float RGB EXR, linear, row 0 at the top. The old file is there until the new one is
/// whole.
Result<void> writeExr(const std::string& path, const ImageF& image);

/// Any EXR or .hdr with R, G, B channels. Fails where it would not fit into memory, before anything
/// is allocated for it.
Result<ImageF> readFloatImage(const std::string& path, const MemoryBudget& memory = {});

/// 8-bit PNG, written as is. The old file is there until the new one is whole.
Result<void> writePng(const std::string& path, const Image& image);

/// A PNG, or a JPEG of whatever name.
Result<Image> readPng(const std::string& path);

} // namespace limn
