// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace limn {

/// `pixels` row by row from the top, `channels` (3 or 4) bytes each, sRGB. False when it cannot be
/// written.
bool writePng(const std::string& path, int width, int height, int channels,
              const std::vector<unsigned char>& pixels);

} // namespace limn
