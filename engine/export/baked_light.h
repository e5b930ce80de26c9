// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <string>

namespace limn {

/// The light of an exported scene, from the lightmap that its glTF file names.
struct BakedLight {
    /// Each vertex of a mesh lies at its TEXCOORD_1, without snaps. Textures lie below each other.
    LightmapLayout layout;
    /// A field whose irradiance is what a program reads from the lightmap: for harmonics that of
    /// the surface's normal, else the same for every normal.
    IndirectField field;
    bool hasDirectLight = false; ///< the lightmap holds the light of lamps and sun, too
};

/// Reads the light beside or named by the glTF file `path`, .gltf or .glb, that was imported as
/// `scene`, and joins the two sides of surfaces that were exported as two. Files are those of the
/// file's own folder. Fails, with the file and what is wrong, where the file names no lightmap of
/// Limn's, textures that differ in size, or a lightmap of radiance, from which irradiance does not
/// follow.
Result<BakedLight> readBakedLight(const std::string& path, Scene& scene,
                                  const MemoryBudget& memory);

} // namespace limn
