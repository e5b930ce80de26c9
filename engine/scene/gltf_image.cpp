// SPDX-License-Identifier: MIT
#include "engine/scene/gltf_image.h"

#include "engine/core/parallel.h"
#include "engine/scene/gltf_accessor.h"

#include <limits>
#include <memory>
#include <span>

#include <fmt/format.h>
#include <stb/stb_image.h>

namespace limn {

/// 16k x 16k texels, 1 GiB as RGBA: larger ones are refused before anything is allocated.
static constexpr std::uint64_t kMaxTexels = std::uint64_t(1) << 28;

static std::string imageName(const tinygltf::Image& image, std::size_t index) {
    if (!image.name.empty())
        return image.name;
    return image.uri.empty() ? fmt::format("images[{}]", index) : image.uri;
}

/// Fills width, height and texels; returns the reason where it cannot.
static std::string decode(std::span<const std::uint8_t> bytes, Image& image) {
    if (bytes.empty())
        return "is missing";
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max()))
        return "is too large";
    const int size = int(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels))
        return "has a format that is not supported";
    if (width <= 0 || height <= 0 || std::uint64_t(width) * std::uint64_t(height) > kMaxTexels)
        return "is too large";
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
    if (!pixels)
        return "is damaged";
    image.width = std::uint32_t(width);
    image.height = std::uint32_t(height);
    image.rgba.assign(pixels.get(), pixels.get() + std::size_t(width) * std::size_t(height) * 4);
    return {};
}

static std::string decodeOne(GltfFile& file, std::size_t index, Image& image) {
    const tinygltf::Image& source = file.model.images[index];
    if (source.bufferView >= 0) {
        const Result<std::span<const std::uint8_t>> bytes =
            viewBytes(file.model, source.bufferView);
        return bytes ? decode(*bytes, image) : bytes.error().message;
    }
    const std::string problem = decode(file.encodedImages[index], image);
    std::vector<std::uint8_t>().swap(file.encodedImages[index]);
    return problem;
}

std::vector<Image> decodeImages(GltfFile& file, const Progress& progress, GltfRepairs& repairs) {
    std::vector<Image> images(file.model.images.size());
    std::vector<std::string> problems(images.size());
    parallelRanges(images.size(), 1, progress, "images", [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            images[i].name = imageName(file.model.images[i], i);
            problems[i] = decodeOne(file, i, images[i]);
        }
    });
    for (std::size_t i = 0; i < images.size(); ++i)
        if (!problems[i].empty()) {
            images[i].width = images[i].height = 1;
            images[i].rgba.assign(4, 255);
            repairs.sentences.push_back(
                fmt::format("image {} '{}' {}; it is white", i, images[i].name, problems[i]));
        }
    return images;
}

} // namespace limn
