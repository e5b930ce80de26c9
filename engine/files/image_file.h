// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <string>

namespace limn {

/// 32-bit float RGB EXR, linear, row 0 at the top. Any EXR or .hdr with R, G, B channels can be
/// read.
Result<void> writeExr(const std::string& path, const ImageF& image);
Result<ImageF> readFloatImage(const std::string& path);

/// 8-bit PNG, written as is.
Result<void> writePng(const std::string& path, const Image& image);
Result<Image> readPng(const std::string& path);

} // namespace limn
