// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/export/gltf_buffer.h"
#include "engine/final_lightmap/cut_scene.h"
#include "engine/json/json.h"
#include "engine/lightmap/lightmap_pages.h"

#include <string>
#include <vector>

namespace limn {

/// How a scene is written as glTF.
struct GltfOptions {
    /// Where TEXCOORD_1 leads, and which texture each material reads. Null: there is no lightmap,
    /// and two-sided surfaces stay as they are.
    const LightmapPages* pages = nullptr;
    const CutScene* cut = nullptr; ///< whose meshes the pages belong to; null: the exported scene
    Json extras;                   ///< asset.extras.limn: what the light beside the file means
    GltfPacking packing = {};
    /// extras.limn.reflection of each instance's node, unless it is 0. Empty: there is none.
    std::vector<std::uint32_t> reflections = {};
    bool profiles = true; ///< whether EXT_lights_ies is written
};

/// The scene as glTF 2.0: `name`, a buffer, and its textures as PNG files, or all of it in `name`
/// where that ends in ".glb". Each instance is a node with a mesh of its own, because texture
/// coordinates of a lightmap belong to instances; attributes that instances share are stored once.
/// Vertices are split along the lightmap's charts. Two-sided surfaces with a lightmap become two
/// one-sided ones. An instance whose charts lie on several pages of the lightmap becomes a node for
/// each; materials exist once for each page, and extras.limn.lightmapPage says which, unless it is
/// the first. Lights, cameras and emission are written by KHR_lights_punctual, EXT_lights_area,
/// EXT_lights_ies, glTF cameras and KHR_materials_emissive_strength. Fails for a scene without
/// surfaces, and when cancelled.
Result<std::vector<ExportFile>> gltfFiles(const ExportScene& scene, const GltfOptions& options,
                                          const std::string& name, const Progress& progress);

/// Bytes of the geometry and textures of that glTF, about: PNG compresses the latter.
std::uint64_t gltfBytes(const ExportScene& scene, GltfPacking packing = {});

/// "room" of "room.gltf".
std::string stemOf(const std::string& fileName);

} // namespace limn
