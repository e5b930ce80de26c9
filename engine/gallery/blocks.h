// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What fills a box of a building. From kFirstRoom on: the air of rooms of that number.
inline constexpr int kSolid = -1, kOutside = 0, kFirstRoom = 1;

/// Which way a face of a building looks.
enum class Facing { Up, Down, Sideways };

/// A building of boxes along the axes [m]. Its faces lie between what is solid and what is not, and
/// look away from the solid. Between two spaces that are not solid stands a wall without thickness
/// that looks into the room, or into the one of the lower number. All faces share one irregular
/// grid, so there are neither gaps nor T-junctions.
class Blocks {
public:
    /// Fills a box; what was in it before is replaced.
    void fill(glm::dvec3 lower, glm::dvec3 upper, int what);

    /// Leaves out the walls without thickness in that box.
    void open(glm::dvec3 lower, glm::dvec3 upper);

    /// Adds the faces as quads with edges of `spacing` [m] or less to the mesh that `meshOf` names
    /// for them. Edges are longer where there would be more than kMaxBlockFaces quads otherwise.
    void build(double spacing, const std::function<Mesh&(Facing)>& meshOf) const;

private:
    struct Box {
        glm::dvec3 lower, upper;
        int what;
    };
    struct Grid;
    struct Face;
    static bool isIn(const Box& box, glm::dvec3 p);
    int whatIsAt(glm::dvec3 p) const;
    std::vector<Face> faces(const Grid& grid) const;

    std::vector<Box> m_fills, m_openings;
};

inline constexpr std::size_t kMaxBlockFaces = 12000;

} // namespace limn
