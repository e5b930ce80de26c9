// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_import.h"

#include <memory>
#include <string>
#include <vector>

namespace limn {

/// Assets with those of one more file at their end.
struct AddedAssets {
    std::shared_ptr<const Assets> assets;
    AssetFile file; ///< where they begin
    /// Nodes, materials and lights of a glTF, whose meshes and textures count from the beginning of
    /// the file's own; empty for a shape and for an image.
    ImportedScene imported;
};

/// Appends what AssetFile::path names: the meshes and images of a .gltf or .glb, a shape's mesh, or
/// the image in any other file, which must be a PNG or a JPEG. Fails, naming the file, as
/// importGltf() and readPng() do.
Result<AddedAssets> addAssetFile(const Assets& before, const std::string& path,
                                 const Progress& progress = {}, const ImportOptions& options = {});

/// Whether the path names a .gltf or .glb.
bool isSceneFile(const std::string& path);

/// The files of `document` whose meshes or images an object refers to.
std::vector<AssetFile> filesInUse(const Document& document);

/// Appends the assets of all of document.files to those of its scene, which `scene.assets` holds,
/// and makes the references of the document's objects point to where they are now: a file may have
/// another number of meshes than when the document was saved. What a file no longer has is left
/// pointing past the end. An image that cannot be read becomes a white texel and a repair; all else
/// that cannot be read fails, naming the file.
Result<void> addAssetFiles(ImportedScene& scene, Document& document, const Progress& progress = {},
                           const ImportOptions& options = {});

} // namespace limn
