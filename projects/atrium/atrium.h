// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gallery/mesh_builder.h"
#include "projects/gltf_writer.h"

#include <string>

namespace limn::atrium {

/// A court of 6 x 2 bays, open to the sky; round it two storeys of arcades, a gallery deep, inside
/// closed walls. Everything is a solid with thickness; where two solids meet, one reaches a little
/// into the other, so that no two faces lie in one plane. Along a side, local x follows the arcade,
/// z points from the court to the gallery, and the origin is on the line of the columns.

constexpr double kBay = 2.8;                ///< between column axes [m]
constexpr glm::dvec2 kColumns = {8.4, 2.8}; ///< half-size (x, z) of the rectangle of column axes
constexpr glm::dvec2 kWall = {12.1, 6.5};   ///< half-size to the walls' inner face
constexpr double kWallThickness = 0.4;
constexpr double kGallery = 3.7;      ///< from the column axes to the wall
constexpr double kGroundFloor = 0.15; ///< of the arcade; the court is at 0
constexpr double kSpringing = 3.0;    ///< of the ground floor's arches and vaults
constexpr double kSlabLower = 4.8, kUpperFloor = 5.1;
constexpr double kUpperSpringing = 8.1;
constexpr double kRoofLower = 9.3, kRoofUpper = 9.6;
constexpr double kWallTop = 10.6;

enum Material : std::uint32_t {
    Stone,
    Limestone,
    Plaster,
    Paving,
    Terracotta,
    Wood,
    Crimson,
    Saffron,
    Ultramarine,
    Emerald,
    Fringe,
    Water,
    Leaf,
    Bronze
};

/// One side of the court. Turns are quarters about +y.
struct Side {
    const char* name;
    int turns;
    int bays;
    double distance; ///< from the centre to its column axes
};
constexpr Side kSides[4] = {{"south", 0, 6, kColumns.y},
                            {"east", 1, 2, kColumns.x},
                            {"north", 2, 6, kColumns.y},
                            {"west", 3, 2, kColumns.x}};

/// Adds `mesh` once; the result places it.
int addMesh(GltfFile& file, Mesh mesh);

/// A node without a mesh, for the outliner.
int addGroup(GltfFile& file, const std::string& name);

/// Places `mesh` on `side`: x along it from its middle, y up, z outward from the column axes.
void placeOnSide(GltfFile& file, int group, int mesh, const Side& side, glm::dvec3 local,
                 bool mirrored = false);
void place(GltfFile& file, int group, int mesh, glm::dvec3 position, int turns = 0);

/// A curve from a to b that bulges sideways by `bulge` (positive: to the right of the way from a to
/// b, which is outward for a profile that goes up).
std::vector<glm::dvec2> curve(glm::dvec2 a, glm::dvec2 b, double bulge, int segments);

void addShell(GltfFile& file); ///< walls, floors, slabs, parapets
void addGroundStorey(GltfFile& file);
void addUpperStorey(GltfFile& file);
void addFurnishing(GltfFile& file); ///< curtains, banners, fountain, plants, doors

/// Writes paving.png, stone.png and fringe.png. False when a file cannot be written.
bool writeTextures(const std::string& folder);

} // namespace limn::atrium
