// SPDX-License-Identifier: MIT
#include "engine/files/asset_file.h"

#include "engine/files/image_file.h"
#include "engine/scene/mesh/shape_mesh.h"
#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

namespace limn {

/// Past the end of every list of meshes and images.
static constexpr std::uint32_t kLost = std::uint32_t(std::numeric_limits<std::int32_t>::max());

bool isSceneFile(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return extension == ".gltf" || extension == ".glb";
}

namespace {

/// Meshes and images of one file, not yet among those of a document.
struct Part {
    std::vector<Mesh> meshes;
    std::vector<Image> images;
    ImportedScene imported; ///< without its assets
};

} // namespace

static Result<Part> readPart(const std::string& path, const Progress& progress,
                             const ImportOptions& options) {
    Part part;
    if (const std::optional<Shape> shape = shapeOfPath(path)) {
        part.meshes.push_back(shapeMesh(*shape));
        return part;
    }
    if (!isSceneFile(path)) {
        Result<Image> image = readPng(path);
        if (!image)
            return tl::make_unexpected(image.error());
        part.images.push_back(std::move(*image));
        return part;
    }
    Result<ImportedScene> imported = importGltf(path, progress, options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    part.meshes = imported->assets->meshes;
    part.images = imported->assets->images;
    part.imported = std::move(*imported);
    part.imported.assets = nullptr;
    return part;
}

static void append(Part&& part, Assets& to) {
    std::ranges::move(part.meshes, std::back_inserter(to.meshes));
    std::ranges::move(part.images, std::back_inserter(to.images));
}

Result<AddedAssets> addAssetFile(const Assets& before, const std::string& path,
                                 const Progress& progress, const ImportOptions& options) {
    Result<Part> part = readPart(path, progress, options);
    if (!part)
        return tl::make_unexpected(part.error());
    AddedAssets added;
    added.file = {path, std::uint32_t(before.meshes.size()), std::uint32_t(before.images.size())};
    added.imported = std::move(part->imported);
    auto assets = std::make_shared<Assets>(before);
    append(std::move(*part), *assets);
    added.assets = std::move(assets);
    return added;
}

/// Calls use(first, index) for every reference of an object to a mesh or an image, with the member
/// of AssetFile that says where a file's begin.
template <class Use>
static void visitReferences(Object& object, const Use& use) {
    if (Node* node = std::get_if<Node>(&object))
        for (std::uint32_t& mesh : node->meshes)
            use(&AssetFile::firstMesh, mesh);
    if (Material* material = std::get_if<Material>(&object))
        for (TextureRef* texture : texturesOf(*material))
            if (texture->image >= 0) {
                auto image = std::uint32_t(texture->image);
                use(&AssetFile::firstImage, image);
                texture->image = std::int32_t(image);
            }
}

std::vector<AssetFile> filesInUse(const Document& document) {
    std::vector<bool> used(document.files.size());
    for (const auto& [id, object] : document.objects) {
        Object copy = object;
        visitReferences(copy, [&](auto first, const std::uint32_t& index) {
            for (std::size_t f = 0; f < document.files.size(); ++f) {
                // Files without meshes begin where the next one does.
                const AssetFile& file = document.files[f];
                const bool last = f + 1 == document.files.size();
                if (index >= file.*first && (last || index < document.files[f + 1].*first))
                    used[f] = true;
            }
        });
    }
    std::vector<AssetFile> files;
    for (std::size_t f = 0; f < used.size(); ++f)
        if (used[f])
            files.push_back(document.files[f]);
    return files;
}

namespace {

/// Where the meshes or images of a file were when the document was saved, and where they are.
struct Moved {
    std::uint32_t before = 0, now = 0, count = 0;
};

} // namespace

/// The place of `index` now; kLost if its file no longer has it.
static std::uint32_t placeNow(std::span<const Moved> parts, std::uint32_t index) {
    const Moved* found = &parts[0]; // the scene
    for (const Moved& part : parts.subspan(1))
        if (part.count > 0 && index >= part.before)
            found = &part;
    const std::uint32_t in = index - found->before;
    return in < found->count ? found->now + in : kLost;
}

Result<void> addAssetFiles(ImportedScene& scene, Document& document, const Progress& progress,
                           const ImportOptions& options) {
    if (document.files.empty())
        return {};
    auto assets = std::make_shared<Assets>(*scene.assets);
    std::vector<Moved> meshes{{0, 0, std::uint32_t(assets->meshes.size())}};
    std::vector<Moved> images{{0, 0, std::uint32_t(assets->images.size())}};
    for (AssetFile& file : document.files) {
        Result<Part> part = readPart(file.path, progress, options);
        if (!part && (shapeOfPath(file.path) || isSceneFile(file.path)))
            return tl::make_unexpected(part.error());
        if (!part) {
            scene.repairs.push_back(part.error().message + "; it is shown white");
            part = Part{{}, {Image{file.path, 1, 1, {255, 255, 255, 255}}}, {}};
        }
        const AssetFile now{file.path, std::uint32_t(assets->meshes.size()),
                            std::uint32_t(assets->images.size())};
        meshes.push_back({file.firstMesh, now.firstMesh, std::uint32_t(part->meshes.size())});
        images.push_back({file.firstImage, now.firstImage, std::uint32_t(part->images.size())});
        file = now;
        append(std::move(*part), *assets);
    }
    for (auto& [id, object] : document.objects)
        visitReferences(object, [&](auto first, std::uint32_t& index) {
            index = placeNow(first == &AssetFile::firstMesh ? meshes : images, index);
        });
    scene.assets = std::move(assets);
    return {};
}

} // namespace limn
