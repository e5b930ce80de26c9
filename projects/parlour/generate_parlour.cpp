// SPDX-License-Identifier: MIT
// Writes parlour.gltf and parlour.bin: a parlour and a study side by side, open to the front, with
// a lamp above a table, a reading lamp and two night lights. Walls have strong colours and a
// partition stands between the rooms, so that a lamp that moves changes all of the bounced light.
#include "projects/gltf_writer.h"
#include "projects/wall.h"

#include <cmath>
#include <cstdio>
#include <string>

#include <glm/geometric.hpp>

namespace {

using namespace limn;
using glm::dvec3;

enum Material : std::uint32_t { White, Wood, Orange, Blue, Cloth, NightLight };

constexpr double kHalfWidth = 4, kHeight = 3, kHalfDepth = 2.5; // [m]

Mesh box(const std::string& name, Material material, dvec3 lower, dvec3 upper,
         unsigned faces = AllFaces) {
    Mesh mesh{.name = name, .material = material};
    addBox(mesh, lower, upper, faces);
    return mesh;
}

/// A plate on four legs, which end at the floor.
Mesh table(const std::string& name, dvec3 centre, glm::dvec2 half, double height) {
    constexpr double kPlate = 0.05, kLeg = 0.06;
    Mesh mesh{.name = name, .material = Wood};
    addBox(mesh, centre + dvec3(-half.x, height - kPlate, -half.y),
           centre + dvec3(half.x, height, half.y));
    for (const double x : {-1., 1.})
        for (const double z : {-1., 1.}) {
            const dvec3 foot = centre + dvec3(x * (half.x - kLeg), 0, z * (half.y - kLeg));
            addBox(mesh, foot - dvec3(kLeg / 2, 0, kLeg / 2),
                   foot + dvec3(kLeg / 2, height - kPlate, kLeg / 2),
                   AllFaces & ~(PositiveY | NegativeY));
        }
    return mesh;
}

/// Boards between two sides, against the back wall.
Mesh shelf(const std::string& name, double x0, double x1) {
    constexpr double kDepth = 0.3, kBoard = 0.03, kTop = 1.9;
    constexpr double kBack = -kHalfDepth + 0.001; // not in the plane of the wall
    Mesh mesh{.name = name, .material = Wood};
    for (const double x : {x0, x1 - kBoard})
        addBox(mesh, {x, 0, kBack}, {x + kBoard, kTop, kBack + kDepth}, AllFaces & ~NegativeY);
    for (const double y : {0.1, 0.55, 1.0, 1.45, kTop - kBoard})
        addBox(mesh, {x0 + kBoard, y, kBack}, {x1 - kBoard, y + kBoard, kBack + kDepth},
               AllFaces & ~(NegativeX | PositiveX));
    return mesh;
}

GltfFile parlour() {
    const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    constexpr double w = kHalfWidth, h = kHeight, d = kHalfDepth;
    GltfFile file{.name = "parlour", .copyright = "MIT"};
    file.materials = {{.name = "White", .baseColor = {0.75, 0.74, 0.72}},
                      {.name = "Wood", .baseColor = {0.42, 0.27, 0.15}},
                      {.name = "Orange", .baseColor = {0.75, 0.3, 0.08}},
                      {.name = "Blue", .baseColor = {0.1, 0.28, 0.62}},
                      {.name = "Cloth", .baseColor = {0.2, 0.45, 0.3}},
                      {.name = "Night light",
                       .baseColor = {0.8, 0.8, 0.8},
                       .emissive = {1, 0.72, 0.42},
                       .emissiveStrength = 30}};
    file.meshes = {
        wall("Floor", Wood, {0, 0, 0}, w * x, -d * z),
        wall("Ceiling", White, {0, h, 0}, w * x, d * z),
        wall("Back wall", White, {0, h / 2, -d}, w * x, h / 2 * y),
        wall("Parlour wall", Orange, {-w, h / 2, 0}, -d * z, h / 2 * y),
        wall("Study wall", Blue, {w, h / 2, 0}, d * z, h / 2 * y),
        box("Partition", White, {0.7, 0, -d}, {0.84, h, 0.7}, NegativeX | PositiveX | PositiveZ),
        table("Table", {-1.6, 0, 0}, {0.8, 0.5}, 0.74),
        box("Sofa", Cloth, {-3.6, 0, -1.4}, {-2.8, 0.42, 1.4}, AllFaces & ~NegativeY),
        table("Desk", {2.9, 0, -0.6}, {0.7, 0.4}, 0.74),
        shelf("Shelf", 1.4, 3.2),
        box("Parlour night light", NightLight, {0.64, 0.25, -1.1}, {0.699, 0.33, -0.98}),
        box("Study night light", NightLight, {0.841, 0.25, -1.1}, {0.9, 0.33, -0.98})};
    for (std::size_t i = 0; i < file.meshes.size(); ++i)
        file.nodes.push_back({.name = file.meshes[i].name, .mesh = int(i)});
    file.spots = {{.name = "Reading lamp",
                   .color = {1, 0.95, 0.85},
                   .candela = 14,
                   .innerAngle = 0.35,
                   .outerAngle = 0.6}};
    file.points = {{.name = "Table lamp", .color = {1, 0.84, 0.62}, .candela = 9}};
    file.nodes.push_back({.name = "Table lamp", .point = 0, .translation = {-1.6, 1.7, 0}});
    file.nodes.push_back({.name = "Reading lamp",
                          .spot = 0,
                          .translation = {2.5, 2.2, 0.2},
                          .rotation = lookAlong(glm::normalize(dvec3(0.3, -1, -0.55)))});
    file.cameras = {{.name = "Camera", .fovY = 0.55}};
    file.nodes.push_back({.name = "Camera",
                          .camera = 0,
                          .translation = {0, 2.1, 9.6},
                          .rotation = lookAlong(glm::normalize(dvec3(0, -0.07, -1)))});
    return file;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: generate_parlour FOLDER\n", stderr);
        return 2;
    }
    if (!limn::writeGltf(parlour(), argv[1])) {
        std::fprintf(stderr, "generate_parlour: cannot write to %s\n", argv[1]);
        return 1;
    }
}
