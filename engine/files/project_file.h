// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_import.h"

#include <string>

namespace limn {

/// Document <-> JSON, schema version 1. Missing fields take defaults; unknown fields and wrong
/// types are errors that name the path of the field ("objects[3].light.color[1]: not a number").
/// Positions are in the coordinates of the scene file, as doubles; "origin", left out where it is
/// 0, says about which place the document counted them, so that each comes back as the same float
/// wherever doubles are fine enough.
std::string documentToJson(const Document& document);
Result<Document> documentFromJson(const std::string& json);

/// Writes a temporary file beside `path`, syncs, renames. The scene path is stored relative to the
/// project.
Result<void> saveProject(const std::string& path, const Document& document);

/// Reads the project and its glTF. Objects of the project replace those of the import. A scene
/// whose content changed since the save is imported and reported in `repairs`. `options` are for
/// the glTF and the sky's panorama.
Result<ImportedScene> loadProject(const std::string& path, const Progress& progress = {},
                                  const ImportOptions& options = {});

/// A .gltf/.glb, a .limn, or the name of a sample project ("cornell"), looked for in
/// `projectsFolder`.
Result<ImportedScene> openAny(const std::string& what, const std::string& projectsFolder,
                              const Progress& progress = {}, const ImportOptions& options = {});

} // namespace limn
