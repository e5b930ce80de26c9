// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"
#include "engine/techniques/light_skin/surface_cubes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A light cache on a mesh, in object space.
struct MeshCache {
    glm::vec3 position{0}; ///< on one of its surfaces
    glm::vec3 normal{0};   ///< unit
    float area = 0;        ///< of the surfaces that are nearer to it than to others with its normal
    std::uint32_t triangle = 0; ///< on which it lies
    float u = 0, v = 0;         ///< barycentrics there
};

/// The caches nearest to a part of a surface. Those whose normals face the surface's side come
/// first, each kind by distance. A mesh with fewer caches fills the rest with kNone.
struct NearestCaches {
    static constexpr std::size_t kLength = 16;
    static constexpr std::uint32_t kNone = ~0U;
    std::array<std::uint32_t, kLength> cache{};
};

/// The lists of a cube: one for each bin of normals that its surfaces have.
struct CubeLists {
    glm::ivec3 cube{0};
    std::uint32_t first = 0, count = 0; ///< in MeshSkin::cubeBins and MeshSkin::lists
};

/// How caches are spread over a mesh.
struct SkinSpacing {
    float distance = 1; ///< largest distance of a surface point from a cache, in object space
    float angle = 1;    ///< between normals of surfaces that share a cache [rad]
    bool operator==(const SkinSpacing&) const = default;
};

/// The light caches of a mesh and the lists by which surface points find them.
struct MeshSkin {
    CubeRaster raster;
    std::vector<MeshCache> caches;
    std::vector<CubeLists> cubes;           ///< by cubeKey()
    std::vector<glm::vec3> cubeBins;        ///< mean normal of each bin of each cube, unit
    std::vector<NearestCaches> lists;       ///< in the order of cubeBins
    std::vector<NearestCaches> vertexLists; ///< by vertex, where asked for

    /// The list for a surface point of that place and unit normal: that of its cube, or where this
    /// has none, of the nearest. Null where the mesh has no caches.
    const NearestCaches* find(glm::vec3 position, glm::vec3 normal) const;

    std::uint64_t bytes() const;
};

/// Makes the caches of a mesh.
/// 1. Cubes of half the distance cut its triangles into pieces, whose normals are sorted into bins.
/// 2. The bin with most area gives a cache: the mean of all pieces of the cube within the angle of
///    the middle of the bin. They are taken away, until none is left.
/// 3. Caches of neighbouring cubes are joined while their normals differ by no more than the angle,
///    and all of their surfaces lie within the distance.
/// 4. Caches move to the nearest point of their own surfaces.
/// With `twoSided` the backs of triangles have caches, too.
/// Lensing, Broll. LightSkin: Real-Time Global Illumination for Virtual and Mixed Reality. 2013, as
/// summed up by Bischoff, Schwandt, Broll. 2017, section 3.1. Lists of cubes are ours: in the paper
/// the vertices have them, and corners of large triangles know nothing of their middles.
MeshSkin skinOf(const Mesh& mesh, const SkinSpacing& spacing, bool twoSided, bool vertexLists);

} // namespace limn
