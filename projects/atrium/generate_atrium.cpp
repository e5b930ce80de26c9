// SPDX-License-Identifier: MIT
// Writes atrium.gltf, atrium.bin and the textures: an invented two-storey court, made to show
// bounced light.
#include "projects/atrium/atrium.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

namespace limn::atrium {
namespace {

constexpr glm::dvec4 kTurns[4] = {{0, 0, 0, 1},
                                  {0, 0.70710678118654752, 0, 0.70710678118654752},
                                  {0, 1, 0, 0},
                                  {0, -0.70710678118654752, 0, 0.70710678118654752}};

glm::dvec3 turned(glm::dvec3 p, int turns) {
    switch (turns) {
    case 1:
        return {p.z, p.y, -p.x};
    case 2:
        return {-p.x, p.y, -p.z};
    case 3:
        return {-p.z, p.y, p.x};
    default:
        return p;
    }
}

std::vector<GltfMaterial> materials() {
    return {{.name = "Stone", .texture = "stone.png"},
            {.name = "Limestone", .baseColor = {0.76, 0.69, 0.57}},
            {.name = "Plaster", .baseColor = {0.86, 0.82, 0.74}},
            {.name = "Paving", .roughness = 0.6, .texture = "paving.png"},
            {.name = "Terracotta", .baseColor = {0.6, 0.29, 0.17}},
            {.name = "Wood", .baseColor = {0.34, 0.19, 0.1}},
            {.name = "Crimson cloth", .baseColor = {0.6, 0.02, 0.03}, .doubleSided = true},
            {.name = "Saffron cloth", .baseColor = {0.8, 0.38, 0.02}, .doubleSided = true},
            {.name = "Ultramarine cloth", .baseColor = {0.04, 0.11, 0.6}, .doubleSided = true},
            {.name = "Emerald cloth", .baseColor = {0.02, 0.34, 0.12}, .doubleSided = true},
            {.name = "Fringe", .texture = "fringe.png", .alphaMask = true, .doubleSided = true},
            {.name = "Water", .baseColor = {0.03, 0.12, 0.14}, .roughness = 0.1},
            {.name = "Leaf", .baseColor = {0.09, 0.26, 0.04}},
            {.name = "Bronze", .baseColor = {0.14, 0.09, 0.05}, .roughness = 0.5}};
}

void addCamera(GltfFile& file, const char* name, glm::dvec3 eye, glm::dvec3 target, double fovY) {
    file.cameras.push_back({.name = name, .fovY = fovY});
    file.nodes.push_back({.name = name,
                          .camera = int(file.cameras.size()) - 1,
                          .translation = eye,
                          .rotation = lookAlong(glm::normalize(target - eye))});
}

GltfFile atriumFile() {
    GltfFile file{.name = "atrium", .copyright = "MIT"};
    file.materials = materials();
    addShell(file);
    addGroundStorey(file);
    addUpperStorey(file);
    addFurnishing(file);
    file.suns.push_back({.name = "Sun", .color = {1, 0.93, 0.82}, .lux = 10});
    file.nodes.push_back({.name = "Sun",
                          .sun = 0,
                          .translation = {0, 14, 0},
                          .rotation = lookAlong(glm::normalize(glm::dvec3(0.5, -1, -0.27)))});
    addCamera(file, "Court", {-7.3, 1.75, 0.9}, {2.0, 3.2, -0.6}, 1.05);
    addCamera(file, "Gallery", {-10.6, 6.75, 4.3}, {2.0, 5.3, -1.2}, 1.0);
    addCamera(file, "Arcade", {-10.3, 1.7, -4.9}, {4.0, 2.2, -4.0}, 1.0);
    return file;
}

} // namespace

int addMesh(GltfFile& file, Mesh mesh) {
    file.meshes.push_back(std::move(mesh));
    return int(file.meshes.size()) - 1;
}

int addGroup(GltfFile& file, const std::string& name) {
    file.nodes.push_back({.name = name});
    return int(file.nodes.size()) - 1;
}

void place(GltfFile& file, int group, int mesh, glm::dvec3 position, int turns) {
    file.nodes.push_back({.name = file.meshes[std::size_t(mesh)].name,
                          .parent = group,
                          .mesh = mesh,
                          .translation = position,
                          .rotation = kTurns[turns]});
}

void placeOnSide(GltfFile& file, int group, int mesh, const Side& side, glm::dvec3 local,
                 bool mirrored) {
    place(file, group, mesh, turned(local + glm::dvec3(0, 0, side.distance), side.turns),
          side.turns);
    GltfNode& node = file.nodes.back();
    node.name += std::string(", ") + side.name;
    if (mirrored)
        node.scale = {-1, 1, 1};
}

std::vector<glm::dvec2> curve(glm::dvec2 a, glm::dvec2 b, double bulge, int segments) {
    const glm::dvec2 along = b - a, right = glm::normalize(glm::dvec2(along.y, -along.x));
    const glm::dvec2 control = (a + b) * 0.5 + right * (2 * bulge);
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= segments; ++i) {
        const double t = double(i) / segments;
        points.push_back(a * ((1 - t) * (1 - t)) + control * (2 * t * (1 - t)) + b * (t * t));
    }
    return points;
}

} // namespace limn::atrium

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: generate_atrium FOLDER\n", stderr);
        return 2;
    }
    if (!limn::writeGltf(limn::atrium::atriumFile(), argv[1]) ||
        !limn::atrium::writeTextures(argv[1])) {
        std::fprintf(stderr, "generate_atrium: cannot write to %s\n", argv[1]);
        return 1;
    }
}
