// SPDX-License-Identifier: MIT
// PNG, JPEG, WebP and KTX2.
#include "tests/fuzz/target.h"

#include "engine/scene/decode_image.h"

using namespace limn;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(data, size);
    const Result<ImageSize> said = imageSize(bytes);
    if (!said || !kFuzzMemory.allow("image", 4 * std::uint64_t(said->width) * said->height))
        return 0; // as the importer does
    const Result<Image> image = decodeImage(bytes);
    if (!image)
        return 0;
    require(image->width == said->width && image->height == said->height,
            "an image is as large as its header says");
    require(image->rgba.size() == std::size_t(4) * image->width * image->height,
            "an image has all its texels");
    return 0;
}
