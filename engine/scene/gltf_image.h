// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/scene/gltf_file.h"
#include "engine/scene/gltf_repairs.h"
#include "engine/scene/image.h"

#include <vector>

namespace limn {

/// Decodes the file's images in parallel and frees their encoded bytes. An image that is missing or
/// cannot be decoded becomes one white texel and a repair. Progress stage "images"; when cancelled
/// the result is incomplete.
std::vector<Image> decodeImages(GltfFile& file, const Progress& progress, GltfRepairs& repairs);

} // namespace limn
