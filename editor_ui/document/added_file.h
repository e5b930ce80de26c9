// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/request.h"
#include "engine/files/asset_file.h"

#include <vector>

namespace limn {

struct EditorState;

/// The file of the document that `path` names, if its assets are there already; else null.
const AssetFile* findAssetFile(const Document& document, const std::string& path);

/// Replaces the editor's assets by `added`, which holds them too, and records its file in the
/// document. The objects of the document stay as they are.
void takeAssets(EditorState& state, AddedAssets& added, std::vector<Bounds> meshBounds);

/// Each of these functions is one undo step, and selects what it adds.

/// Adds a node with the mesh of a shape that is in the assets, and a grey material of its own.
/// `place`: to world space.
void addShape(EditorState& state, const AssetFile& shape, const Transform& place);

/// Adds the nodes, materials and lights of a glTF that is in the assets, below one group named
/// after the file, at the places that the file gives them.
void addScene(EditorState& state, const AssetFile& file, const ImportedScene& imported);

} // namespace limn
