// SPDX-License-Identifier: MIT
#include "projects/atrium/atrium.h"

#include <cmath>

namespace limn::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kPi = 3.14159265358979323846;

// The left half of a curtain under an arch, tied back to the column at half height.
Mesh curtain(Material cloth, const char* name) {
    Mesh mesh{.name = name, .material = cloth};
    addSheet(mesh, 48, 24, false, [](double u, double v) {
        const double tied = std::exp(-std::pow((v - 0.58) / 0.2, 2));
        const double width = 1.02 * (1 - 0.68 * tied), folds = 0.055 * (1 - 0.45 * tied);
        const double sway = std::sin(2 * kPi * (5.5 * u + 0.15 * std::sin(4 * v)));
        const double sag = 0.06 * std::sin(kPi * u) * tied;
        return dvec3(-1.06 + width * u, 2.9 - 2.5 * v - sag, 0.04 + folds * sway);
    });
    return mesh;
}

Mesh curtainRod() {
    Mesh mesh{.name = "Curtain rod", .material = Bronze};
    addBox(mesh, {-1.2, 2.88, 0.02}, {1.2, 2.93, 0.07},
           AllFaces & ~unsigned(NegativeX | PositiveX));
    return mesh;
}

// Hangs over the rail of the gallery, on the court's side.
dvec3 bannerPoint(double u, double y) {
    const double down = (5.98 - y) / 2.6;
    return {0.45 * (2 * u - 1), y, -0.4 - 0.05 * down * std::sin(2 * kPi * u + 2 * down)};
}

Mesh banner(Material cloth, const char* name) {
    Mesh mesh{.name = name, .material = cloth};
    addSheet(mesh, 16, 24, false,
             [](double u, double v) { return bannerPoint(u, 5.98 - 2.5 * v); });
    return mesh;
}

Mesh fringe() {
    Mesh mesh{.name = "Fringe", .material = Fringe};
    addSheet(mesh, 16, 2, false,
             [](double u, double v) { return bannerPoint(u, 3.48 - 0.26 * v); });
    for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 16; ++i)
            mesh.uv0.push_back({float(i) / 4, float(j) / 2});
    return mesh;
}

void addCloth(GltfFile& file) {
    const int group = addGroup(file, "Cloth");
    const int curtains[4] = {addMesh(file, curtain(Crimson, "Crimson curtain")),
                             addMesh(file, curtain(Ultramarine, "Ultramarine curtain")),
                             addMesh(file, curtain(Saffron, "Saffron curtain")),
                             addMesh(file, curtain(Emerald, "Emerald curtain"))};
    const int rod = addMesh(file, curtainRod());
    for (int s : {0, 2})
        for (int i = 0; i < 4; ++i) {
            const double x = kBay * ((i < 2 ? i : i + 2) + 0.5) - kColumns.x;
            const int mesh = curtains[(i + s) % 4];
            placeOnSide(file, group, rod, kSides[s], {x, 0, 0});
            placeOnSide(file, group, mesh, kSides[s], {x, 0, 0});
            placeOnSide(file, group, mesh, kSides[s], {x, 0, 0}, true);
        }
    const int banners[4] = {addMesh(file, banner(Saffron, "Saffron banner")),
                            addMesh(file, banner(Crimson, "Crimson banner")),
                            addMesh(file, banner(Emerald, "Emerald banner")),
                            addMesh(file, banner(Ultramarine, "Ultramarine banner"))};
    const int fringeMesh = addMesh(file, fringe());
    for (int s = 0; s < 4; ++s) {
        placeOnSide(file, group, banners[s], kSides[s], dvec3(0));
        placeOnSide(file, group, fringeMesh, kSides[s], dvec3(0));
    }
}

void addFountain(GltfFile& file, int group) {
    Mesh stone{.name = "Fountain", .material = Limestone};
    const Profile basin = {{{1.2, 0}, {1.2, 0.1}},
                           {{1.2, 0.1}, {1.04, 0.1}},
                           curve({1.04, 0.1}, {1.04, 0.42}, 0.02, 6),
                           curve({1.08, 0.42}, {1.08, 0.5}, 0.03, 5),
                           {{1.08, 0.5}, {0.88, 0.5}},
                           {{0.88, 0.5}, {0.88, 0.3}}};
    addTurned(stone, dvec3(0), basin, 56);
    const Profile stem = {curve({0.22, 0.3}, {0.14, 0.5}, -0.03, 4),
                          curve({0.1, 0.5}, {0.09, 0.95}, 0.06, 8),
                          curve({0.09, 0.95}, {0.5, 1.2}, 0.06, 8),
                          curve({0.52, 1.2}, {0.52, 1.25}, 0.015, 3),
                          {{0.52, 1.25}, {0.46, 1.25}},
                          {{0.46, 1.25}, {0.44, 1.19}}};
    addTurned(stone, dvec3(0), stem, 40);
    place(file, group, addMesh(file, std::move(stone)), dvec3(0));
    Mesh water{.name = "Water", .material = Water};
    addTurned(water, dvec3(0), {{{0.9, 0.38}, {0, 0.38}}}, 40);
    addTurned(water, dvec3(0), {{{0.46, 1.215}, {0, 1.215}}}, 40);
    place(file, group, addMesh(file, std::move(water)), dvec3(0));
}

void addPlants(GltfFile& file, int group) {
    Mesh pot{.name = "Pot", .material = Terracotta};
    const Profile profile = {curve({0.22, 0}, {0.34, 0.5}, 0.03, 6),
                             {{0.37, 0.48}, {0.37, 0.56}},
                             {{0.37, 0.56}, {0.31, 0.56}},
                             {{0.31, 0.56}, {0.3, 0.46}},
                             {{0.3, 0.47}, {0, 0.47}}};
    addTurned(pot, dvec3(0), profile, 28);
    addTurned(pot, dvec3(0), {{{0.04, 0.45}, {0.035, 0.9}}}, 8);
    Mesh bush{.name = "Bush", .material = Leaf};
    addSheet(bush, 44, 26, true, [](double u, double v) {
        const double longitude = -2 * kPi * u, latitude = kPi * (v - 0.5);
        const double leaves =
            std::sin(11 * longitude + 3 * std::sin(7 * latitude)) * std::sin(13 * latitude);
        const double r = 0.46 + 0.035 * leaves * std::cos(latitude);
        return dvec3(r * std::cos(latitude) * std::cos(longitude), 1.2 + r * std::sin(latitude),
                     r * std::cos(latitude) * std::sin(longitude));
    });
    const int potMesh = addMesh(file, std::move(pot)), bushMesh = addMesh(file, std::move(bush));
    for (double x : {-6.9, 6.9})
        for (double z : {-1.6, 1.6}) {
            place(file, group, potMesh, {x, 0, z});
            place(file, group, bushMesh, {x, 0, z});
        }
}

void addDoors(GltfFile& file, int group) {
    Mesh frame{.name = "Door frame", .material = Limestone}, door{.name = "Door", .material = Wood};
    const double floor = kGroundFloor, wall = kGallery + 0.05, front = kGallery - 0.12;
    const unsigned seen = NegativeX | PositiveX | PositiveY | NegativeZ;
    addBox(frame, {-0.78, floor, front}, {-0.6, 2.42, wall}, seen);
    addBox(frame, {0.6, floor, front}, {0.78, 2.42, wall}, seen);
    addBox(frame, {-0.86, 2.4, front - 0.04}, {0.86, 2.62, wall}, seen | NegativeY);
    for (double x : {-0.3, 0.3}) {
        addBox(door, {x - 0.31, floor, front + 0.07}, {x + 0.31, 2.41, wall},
               NegativeZ | NegativeX | PositiveX);
        for (double y : {0.45, 1.05, 1.65})
            addBox(door, {x - 0.2, y, front + 0.04}, {x + 0.2, y + 0.45, wall}, seen | NegativeY);
    }
    const int frameMesh = addMesh(file, std::move(frame)),
              doorMesh = addMesh(file, std::move(door));
    for (int s : {0, 2})
        for (double x : {-2.5 * kBay, -0.5 * kBay, 0.5 * kBay, 2.5 * kBay}) {
            placeOnSide(file, group, frameMesh, kSides[s], {x, 0, 0});
            placeOnSide(file, group, doorMesh, kSides[s], {x, 0, 0});
        }
}

} // namespace

void addFurnishing(GltfFile& file) {
    addCloth(file);
    const int group = addGroup(file, "Furnishing");
    addFountain(file, group);
    addPlants(file, group);
    addDoors(file, group);
}

} // namespace limn::atrium
