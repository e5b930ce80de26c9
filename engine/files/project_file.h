// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gltf/gltf_import.h"

#include <string>

namespace limn {

/// Converts a document to and from JSON, schema version 1. Missing fields take defaults; unknown
/// fields and wrong types are errors that name the path of the field ("objects[3].light.color[1]:
/// not a number"). Positions are doubles in the coordinates of the scene file. "origin", omitted if
/// it is 0, is the origin of the document's world space, so that each position is read back as the
/// same float wherever doubles are precise enough.
std::string documentToJson(const Document& document);
Result<Document> documentFromJson(const std::string& json);

/// Saves a project atomically: writes a temporary file beside `path`, syncs and renames it. The
/// scene path is stored relative to the project.
Result<void> saveProject(const std::string& path, const Document& document);

/// Reads the project and its glTF. Objects of the project replace those of the import. A scene
/// whose content changed since the save is still imported and reported in `repairs`. `options`
/// apply to the glTF and the sky's panorama.
Result<ImportedScene> loadProject(const std::string& path, const Progress& progress = {},
                                  const ImportOptions& options = {});

/// Opens a .gltf/.glb, a .limn, or a sample project by name ("cornell"), which is looked up in
/// `projectsFolder`.
Result<ImportedScene> openAny(const std::string& what, const std::string& projectsFolder,
                              const Progress& progress = {}, const ImportOptions& options = {});

} // namespace limn
