// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_settings.h"
#include "engine/scene/camera.h"
#include "engine/scene/export_settings.h"
#include "engine/scene/light/light.h"
#include "engine/scene/relight_settings.h"
#include "engine/scene/sky.h"
#include "engine/scene/surface/material.h"
#include "engine/scene/technique_choice.h"

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace limn {

using ObjectId = std::uint32_t; ///< Never reused within a document; 0: none.

struct Transform {
    glm::dvec3 translation{0};      ///< [m], within float; double for places far from the origin
    glm::quat rotation{1, 0, 0, 0}; ///< w, x, y, z; unit
    glm::vec3 scale{1};             ///< may be negative, not 0

    bool operator==(const Transform&) const = default;
};

glm::mat4 matrix(const Transform& t);

/// Same as matrix() in double precision, with the full precision of the translation.
glm::dmat4 preciseMatrix(const Transform& t);

/// A node of the tree; an instance carries meshes.
inline constexpr float kMinTexelDensity = 1 / 16.f, kMaxTexelDensity = 16; ///< of a node

struct Node {
    std::string name;
    ObjectId parent = 0;               ///< 0: a root. The tree has no cycles.
    Transform transform;               ///< to the parent's space
    std::vector<std::uint32_t> meshes; ///< indices into Assets::meshes
    /// Material objects, one per mesh. A 0, or a missing one at the end: the mesh's own.
    std::vector<ObjectId> materials;
    bool visible = true;
    bool dynamic = false; ///< lit from the grid, sends no bounced light
    /// Multiplies the lightmap's texels per metre, as do the densities of its groups.
    float texelDensity = 1; ///< [kMinTexelDensity, kMaxTexelDensity]

    bool operator==(const Node&) const = default;
};

/// A file, or a shape that the program makes, whose meshes and images follow in Assets those of the
/// scene and of the files before it.
struct AssetFile {
    std::string path; ///< a .gltf, .glb, .png or .jpg; or a shape's name (shape_mesh.h)
    std::uint32_t firstMesh = 0, firstImage = 0; ///< indices into Assets

    bool operator==(const AssetFile&) const = default;
};

/// Any object of a document. Mesh::material counts the Material objects in the order of their ids.
/// (Material itself is declared in material.h.)

using Object = std::variant<Node, Material, Light, Camera, Sky, BakeSettings, TechniqueChoice,
                            RelightSettings, ExportSettings>;

/// Everything a user can edit, as a plain value; heavy, immutable data is in Assets. Node
/// transforms are in the file's coordinates. Lights and cameras are in world space, whose origin is
/// `origin`.
struct Document {
    std::string scenePath; ///< glTF file, as opened; the project file stores it relative to itself
    std::uint64_t sceneHash = 0; ///< of the glTF's content (main file and buffers)
    glm::dvec3 origin{0};        ///< of world space, in the file's coordinates [m]; see origin.h
    std::map<ObjectId, Object> objects;
    ObjectId nextId = 1;
    /// What was added to the scene's assets. Edits refer to it; undoing them leaves it here,
    /// because it may be redone. Project files keep what objects refer to.
    std::vector<AssetFile> files;

    bool operator==(const Document&) const = default;
};

/// Adds `object` under a new id and returns the id.
ObjectId addObject(Document& document, Object object);

/// The single object of type T (Sky, BakeSettings, TechniqueChoice, RelightSettings,
/// ExportSettings), or a default T if the document has none.
template <class T>
T singleton(const Document& document) {
    for (const auto& [id, object] : document.objects)
        if (const T* t = std::get_if<T>(&object))
            return *t;
    return {};
}

/// Display name of an object; "Sky", "Bake settings", "Technique", "Relighting" and "Export" for
/// objects without a name.
std::string objectName(const Object& object);

} // namespace limn
