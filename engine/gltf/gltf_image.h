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

/// Encoded bytes of an image, from its file or from a buffer view, which may be malformed.
Result<std::span<const std::uint8_t>> encodedImage(const GltfFile& file, std::size_t index);

struct DecodedImages {
    std::vector<Image> images;
    std::vector<std::uint32_t> missing; ///< those that are white instead
};

/// Decodes the file's images in parallel and frees their encoded bytes. An image that is missing or
/// cannot be decoded becomes one white texel and is reported in `repairs`. Fails on one that
/// KHR_texture_basisu names where the file requires that. Progress stage "images"; the result is
/// incomplete when cancelled.
Result<DecodedImages> decodeImages(GltfFile& file, const Progress& progress, GltfRepairs& repairs);

} // namespace limn
