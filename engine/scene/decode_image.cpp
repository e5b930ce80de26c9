// SPDX-License-Identifier: MIT
#include "engine/scene/decode_image.h"

#include "engine/scene/image_check.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include <stb/stb_image.h>

namespace limn {

namespace {

constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
constexpr std::array<std::uint8_t, 3> kJpeg = {0xff, 0xd8, 0xff};

/// No image has more: deflate packs 1032 bytes into one, each of eight black or white texels.
constexpr std::uint64_t kMostTexelsPerByte = 8 * 1032;

bool startsWith(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> signature) {
    return bytes.size() >= signature.size() &&
           std::ranges::equal(bytes.first(signature.size()), signature);
}

} // namespace

Result<ImageSize> imageSize(std::span<const std::uint8_t> bytes) {
    if (bytes.empty())
        return fail("is missing");
    if (!startsWith(bytes, kPng) && !startsWith(bytes, kJpeg)) // stb would try all that it knows
        return fail("is neither PNG nor JPEG");
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max()))
        return fail("is too large");
    if (startsWith(bytes, kPng) ? !pngChunksFit(bytes) : !jpegTablesFit(bytes))
        return fail("is damaged");
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels))
        return fail("is damaged");
    const std::uint64_t texels = std::uint64_t(width) * std::uint64_t(height);
    if (width <= 0 || height <= 0 || texels > kMostTexels)
        return fail("is too large");
    if (texels / kMostTexelsPerByte > bytes.size())
        return fail("is damaged"); // cut short: all of it would be filled in
    return ImageSize{std::uint32_t(width), std::uint32_t(height)};
}

Result<Image> decodeImage(std::span<const std::uint8_t> bytes) {
    if (const Result<ImageSize> size = imageSize(bytes); !size)
        return tl::make_unexpected(size.error());
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels, 4),
        stbi_image_free);
    if (!pixels)
        return fail("is damaged");
    Image image;
    image.width = std::uint32_t(width);
    image.height = std::uint32_t(height);
    image.rgba.assign(pixels.get(), pixels.get() + std::size_t(width) * std::size_t(height) * 4);
    return image;
}

} // namespace limn
