// SPDX-License-Identifier: MIT
#include "projects/atrium/atrium.h"

namespace limn::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kRailTop = 6.1;
constexpr unsigned kSidesOnly = NegativeX | PositiveX | NegativeZ | PositiveZ;

// On a pedestal of half-width `half`; `radius` of the shaft.
Mesh column(const char* name, double half, double radius, double abacus) {
    Mesh mesh{.name = name, .material = Limestone};
    addBox(mesh, {-half, kUpperFloor, -half}, {half, kRailTop, half}, kSidesOnly);
    addBox(mesh, {-half - 0.04, kUpperFloor, -half - 0.04},
           {half + 0.04, kUpperFloor + 0.14, half + 0.04}, kSidesOnly | PositiveY);
    addBox(mesh, {-half - 0.04, kRailTop - 0.02, -half - 0.04},
           {half + 0.04, kRailTop + 0.08, half + 0.04});
    const double r = radius, y = kRailTop + 0.07;
    const Profile profile = {curve({r * 1.3, y}, {r * 1.3, y + 0.08}, 0.025, 5),
                             curve({r * 1.15, y + 0.08}, {r, y + 0.14}, -0.012, 3),
                             curve({r, y + 0.14}, {r * 0.86, 7.72}, 0.006, 6),
                             curve({r, 7.7}, {r, 7.76}, 0.02, 4),
                             curve({r * 0.9, 7.76}, {abacus - 0.02, 7.98}, -0.04, 6),
                             curve({abacus - 0.02, 7.98}, {abacus - 0.04, 8.02}, 0.01, 3)};
    addTurned(mesh, dvec3(0), profile, 24);
    addBox(mesh, {-abacus, 8.01, -abacus}, {abacus, kUpperSpringing + 0.02, abacus});
    return mesh;
}

Mesh mainColumn() {
    Mesh mesh = column("Upper column", 0.24, 0.19, 0.29);
    addBox(mesh, {-0.24, kUpperSpringing, -0.24}, {0.24, kRoofLower + 0.02, 0.24}, kSidesOnly);
    return mesh;
}

Mesh arcade() {
    Mesh mesh{.name = "Twin arch", .material = Limestone};
    addArcadeWall(mesh, 1.25, kUpperSpringing, kRoofLower + 0.02, 0.4, {{-0.7, 0.5}, {0.7, 0.5}},
                  28);
    for (double x : {-0.7, 0.7}) {
        addArch(mesh, {x, kUpperSpringing, 0}, {0.5, 0.5},
                {{0.12, 0.19}, {0.12, 0.23}, {0.02, 0.23}, {0.02, 0.19}}, 28);
        addArch(mesh, {x, kUpperSpringing, 0}, {0.5, 0.5},
                {{0.02, -0.19}, {0.02, -0.23}, {0.12, -0.23}, {0.12, -0.19}}, 28);
    }
    return mesh;
}

// Between two pedestals.
Mesh balustrade() {
    Mesh mesh{.name = "Balustrade", .material = Limestone};
    const double half = 0.55, floor = kUpperFloor;
    addBox(mesh, {-half, floor, -0.13}, {half, floor + 0.12, 0.13},
           PositiveY | NegativeZ | PositiveZ);
    addBox(mesh, {-half, kRailTop - 0.17, -0.13}, {half, kRailTop - 0.04, 0.13},
           PositiveY | NegativeY | NegativeZ | PositiveZ);
    const double y = floor + 0.11, top = kRailTop - 0.16;
    const Profile profile = {curve({0.06, y}, {0.045, y + 0.07}, 0.01, 2),
                             curve({0.035, y + 0.07}, {0.04, y + 0.4}, 0.045, 6),
                             curve({0.04, y + 0.4}, {0.05, y + 0.46}, 0.012, 2),
                             curve({0.035, y + 0.46}, {0.065, top}, -0.01, 3)};
    for (int i = -2; i <= 2; ++i)
        addTurned(mesh, {0.196 * i, 0, 0}, profile, 12);
    return mesh;
}

// Under the roof, across the gallery.
Mesh beams() {
    Mesh mesh{.name = "Beams", .material = Wood};
    for (double x : {-1.05, -0.35, 0.35, 1.05})
        addBox(mesh, {x - 0.09, kRoofLower - 0.22, 0.1},
               {x + 0.09, kRoofLower + 0.02, kGallery + 0.1}, NegativeX | PositiveX | NegativeY);
    return mesh;
}

Mesh cornerBeams() {
    Mesh mesh{.name = "Corner beams", .material = Wood};
    for (double x = 0.35; x < kGallery; x += 0.7)
        addBox(mesh, {x - 0.09, kRoofLower - 0.22, -0.1},
               {x + 0.09, kRoofLower + 0.02, kGallery + 0.1},
               NegativeX | PositiveX | NegativeY | NegativeZ);
    addBox(mesh, {-0.1, kRoofLower - 0.34, -0.3}, {kGallery + 0.1, kRoofLower + 0.02, -0.08},
           NegativeX | NegativeY | NegativeZ | PositiveZ);
    return mesh;
}

} // namespace

void addUpperStorey(GltfFile& file) {
    const int group = addGroup(file, "Upper storey");
    const int mainMesh = addMesh(file, mainColumn()), arcadeMesh = addMesh(file, arcade());
    const int middleMesh = addMesh(file, column("Middle column", 0.17, 0.12, 0.23));
    const int balustradeMesh = addMesh(file, balustrade());
    const int beamMesh = addMesh(file, beams()), cornerMesh = addMesh(file, cornerBeams());
    for (const Side& side : kSides) {
        const double half = kBay * side.bays / 2;
        for (int i = 1; i <= side.bays; ++i)
            placeOnSide(file, group, mainMesh, side, {kBay * i - half, 0, 0});
        for (int i = 0; i < side.bays; ++i) {
            const double x = kBay * (i + 0.5) - half;
            placeOnSide(file, group, arcadeMesh, side, {x, 0, 0});
            placeOnSide(file, group, middleMesh, side, {x, 0, 0});
            placeOnSide(file, group, balustradeMesh, side, {x - 0.67, 0, 0});
            placeOnSide(file, group, balustradeMesh, side, {x + 0.67, 0, 0});
            placeOnSide(file, group, beamMesh, side, {x, 0, 0});
        }
        placeOnSide(file, group, cornerMesh, side, {half, 0, 0});
    }
}

} // namespace limn::atrium
