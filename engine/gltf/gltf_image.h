// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/gltf/gltf_file.h"
#include "engine/gltf/gltf_repairs.h"
#include "engine/scene/image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// The bytes of an image: of its file, or in a buffer view, which may be malformed.
Result<std::span<const std::uint8_t>> encodedImage(const GltfFile& file, std::size_t index);

/// Decodes the file's images in parallel and frees their encoded bytes. An image that is missing or
/// cannot be decoded becomes one white texel and a repair. Progress stage "images"; when cancelled
/// the result is incomplete.
std::vector<Image> decodeImages(GltfFile& file, const Progress& progress, GltfRepairs& repairs);

} // namespace limn
