// SPDX-License-Identifier: MIT
// KTX2 textures.
#include "tests/fuzz/target.h"

#include "engine/files/ktx2.h"

#include <algorithm>
#include <cmath>

using namespace limn;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto shape = readKtx2Shape({data, size});
    const auto texture = decodeKtx2({data, size}, kFuzzMemory);
    if (!texture)
        return 0;
    require(shape && *shape == texture->shape,
            "a texture that was read has the shape that it says");
    require(texture->texels.size() == texture->shape.texels(), "a texture has all of its texels");
    for (const glm::vec4& texel : texture->texels)
        for (int c = 0; c < 4; ++c)
            require(std::isfinite(texel[c]), "a texel is a number");
    // What was read is written again as a file that reads alike, rounding done.
    const auto written = encodeKtx2(texture->shape, texture->texels);
    require(written.has_value(), "a texture that was read can be written");
    const auto again = decodeKtx2(
        {reinterpret_cast<const std::uint8_t*>(written->data()), written->size()}, kFuzzMemory);
    require(again && again->shape == texture->shape, "what was written is read");
    if (texture->shape.format != Ktx2Format::Rgb9e5) // whose mantissas need not be normalised
        require(std::ranges::equal(again->texels, texture->texels), "and has the same texels");
    return 0;
}
