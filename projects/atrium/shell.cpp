// SPDX-License-Identifier: MIT
#include "projects/atrium/atrium.h"

namespace limn::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr unsigned kInward = NegativeX | NegativeZ, kOutward = PositiveX | PositiveZ;
constexpr dvec2 kBuried = kWall + dvec2(0.1); ///< where floors end, inside the walls

void addPart(GltfFile& file, int group, Mesh mesh, double textureSize = 0) {
    if (textureSize > 0)
        projectUvs(mesh, textureSize);
    place(file, group, addMesh(file, std::move(mesh)), dvec3(0));
}

void addFloors(GltfFile& file, int group) {
    Mesh court{.name = "Court paving", .material = Paving};
    const dvec2 edge = kColumns - dvec2(0.45), under = edge + dvec2(0.1);
    addQuad(court, {-under.x, 0, under.y}, {under.x, 0, under.y}, {under.x, 0, -under.y},
            {-under.x, 0, -under.y});
    addPart(file, group, std::move(court), 2);

    Mesh gallery{.name = "Arcade paving", .material = Paving};
    addRing(gallery, edge, kBuried, kGroundFloor, kGroundFloor, PositiveY);
    addPart(file, group, std::move(gallery), 2);
    Mesh step{.name = "Step", .material = Limestone};
    addRing(step, edge, kBuried, 0, kGroundFloor, kInward);
    addPart(file, group, std::move(step));
}

void addSlabs(GltfFile& file, int group) {
    const dvec2 edge = kColumns - dvec2(0.34);
    Mesh tiles{.name = "Gallery tiles", .material = Terracotta};
    addRing(tiles, edge, kBuried, kUpperFloor, kUpperFloor, PositiveY);
    addPart(file, group, std::move(tiles));
    Mesh slab{.name = "Gallery slab", .material = Limestone};
    addRing(slab, edge, kBuried, kSlabLower, kUpperFloor, kInward | NegativeY);
    addRing(slab, kColumns - dvec2(0.3), kColumns - dvec2(0.1), kSlabLower - 0.14,
            kSlabLower + 0.02, kInward | NegativeY);
    addPart(file, group, std::move(slab));

    Mesh roof{.name = "Roof", .material = Limestone};
    addRing(roof, kColumns - dvec2(0.52), kBuried, kRoofLower, kRoofUpper,
            kInward | PositiveY | NegativeY);
    addRing(roof, kColumns - dvec2(0.38), kColumns - dvec2(0.1), kRoofLower - 0.16,
            kRoofLower + 0.02, kInward | NegativeY);
    addRing(roof, kColumns - dvec2(0.2), kColumns + dvec2(0.1), kRoofUpper - 0.02, 10.2,
            kInward | kOutward);
    addRing(roof, kColumns - dvec2(0.26), kColumns + dvec2(0.16), 10.18, 10.3);
    addPart(file, group, std::move(roof));
}

void addWalls(GltfFile& file, int group) {
    // A mesh per storey: a lightmap texel then never reaches through a slab. The joints are inside
    // the slabs.
    const double joint = (kSlabLower + kUpperFloor) / 2, roofJoint = (kRoofLower + kRoofUpper) / 2;
    const struct {
        const char* name;
        double y0, y1;
    } storeys[] = {{"Ground walls", -0.3, joint},
                   {"Upper walls", joint, roofJoint},
                   {"Parapet", roofJoint, kWallTop}};
    const dvec2 edge = kWall + dvec2(kWallThickness);
    for (const auto& storey : storeys) {
        Mesh walls{.name = storey.name, .material = Stone};
        addRing(walls, kWall, edge, storey.y0, storey.y1, kInward);
        addPart(file, group, std::move(walls), 2.4);
    }
    Mesh outside{.name = "Outer walls", .material = Stone};
    addRing(outside, kWall, edge, -0.3, kWallTop, kOutward);
    addPart(file, group, std::move(outside), 2.4);

    // Closes the building below: whatever light comes from under the horizon stays outside.
    Mesh base{.name = "Foundation", .material = Stone};
    addQuad(base, {-edge.x, -0.3, -edge.y}, {edge.x, -0.3, -edge.y}, {edge.x, -0.3, edge.y},
            {-edge.x, -0.3, edge.y});
    addPart(file, group, std::move(base), 2.4);
    Mesh coping{.name = "Coping", .material = Limestone};
    addRing(coping, kWall - dvec2(0.06), kWall + dvec2(kWallThickness + 0.06), kWallTop - 0.02,
            kWallTop + 0.12);
    addPart(file, group, std::move(coping));

    Mesh skirting{.name = "Skirting", .material = Limestone};
    addRing(skirting, kWall - dvec2(0.05), kBuried, kGroundFloor, 0.6, kInward | PositiveY);
    addRing(skirting, kWall - dvec2(0.04), kBuried, kUpperFloor, kUpperFloor + 0.3,
            kInward | PositiveY);
    addPart(file, group, std::move(skirting));
}

} // namespace

void addShell(GltfFile& file) {
    const int group = addGroup(file, "Shell");
    addFloors(file, group);
    addSlabs(file, group);
    addWalls(file, group);
}

} // namespace limn::atrium
