// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/light_skin/mesh_skin.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// The light caches of all objects of a scene, in the world.
struct LightCaches {
    /// An instance with the caches of its mesh.
    struct Placed {
        std::shared_ptr<const MeshSkin> skin;
        std::uint32_t first = 0; ///< number of its first cache
        glm::mat4 toObject{1};
        glm::mat3 normalToObject{1}; ///< not normalised
    };
    std::vector<Placed> instances; ///< by number of the instance
    float spacing = 1;             ///< largest distance of a surface point from a cache [m]
    float diagonal = 1;            ///< of the scene, which `spacing` is a share of [m]

    std::vector<glm::vec3> position; ///< [m]
    std::vector<glm::vec3> normal;   ///< unit
    std::vector<float> area;         ///< of the surfaces that the cache stands for [m^2]
    std::vector<std::uint32_t> instance;

    std::size_t size() const { return position.size(); }
    std::uint64_t bytes() const; ///< with those of the meshes

    /// Number of caches in the list of a surface point, which are written to `list`; 0: it has
    /// none. `triangle`, `u` and `v` choose the vertex whose list is read, where these have lists.
    struct Query {
        std::uint32_t instance = 0, triangle = 0;
        float u = 0, v = 0;
        glm::vec3 position{0};
        glm::vec3 normal{0};
        const Mesh* mesh = nullptr;
    };
    std::size_t find(const Query& query,
                     std::span<std::uint32_t, NearestCaches::kLength> list) const;
};

/// How caches are spread over a scene.
struct SkinLayout {
    float spacing = 0.02f; ///< as a share of the diagonal of the static objects
    float angle = 0.5f;    ///< between normals of surfaces that share a cache [rad]
    bool vertexLists = false;
    bool operator==(const SkinLayout&) const = default;
};

/// Most cubes that the caches of a scene are made from, and most pieces of triangles in them
/// besides one of each triangle. Spacing grows where there would be more.
inline constexpr double kMaxCubes = 1 << 18, kMaxPieces = 1 << 21;

/// Caches of meshes, kept by mesh, spacing and sides, in object space. They do not change where
/// objects move. Not thread-safe.
class MeshSkins {
public:
    /// The caches of all objects of a scene, with those of meshes made where they are missing.
    /// Forgets those that it does not need. The diagonal is that of the box of all static objects,
    /// or of the largest dynamic one where this is larger, so that no movement changes it.
    LightCaches place(const Scene& scene, const SkinLayout& layout);

    /// Number of meshes whose caches place() made last.
    std::uint32_t made() const { return m_made; }

private:
    /// Mesh, distance, angle, two-sided, lists of vertices.
    using Key = std::tuple<std::uint32_t, float, float, bool, bool>;
    using Skins = std::map<Key, std::shared_ptr<const MeshSkin>>;

    /// Sizes of a mesh in object space.
    struct Extent {
        double area = 0, perimeter = 0; ///< of all its triangles [m^2], [m]
        float diagonal = 0;             ///< of its box
    };
    const Extent& extentOf(const Scene& scene, std::uint32_t mesh);
    float diagonalOf(const Scene& scene);
    float spacingOf(const Scene& scene, float minimum);

    /// None for an instance without extent.
    static std::optional<Key> keyOf(const Scene& scene, const Instance& instance,
                                    const SkinLayout& layout, float spacing);
    void makeMissing(const Scene& scene, const SkinLayout& layout, float spacing);

    std::shared_ptr<const Assets> m_assets;
    std::map<std::uint32_t, Extent> m_extents; ///< by mesh
    Skins m_skins;
    std::uint32_t m_made = 0;
};

/// The exponent of a cosine lobe about the mirrored direction that is as narrow as the reflection
/// by facets of that roughness [0, 1]: (2 / alpha^2 - 2) / 4, alpha = roughness^2, from 1 to 500.
float glossExponent(float roughness);

/// glossExponent() at each cache of the scene.
std::vector<float> glossExponents(const Scene& scene, const LightCaches& caches);

} // namespace limn
