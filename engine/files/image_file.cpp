// SPDX-License-Identifier: MIT
#include "engine/files/image_file.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/files/exr_image.h"
#include "engine/files/hdr_image.h"
#include "engine/scene/decode_image.h"

#include <filesystem>
#include <limits>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <stb/stb_image_write.h>

namespace limn {

static Result<std::string> readBytes(const std::string& path) {
    Result<std::string> bytes = readFile(path, std::numeric_limits<int>::max());
    if (!bytes)
        return fail(fmt::format("{}: {}", path, bytes.error().message));
    return bytes;
}

static std::span<const std::uint8_t> spanOf(const std::string& bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

static Result<void> replaceWith(const std::string& path, const Result<std::string>& bytes) {
    if (!bytes)
        return fail(fmt::format("{}: {}", path, bytes.error().message));
    return replaceFile(path, *bytes);
}

Result<void> writeExr(const std::string& path, const ImageF& image) {
    return replaceWith(path, encodeExr(image));
}

Result<ImageF> readFloatImage(const std::string& path, const MemoryBudget& memory) {
    const Result<std::string> read = readBytes(path);
    if (!read)
        return tl::make_unexpected(read.error());
    const std::span<const std::uint8_t> bytes = spanOf(*read);
    if (!isExr(bytes) && !isHdr(bytes))
        return fail(fmt::format("{}: neither EXR nor HDR", path));
    Result<ImageF> image = isExr(bytes) ? decodeExr(bytes, memory) : decodeHdr(bytes, memory);
    if (!image)
        return fail(fmt::format("{}: {}", path, image.error().message));
    return image;
}

Result<std::string> encodePng(const Image& image) {
    if (image.width == 0 || image.height == 0)
        return fail("the image is empty");
    std::string png;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                                   std::size_t(size));
    };
    if (!stbi_write_png_to_func(append, &png, int(image.width), int(image.height), 4,
                                image.rgba.data(), int(image.width) * 4))
        return fail("cannot encode PNG");
    return png;
}

Result<void> writePng(const std::string& path, const Image& image) {
    return replaceWith(path, encodePng(image));
}

Result<Image> readPng(const std::string& path) {
    const Result<std::string> bytes = readBytes(path);
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    Result<Image> image = decodeImage(spanOf(*bytes));
    if (!image)
        return fail(fmt::format("{} {}", path, image.error().message));
    image->name = std::filesystem::path(path).filename().string();
    return image;
}

} // namespace limn
