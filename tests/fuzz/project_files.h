// SPDX-License-Identifier: MIT
#pragma once

#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"

#include <string>

namespace limn {

/// What the fuzzed projects' scene.glb is: two textured triangles that a lamp lights.
inline std::string projectScene() {
    return fileBytes(sourcePath("tests/corpus/gltf/plain.glb"));
}

/// And their sky.hdr: two texels, not packed.
inline std::string projectSky() {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" +
           std::string("\x80\x80\x80\x80\x10\x20\x40\x82", 8);
}

} // namespace limn
