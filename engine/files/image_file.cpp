// SPDX-License-Identifier: MIT
#include "engine/files/image_file.h"

#include "engine/files/exr_check.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#include <tinyexr.h>

namespace limn {

/// Refused before anything is allocated: 16k x 16k.
static constexpr std::uint64_t kMaxTexels = std::uint64_t(1) << 28;

using Bytes = std::vector<unsigned char>;

static Result<Bytes> readBytes(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        return fail(fmt::format("{}: no such file", path));
    if (!std::filesystem::is_regular_file(path, error))
        return fail(fmt::format("{}: not a file", path));
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? std::streamoff(file.tellg()) : -1;
    if (size < 0)
        return fail(fmt::format("{}: cannot read", path));
    if (size > std::numeric_limits<int>::max())
        return fail(fmt::format("{}: larger than 2 GiB", path));
    Bytes bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), size))
        return fail(fmt::format("{}: cannot read", path));
    return bytes;
}

static Result<void> writeBytes(const std::string& path, const void* data, std::size_t size) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(static_cast<const char*>(data), std::streamsize(size));
    file.close();
    if (!file)
        return fail(fmt::format("{}: cannot write", path));
    return {};
}

Result<void> writeExr(const std::string& path, const ImageF& image) {
    if (image.width == 0 || image.height == 0)
        return fail(fmt::format("{}: the image is empty", path));
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
        return fail(fmt::format("{}: cannot encode EXR: {}", path, reason));
    }
    return writeBytes(path, memory, size);
}

namespace {

/// Frees what tinyexr allocated, whichever way a function is left.
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

/// The indices of R, G and B; wants them as floats.
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

static Result<ImageF> readExr(const std::string& path, const Bytes& bytes) {
    if (const Result<void> valid = checkExr(bytes); !valid)
        return fail(fmt::format("{}: {}", path, valid.error().message));
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
    // On failure tinyexr frees the image, by its number of channels, which it has not set by then.
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
    return out;
}

static bool tooLarge(const Bytes& bytes) {
    int width = 0, height = 0, channels = 0;
    return stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels) &&
           std::uint64_t(width) * std::uint64_t(height) > kMaxTexels;
}

static Result<ImageF> readHdr(const std::string& path, const Bytes& bytes) {
    if (tooLarge(bytes))
        return fail(fmt::format("{}: too large", path));
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<float, decltype(&stbi_image_free)> pixels(
        stbi_loadf_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels, 3),
        stbi_image_free);
    if (!pixels)
        return fail(fmt::format("{}: malformed HDR", path));
    ImageF out;
    out.width = std::uint32_t(width);
    out.height = std::uint32_t(height);
    out.rgb.resize(std::size_t(width) * std::size_t(height));
    for (std::size_t i = 0; i < out.rgb.size(); ++i)
        out.rgb[i] = {pixels.get()[3 * i], pixels.get()[3 * i + 1], pixels.get()[3 * i + 2]};
    return out;
}

Result<ImageF> readFloatImage(const std::string& path) {
    const Result<Bytes> bytes = readBytes(path);
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    if (bytes->size() >= 4 && std::memcmp(bytes->data(), "\x76\x2f\x31\x01", 4) == 0)
        return readExr(path, *bytes);
    if (stbi_is_hdr_from_memory(bytes->data(), int(bytes->size())))
        return readHdr(path, *bytes);
    return fail(fmt::format("{}: neither EXR nor HDR", path));
}

Result<void> writePng(const std::string& path, const Image& image) {
    if (image.width == 0 || image.height == 0)
        return fail(fmt::format("{}: the image is empty", path));
    Bytes png;
    const auto append = [](void* context, void* data, int size) {
        const auto* begin = static_cast<const unsigned char*>(data);
        static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), begin,
                                             begin + size);
    };
    if (!stbi_write_png_to_func(append, &png, int(image.width), int(image.height), 4,
                                image.rgba.data(), int(image.width) * 4))
        return fail(fmt::format("{}: cannot encode PNG", path));
    return writeBytes(path, png.data(), png.size());
}

Result<Image> readPng(const std::string& path) {
    const Result<Bytes> bytes = readBytes(path);
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    if (tooLarge(*bytes))
        return fail(fmt::format("{}: too large", path));
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes->data(), int(bytes->size()), &width, &height, &channels, 4),
        stbi_image_free);
    if (!pixels)
        return fail(fmt::format("{}: malformed PNG", path));
    Image image;
    image.name = std::filesystem::path(path).filename().string();
    image.width = std::uint32_t(width);
    image.height = std::uint32_t(height);
    image.rgba.assign(pixels.get(), pixels.get() + std::size_t(width) * std::size_t(height) * 4);
    return image;
}

} // namespace limn
