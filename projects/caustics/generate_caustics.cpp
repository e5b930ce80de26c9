// SPDX-License-Identifier: MIT
// Writes caustics.gltf and caustics.bin: a room like Cornell's with a ring of metal, a ball of
// glass, a ball of metal and a pane of tinted glass, lit by a spotlight. After the box with ring
// and spheres of "Norén, Sjölin. Real-Time Indirect Illumination. Image Space Light Lattice Photon
// Mapping using Spherical Harmonics. 2010".
#include "projects/gltf_writer.h"
#include "projects/wall.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>

namespace {

using namespace limn;
using glm::dvec2;
using glm::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr double kRoom = 5.6; // [m], a cube on y = 0 about the y axis

enum Material : std::uint32_t { White, Red, Green, Gold, Silver, Glass, Pane };

/// Points of a circular arc in the plane of a profile, angles from the axis downward [rad].
std::vector<dvec2> arc(dvec2 centre, double radius, double from, double to, int pieces) {
    std::vector<dvec2> points;
    for (int i = 0; i <= pieces; ++i) {
        const double angle = from + (to - from) * i / pieces;
        points.push_back(centre + radius * dvec2(std::sin(angle), -std::cos(angle)));
    }
    return points;
}

Mesh ball(const char* name, Material material, dvec3 centre, double radius) {
    Mesh mesh{.name = name, .material = material};
    addTurned(mesh, centre, {arc({0, radius}, radius, 0, kPi, 32)}, 64);
    return mesh;
}

/// A ring on the floor, about the y axis at `centre`; `radius` is that of its inner wall.
Mesh ring(const char* name, Material material, dvec3 centre, double radius, double height) {
    constexpr double kThickness = 0.06;
    const double outer = radius + kThickness;
    Mesh mesh{.name = name, .material = material};
    addTurned(mesh, centre,
              {{{outer, 0}, {outer, height}},
               {{outer, height}, {radius, height}},
               {{radius, height}, {radius, 0}}},
              128);
    return mesh;
}

GltfFile caustics() {
    constexpr double h = kRoom / 2;
    const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    GltfFile file{.name = "caustics", .copyright = "MIT"};
    file.materials = {
        {.name = "White", .baseColor = {0.73, 0.72, 0.7}},
        {.name = "Red", .baseColor = {0.63, 0.065, 0.05}},
        {.name = "Green", .baseColor = {0.14, 0.45, 0.091}},
        {.name = "Gold", .baseColor = {0.98, 0.77, 0.36}, .metallic = 1, .roughness = 0.04},
        {.name = "Silver", .baseColor = {0.95, 0.94, 0.91}, .metallic = 1, .roughness = 0.04},
        {.name = "Glass", .roughness = 0, .transmission = 1, .thickness = 1},
        {.name = "Pane",
         .baseColor = {0.45, 0.75, 0.95},
         .roughness = 0,
         .doubleSided = true,
         .transmission = 1}};
    file.meshes = {wall("Floor", White, {0, 0, 0}, h * x, -h * z),
                   wall("Ceiling", White, {0, kRoom, 0}, h * x, h * z),
                   wall("Back wall", White, {0, h, -h}, h * x, h * y),
                   wall("Left wall", Red, {-h, h, 0}, -h * z, h * y),
                   wall("Right wall", Green, {h, h, 0}, h * z, h * y),
                   ring("Ring", Gold, {-0.7, 0, -0.1}, 1, 0.5),
                   ball("Glass ball", Glass, {1.2, 0, 1.2}, 0.65),
                   ball("Silver ball", Silver, {1.5, 0, -1.5}, 0.75),
                   wall("Pane", Pane, {-1.2, 1.5, -2}, 1.1 * x, 1.3 * y)};
    for (std::size_t i = 0; i < file.meshes.size(); ++i)
        file.nodes.push_back({.name = file.meshes[i].name, .mesh = int(i)});
    const dvec3 lamp(-2.3, 3.3, 2.5), lit(0.3, 0.3, -0.2);
    file.spots = {{.name = "Spot",
                   .color = {1, 0.93, 0.8},
                   .candela = 120,
                   .innerAngle = 0.6,
                   .outerAngle = 0.8}};
    file.nodes.push_back({.name = "Spot",
                          .spot = 0,
                          .translation = lamp,
                          .rotation = lookAlong(glm::normalize(lit - lamp))});
    file.cameras = {{.name = "Camera", .fovY = 2 * std::atan(0.025 / 2 / 0.035)}};
    file.nodes.push_back({.name = "Camera",
                          .camera = 0,
                          .translation = {0, 4.9, 8.6},
                          .rotation = lookAlong(glm::normalize(dvec3(0, -0.37, -1)))});
    return file;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: generate_caustics FOLDER\n", stderr);
        return 2;
    }
    if (!limn::writeGltf(caustics(), argv[1])) {
        std::fprintf(stderr, "generate_caustics: cannot write to %s\n", argv[1]);
        return 1;
    }
}
