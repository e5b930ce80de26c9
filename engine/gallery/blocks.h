// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Contents of a box of a building. Values from kFirstRoom on are the air of the room with that
/// number.
inline constexpr int kSolid = -1, kOutside = 0, kFirstRoom = 1;

/// Direction that a face of a building faces.
enum class Facing { Up, Down, Sideways };

/// A building made of axis-aligned boxes [m]. Faces lie between solid and non-solid boxes and face
/// away from the solid. Two different non-solid spaces are separated by a wall without thickness,
/// which faces into the room, or into the room with the lower number. All faces share one irregular
/// grid, so there are neither gaps nor T-junctions.
class Blocks {
public:
    /// Fills a box, replacing its previous contents.
    void fill(glm::dvec3 lower, glm::dvec3 upper, int what);

    /// Removes walls without thickness inside the box.
    void open(glm::dvec3 lower, glm::dvec3 upper);

    /// Adds the faces as quads with edges of at most `spacing` [m] to the mesh that `meshOf`
    /// returns for them. Edges are longer if there would otherwise be more than kMaxBlockFaces
    /// quads.
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
