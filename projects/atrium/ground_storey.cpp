// SPDX-License-Identifier: MIT
#include "projects/atrium/atrium.h"

#include <algorithm>
#include <cmath>

namespace limn::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kPi = 3.14159265358979323846;
constexpr double kVaultRise = 1.4;
constexpr double kVaultReach = 1.85;  ///< half of a vault's span across the gallery
constexpr double kVaultMiddle = 1.95; ///< its middle, from the column axes

Mesh column() {
    Mesh mesh{.name = "Column", .material = Limestone};
    addBox(mesh, {-0.36, kGroundFloor, -0.36}, {0.36, 0.32, 0.36}, AllFaces & ~unsigned(NegativeY));
    const Profile base = {
        curve({0.33, 0.31}, {0.33, 0.43}, 0.04, 6), curve({0.3, 0.43}, {0.28, 0.5}, -0.02, 4),
        curve({0.28, 0.5}, {0.28, 0.57}, 0.025, 5), curve({0.28, 0.57}, {0.255, 0.62}, -0.01, 3)};
    addTurned(mesh, dvec3(0), base, 32);
    addTurned(mesh, dvec3(0), {curve({0.255, 0.6}, {0.225, 2.52}, 0.012, 8)}, 96, 16, 0.022);
    const Profile capital = {
        curve({0.25, 2.48}, {0.25, 2.55}, 0.025, 5), curve({0.235, 2.55}, {0.25, 2.62}, 0, 2),
        curve({0.25, 2.62}, {0.36, 2.86}, -0.05, 8), curve({0.36, 2.86}, {0.34, 2.92}, 0.02, 4)};
    addTurned(mesh, dvec3(0), capital, 32);
    addBox(mesh, {-0.37, 2.91, -0.37}, {0.37, kSpringing + 0.02, 0.37});
    addBox(mesh, {-0.28, kSpringing, -0.28}, {0.28, kSlabLower + 0.02, 0.28},
           NegativeX | PositiveX | NegativeZ | PositiveZ);
    return mesh;
}

Mesh arcade() {
    Mesh mesh{.name = "Arch", .material = Limestone};
    addArcadeWall(mesh, 1.3, kSpringing, kSlabLower + 0.02, 0.5, {{0, 1.1}}, 40);
    for (double side : {-1.0, 1.0}) {
        // Two fillets, listed so that they face away from the wall on either side of it.
        std::vector<dvec2> section = {{0.2, 0.24}, {0.2, 0.29},  {0.12, 0.29},
                                      {0.1, 0.31}, {0.02, 0.31}, {0.02, 0.24}};
        if (side < 0) {
            std::reverse(section.begin(), section.end());
            for (dvec2& point : section)
                point.y = -point.y;
        }
        addArch(mesh, {0, kSpringing, 0}, {1.1, 1.1}, section, 40);
    }
    for (double z : {-0.3, 0.3}) // keystone
        addBox(mesh, {-0.11, kSpringing + 1.06, z - 0.05}, {0.11, kSpringing + 1.42, z + 0.05});
    return mesh;
}

// A groin vault over the rectangle of half-sizes a (x) and b (z), seen from below: four webs of two
// crossing half-cylinders, each between the diagonals. It springs from y = 0.
Mesh vault(const char* name, double a, double b) {
    Mesh mesh{.name = name, .material = Plaster};
    for (int web = 0; web < 4; ++web) {
        const double across = web % 2 == 0 ? a : b, along = web % 2 == 0 ? b : a;
        addSheet(mesh, 28, 5, false, [=](double u, double v) {
            const double angle = kPi * (u - 0.5), s = std::sin(angle);
            const double x = across * s, z = along * (std::abs(s) + (1 - std::abs(s)) * v);
            const double y = kVaultRise * std::cos(angle);
            switch (web) {
            case 1:
                return dvec3(z, y, -x);
            case 2:
                return dvec3(-x, y, -z);
            case 3:
                return dvec3(-z, y, x);
            default:
                return dvec3(x, y, z);
            }
        });
    }
    return mesh;
}

// Across the gallery, from the column to the wall; the arch's plane is local x = 0.
Mesh rib() {
    Mesh arch{.name = "Rib", .material = Limestone};
    addArch(
        arch, dvec3(0, kSpringing - 0.03, 0), {kVaultReach, kVaultRise},
        {{0.12, 0.19}, {-0.17, 0.19}, {-0.22, 0.14}, {-0.22, -0.14}, {-0.17, -0.19}, {0.12, -0.19}},
        32);
    for (std::size_t i = 0; i < arch.positions.size();
         ++i) { // a quarter turn, then out to the middle
        glm::vec3 &p = arch.positions[i], &n = arch.normals[i];
        p = glm::vec3(p.z, p.y, -p.x + float(kVaultMiddle));
        n = glm::vec3(n.z, n.y, -n.x);
    }
    const double wall = kGallery;
    addBox(arch, {-0.22, kGroundFloor, wall - 0.18}, {0.22, 2.8, wall + 0.1},
           NegativeX | PositiveX | NegativeZ);
    addBox(arch, {-0.27, kGroundFloor, wall - 0.23}, {0.27, 0.66, wall + 0.1},
           NegativeX | PositiveX | PositiveY | NegativeZ);
    addBox(arch, {-0.28, 2.78, wall - 0.3}, {0.28, kSpringing, wall + 0.1},
           AllFaces & ~unsigned(PositiveZ));
    return arch;
}

} // namespace

void addGroundStorey(GltfFile& file) {
    const int group = addGroup(file, "Ground storey");
    const int columnMesh = addMesh(file, column()), arcadeMesh = addMesh(file, arcade());
    const int vaultMesh = addMesh(file, vault("Vault", kBay / 2, kVaultReach));
    const int cornerMesh = addMesh(file, vault("Corner vault", kVaultReach, kVaultReach));
    const int ribMesh = addMesh(file, rib());
    for (const Side& side : kSides) {
        const double half = kBay * side.bays / 2;
        for (int i = 0; i <= side.bays; ++i) {
            const double x = kBay * i - half;
            placeOnSide(file, group, ribMesh, side, {x, 0, 0});
            if (i > 0) // each corner column belongs to the side that ends there
                placeOnSide(file, group, columnMesh, side, {x, 0, 0});
        }
        for (int i = 0; i < side.bays; ++i) {
            const double x = kBay * (i + 0.5) - half;
            placeOnSide(file, group, arcadeMesh, side, {x, 0, 0});
            placeOnSide(file, group, vaultMesh, side, {x, kSpringing, kVaultMiddle});
        }
        placeOnSide(file, group, cornerMesh, side, {half + kVaultMiddle, kSpringing, kVaultMiddle});
    }
}

} // namespace limn::atrium
