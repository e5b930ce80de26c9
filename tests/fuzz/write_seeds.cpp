// SPDX-License-Identifier: MIT
// write_seeds FOLDER: writes the valid examples from which fuzzing starts, FOLDER/TARGET/NAME.
#include "engine/files/image_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/small_png.h"

#include <filesystem>
#include <string>
#include <vector>

#include <stb/stb_image_write.h>
#include <tinyexr.h>

using namespace limn;

namespace {

void append(void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data), std::size_t(size));
}

void putBig(std::string& out, std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out += char(word >> shift);
}

void pngChunk(std::string& out, const std::string& name, const std::string& content) {
    putBig(out, std::uint32_t(content.size()));
    out += name + content;
    putBig(out, 0); // a checksum that stb does not look at
}

/// Rows of zeros, not compressed, of any kind of texel.
std::string plainPng(std::uint32_t width, std::uint32_t height, int depth, int color,
                     bool interlaced, bool palette) {
    std::string out = "\x89PNG\r\n\x1a\n", header;
    putBig(header, width), putBig(header, height);
    for (const int byte : {depth, color, 0, 0, int(interlaced)})
        header += char(byte);
    pngChunk(out, "IHDR", header);
    if (palette) {
        pngChunk(out, "PLTE", std::string("\0\0\0\xff\x80\x40", 6));
        pngChunk(out, "tRNS", std::string("\xff\x10", 2));
    }
    const std::size_t bytes = interlaced ? 400 : height * (1 + width * 8);
    std::string data = {
        0x78, 0x01, 1, char(bytes), char(bytes >> 8), char(~bytes), char(~bytes >> 8)};
    data += std::string(bytes, '\0') + std::string(4, '\0');
    pngChunk(out, "IDAT", data);
    pngChunk(out, "IEND", "");
    return out;
}

void writeImages(const TemporaryFolder&, const auto& write) {
    const std::vector<std::uint8_t> grey = greyPng();
    write("grey.png", std::string(grey.begin(), grey.end()));
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 16 * 16 * 4; ++i)
        texels.push_back(std::uint8_t(i * 7));
    for (const int channels : {1, 2, 3, 4}) {
        std::string png;
        stbi_write_png_to_func(append, &png, 16, 8, channels, texels.data(), 16 * channels);
        write("channels" + std::to_string(channels) + ".png", png);
    }
    write("bits1.png", plainPng(5, 3, 1, 0, false, false));
    write("bits16.png", plainPng(3, 3, 16, 6, false, false));
    write("palette.png", plainPng(5, 3, 4, 3, false, true));
    write("interlaced.png", plainPng(9, 5, 8, 2, true, false));
    for (const int channels : {1, 3})
        for (const int quality : {20, 95}) { // the latter with full colour
            std::string jpeg;
            stbi_write_jpg_to_func(append, &jpeg, 16, 12, channels, texels.data(), quality);
            write("channels" + std::to_string(channels) + "_" + std::to_string(quality) + ".jpg",
                  jpeg);
        }
}

std::string exr(int compression, int type) {
    constexpr int kWidth = 5, kHeight = 40;
    std::vector<float> plane;
    for (int i = 0; i < kWidth * kHeight; ++i)
        plane.push_back(float(i % 7) * 0.25f);
    float* const planes[3] = {plane.data(), plane.data(), plane.data()};
    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = 3;
    image.images = reinterpret_cast<unsigned char**>(const_cast<float**>(planes));
    image.width = kWidth;
    image.height = kHeight;
    EXRChannelInfo channels[3] = {};
    for (int c = 0; c < 3; ++c)
        channels[c].name[0] = "BGR"[c];
    int given[3] = {TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT};
    int wanted[3] = {type, type, type};
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = 3;
    header.channels = channels;
    header.pixel_types = given;
    header.requested_pixel_types = wanted;
    header.compression_type = compression;
    unsigned char* memory = nullptr;
    const char* problem = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &memory, &problem);
    const std::string out(reinterpret_cast<const char*>(memory), size);
    std::free(memory);
    return out;
}

void writeFloatImages(const TemporaryFolder& folder, const auto& write) {
    const std::pair<int, const char*> kinds[] = {{TINYEXR_COMPRESSIONTYPE_NONE, "none"},
                                                 {TINYEXR_COMPRESSIONTYPE_RLE, "rle"},
                                                 {TINYEXR_COMPRESSIONTYPE_ZIPS, "zips"},
                                                 {TINYEXR_COMPRESSIONTYPE_ZIP, "zip"},
                                                 {TINYEXR_COMPRESSIONTYPE_PIZ, "piz"}};
    for (const auto& [compression, name] : kinds) {
        write(name + std::string("_half.exr"), exr(compression, TINYEXR_PIXELTYPE_HALF));
        write(name + std::string("_float.exr"), exr(compression, TINYEXR_PIXELTYPE_FLOAT));
    }
    (void)writeExr(folder.file("own.exr"), {2, 2, std::vector<glm::vec3>(4, {1, 2, 3})});
    write("own.exr", fileBytes(folder.file("own.exr")));
    for (const int width : {4, 12}) { // rows of fewer than 8 texels are not packed
        std::vector<float> texels(std::size_t(width) * 4 * 3, 1.5f);
        std::string hdr;
        stbi_write_hdr_to_func(append, &hdr, width, 4, 3, texels.data());
        write("width" + std::to_string(width) + ".hdr", hdr);
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2)
        return 2;
    const TemporaryFolder temporary;
    const auto into = [&](const std::string& target) {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / target;
        std::filesystem::create_directories(folder);
        return [folder](const std::string& name, const std::string& bytes) {
            writeFile((folder / name).string(), bytes);
        };
    };
    writeImages(temporary, into("image"));
    writeFloatImages(temporary, into("float_image"));
    return 0;
}
