// SPDX-License-Identifier: MIT
#include "engine/files/image_file.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/files/exr_check.h"
#include "engine/files/flip_rows.h"
#include "engine/files/hdr_image.h"
#include "engine/scene/decode_image.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <stb/stb_image_write.h>
#include <tinyexr.h>

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

Result<std::string> encodeExr(const ImageF& image) {
    if (image.width == 0 || image.height == 0)
        return fail("the image is empty");
    const std::size_t count = std::size_t(image.width) * image.height;
    std::vector<float> planes(count * 3); // blue, green, red: channels are sorted by name
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            planes[c * count + i] = image.rgb[i][int(2 - c)];
    float* const pointers[3] = {&planes[0], &planes[count], &planes[2 * count]};

    EXRImage exr;
    InitEXRImage(&exr);
    exr.num_channels = 3;
    exr.images = reinterpret_cast<unsigned char**>(const_cast<float**>(pointers));
    exr.width = int(image.width);
    exr.height = int(image.height);
    EXRHeader header;
    InitEXRHeader(&header);
    EXRChannelInfo channels[3] = {};
    const char* const names[3] = {"B", "G", "R"};
    int types[3] = {TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT};
    for (int c = 0; c < 3; ++c)
        std::strcpy(channels[c].name, names[c]);
    header.num_channels = 3;
    header.channels = channels;
    header.pixel_types = types;
    header.requested_pixel_types = types;
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;

    unsigned char* memory = nullptr;
    const char* problem = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&exr, &header, &memory, &problem);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owned(memory, std::free);
    if (size == 0) {
        const std::string reason = problem ? problem : "unknown";
        FreeEXRErrorMessage(problem);
        return fail(fmt::format("cannot encode EXR: {}", reason));
    }
    return std::string(reinterpret_cast<const char*>(memory), size);
}

static Result<void> replaceWith(const std::string& path, const Result<std::string>& bytes) {
    if (!bytes)
        return fail(fmt::format("{}: {}", path, bytes.error().message));
    return replaceFile(path, *bytes);
}

Result<void> writeExr(const std::string& path, const ImageF& image) {
    return replaceWith(path, encodeExr(image));
}

namespace {

/// Frees what tinyexr allocated on every exit of a function.
struct ExrFile {
    EXRHeader header;
    EXRImage image;

    ExrFile() {
        InitEXRHeader(&header);
        InitEXRImage(&image);
    }
    ~ExrFile() {
        FreeEXRImage(&image);
        FreeEXRHeader(&header);
    }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;
};

} // namespace

static tl::unexpected<Error> exrFailure(const std::string& path, const char* problem) {
    std::string reason = problem ? problem : "malformed EXR";
    FreeEXRErrorMessage(problem);
    return fail(fmt::format("{}: {}", path, reason.substr(0, reason.find('\n'))));
}

/// Finds the indices of R, G and B and requests them as floats.
static Result<std::array<int, 3>> colorChannels(const std::string& path, EXRHeader& header) {
    std::array<int, 3> channels = {-1, -1, -1};
    for (int c = 0; c < header.num_channels; ++c)
        for (std::size_t i = 0; i < 3; ++i)
            if (header.channels[c].name == std::string_view("RGB").substr(i, 1))
                channels[i] = c;
    for (std::size_t i = 0; i < 3; ++i) {
        const int c = channels[i];
        if (c < 0)
            return fail(fmt::format("{}: channels: there is no {}", path, "RGB"[i]));
        if (header.pixel_types[c] == TINYEXR_PIXELTYPE_UINT)
            return fail(fmt::format("{}: channels: {} holds integers", path, "RGB"[i]));
        header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    }
    return channels;
}

static Result<ImageF> readExr(const std::string& path, std::span<const std::uint8_t> bytes,
                              const MemoryBudget& memory) {
    const Result<ExrSize> size = checkExr(bytes);
    if (!size)
        return fail(fmt::format("{}: {}", path, size.error().message));
    // tinyexr's planes of all channels, and the pixels built from three of them.
    const std::uint64_t needed =
        size->texels() * (size->channels * sizeof(float) + sizeof(glm::vec3));
    if (const Result<void> fits = memory.allow(path, needed); !fits)
        return tl::make_unexpected(fits.error());
    EXRVersion version;
    if (ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size()) != TINYEXR_SUCCESS)
        return exrFailure(path, nullptr);
    ExrFile exr;
    const char* problem = nullptr;
    if (ParseEXRHeaderFromMemory(&exr.header, &version, bytes.data(), bytes.size(), &problem) !=
        TINYEXR_SUCCESS)
        return exrFailure(path, problem);
    const Result<std::array<int, 3>> channels = colorChannels(path, exr.header);
    if (!channels)
        return tl::make_unexpected(channels.error());
    // On failure tinyexr frees the image using its number of channels, which is not set by then.
    exr.image.num_channels = exr.header.num_channels;
    if (LoadEXRImageFromMemory(&exr.image, &exr.header, bytes.data(), bytes.size(), &problem) !=
        TINYEXR_SUCCESS) {
        InitEXRImage(&exr.image);
        return exrFailure(path, problem);
    }
    ImageF out;
    out.width = std::uint32_t(exr.image.width);
    out.height = std::uint32_t(exr.image.height);
    out.rgb.resize(std::size_t(out.width) * out.height);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto* plane = reinterpret_cast<const float*>(exr.image.images[(*channels)[i]]);
        for (std::size_t k = 0; k < out.rgb.size(); ++k)
            out.rgb[k][int(i)] = plane[k];
    }
    // tinyexr turns files around whose lines are stored from the last to the first. Every line says
    // which one it is, so that their order changes nothing.
    constexpr int kDecreasing = 1;
    if (exr.header.line_order == kDecreasing)
        flipRows(out);
    return out;
}

Result<ImageF> readFloatImage(const std::string& path, const MemoryBudget& memory) {
    Result<std::string> read = readBytes(path);
    if (!read)
        return tl::make_unexpected(read.error());
    const std::size_t size = read->size();
    read->append(kExrPadding, '\0');
    const std::span<const std::uint8_t> bytes = spanOf(*read).first(size);
    if (read->starts_with("\x76\x2f\x31\x01"))
        return readExr(path, bytes, memory);
    if (!isHdr(bytes))
        return fail(fmt::format("{}: neither EXR nor HDR", path));
    Result<ImageF> image = decodeHdr(bytes, memory);
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
