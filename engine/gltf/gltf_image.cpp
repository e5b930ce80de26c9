// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_image.h"

#include "engine/core/parallel.h"
#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_value.h"
#include "engine/scene/decode_image.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace limn {

static std::string imageName(const tinygltf::Image& image, std::size_t index) {
    if (!image.name.empty())
        return image.name;
    return image.uri.empty() ? fmt::format("images[{}]", index) : image.uri;
}

Result<std::span<const std::uint8_t>> encodedImage(const GltfFile& file, std::size_t index) {
    const tinygltf::Image& source = file.model.images[index];
    if (source.bufferView >= 0)
        return viewBytes(file.model, source.bufferView);
    return std::span<const std::uint8_t>(file.encodedImages[index]);
}

static Result<Image> decodeOne(GltfFile& file, std::size_t index) {
    if (!file.imageProblems[index].empty())
        return fail(file.imageProblems[index]);
    const Result<std::span<const std::uint8_t>> bytes = encodedImage(file, index);
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    Result<Image> image = decodeImage(*bytes);
    std::vector<std::uint8_t>().swap(file.encodedImages[index]);
    return image;
}

/// Whether the file requires KHR_texture_basisu for the image.
static bool isRequired(const tinygltf::Model& model, std::size_t image) {
    constexpr const char* kBasis = "KHR_texture_basisu";
    if (std::ranges::find(model.extensionsRequired, kBasis) == model.extensionsRequired.end())
        return false;
    return std::ranges::any_of(model.textures, [&](const tinygltf::Texture& texture) {
        const auto basis = texture.extensions.find(kBasis);
        return basis != texture.extensions.end() &&
               wholeNumber(member(basis->second, "source")) == image;
    });
}

Result<DecodedImages> decodeImages(GltfFile& file, const Progress& progress, GltfRepairs& repairs) {
    DecodedImages decoded;
    std::vector<Image>& images = decoded.images;
    images.resize(file.model.images.size());
    std::vector<std::string> problems(images.size());
    parallelRanges(images.size(), 1, progress, "images", [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (Result<Image> image = decodeOne(file, i))
                images[i] = std::move(*image);
            else
                problems[i] = image.error().message;
            images[i].name = imageName(file.model.images[i], i);
        }
    });
    for (std::size_t i = 0; i < images.size(); ++i)
        if (!problems[i].empty()) {
            if (isRequired(file.model, i))
                return fail(fmt::format("images[{}] '{}' {}", i, images[i].name, problems[i]));
            images[i].width = images[i].height = 1;
            images[i].rgba.assign(4, 255);
            decoded.missing.push_back(std::uint32_t(i));
            repairs.sentences.push_back(
                fmt::format("image {} '{}' {}; it is white", i, images[i].name, problems[i]));
        }
    return decoded;
}

} // namespace limn
