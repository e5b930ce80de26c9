// SPDX-License-Identifier: MIT
// Writes cornell.gltf and cornell.bin: the box of "Goral, Torrance, Greenberg, Battaile. Modeling
// the Interaction of Light Between Diffuse Surfaces. 1984" with the geometry that Cornell measured
// and published later (two blocks, slightly uneven walls). Published in millimetres; here 100 of
// them are a metre, so that the box is a room.
#include "projects/gltf_writer.h"

#include <array>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

namespace {

using namespace limn;
using glm::dvec3;
using Quad = std::array<dvec3, 4>;

enum Material : std::uint32_t { White, Red, Green, Panel };

// The measurement has +x to the left of a viewer who looks along +z. Turned by half a circle about
// y, so that the camera looks along -z with red on its left, and centred on x and z.
dvec3 place(dvec3 measured) {
    return dvec3(278.0 - measured.x, measured.y, 279.6 - measured.z) / 100.0;
}

// The corners run counter-clockwise seen from the lit side.
void addQuad(Mesh& mesh, const Quad& measured) {
    const std::array<dvec3, 4> p = {place(measured[0]), place(measured[1]), place(measured[2]),
                                    place(measured[3])};
    const dvec3 normal = glm::normalize(glm::cross(p[2] - p[0], p[3] - p[1]));
    const auto first = std::uint32_t(mesh.positions.size());
    for (dvec3 corner : p) {
        mesh.positions.push_back(glm::vec3(corner));
        mesh.normals.push_back(glm::vec3(normal));
    }
    for (std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + corner);
}

Mesh wall(const char* name, Material material, const Quad& measured) {
    Mesh mesh{.name = name, .material = material};
    addQuad(mesh, measured);
    return mesh;
}

constexpr Quad kPanel = {dvec3(343, 548.8, 227), dvec3(343, 548.8, 332), dvec3(213, 548.8, 332),
                         dvec3(213, 548.8, 227)};
constexpr Quad kCeiling = {dvec3(556, 548.8, 0), dvec3(556, 548.8, 559.2), dvec3(0, 548.8, 559.2),
                           dvec3(0, 548.8, 0)};

// The panel sits in a hole of the ceiling and shares the hole's corners: no crack, nothing
// coplanar.
Mesh ceiling() {
    Mesh mesh{.name = "Ceiling", .material = White};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        addQuad(mesh, {kCeiling[i], kCeiling[next], kPanel[next], kPanel[i]});
    }
    return mesh;
}

// Top and four sides. The side towards the floor is left out: nothing sees it, and it would lie in
// the floor's plane.
Mesh block(const char* name, const Quad& top) {
    Mesh mesh{.name = name, .material = White};
    addQuad(mesh, top);
    for (std::size_t i = 0; i < 4; ++i) {
        const dvec3 a = top[i], b = top[(i + 1) % 4];
        addQuad(mesh, {b, a, dvec3(a.x, 0, a.z), dvec3(b.x, 0, b.z)});
    }
    return mesh;
}

GltfFile cornell() {
    GltfFile file{.name = "cornell", .copyright = "MIT; geometry measured by Cornell University"};
    // The published reflectances and lamp, as linear Rec. 709. The panel is (18.387, 13.987, 6.754)
    // nits.
    file.materials = {{.name = "White", .baseColor = {0.725, 0.71, 0.68}},
                      {.name = "Red", .baseColor = {0.63, 0.065, 0.05}},
                      {.name = "Green", .baseColor = {0.14, 0.45, 0.091}},
                      {.name = "Panel",
                       .baseColor = {0.78, 0.78, 0.78},
                       .emissive = {1, 0.7607, 0.3673},
                       .emissiveStrength = 18.387}};
    file.meshes = {
        wall("Floor", White,
             {dvec3(552.8, 0, 0), dvec3(0, 0, 0), dvec3(0, 0, 559.2), dvec3(549.6, 0, 559.2)}),
        ceiling(),
        wall("Back wall", White,
             {dvec3(549.6, 0, 559.2), dvec3(0, 0, 559.2), dvec3(0, 548.8, 559.2),
              dvec3(556, 548.8, 559.2)}),
        wall("Right wall", Green,
             {dvec3(0, 0, 559.2), dvec3(0, 0, 0), dvec3(0, 548.8, 0), dvec3(0, 548.8, 559.2)}),
        wall("Left wall", Red,
             {dvec3(552.8, 0, 0), dvec3(549.6, 0, 559.2), dvec3(556, 548.8, 559.2),
              dvec3(556, 548.8, 0)}),
        block("Short block", {dvec3(130, 165, 65), dvec3(82, 165, 225), dvec3(240, 165, 272),
                              dvec3(290, 165, 114)}),
        block("Tall block", {dvec3(423, 330, 247), dvec3(265, 330, 296), dvec3(314, 330, 456),
                             dvec3(472, 330, 406)}),
        wall("Panel", Panel, kPanel)};
    for (std::size_t i = 0; i < file.meshes.size(); ++i)
        file.nodes.push_back({.name = file.meshes[i].name, .mesh = int(i)});
    // 35 mm lens, 25 mm square film.
    file.cameras = {{.name = "Camera", .fovY = 2 * std::atan(0.025 / 2 / 0.035)}};
    file.nodes.push_back({.name = "Camera", .camera = 0, .translation = place({278, 273, -800})});
    return file;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: generate_cornell FOLDER\n", stderr);
        return 2;
    }
    if (!limn::writeGltf(cornell(), argv[1])) {
        std::fprintf(stderr, "generate_cornell: cannot write to %s\n", argv[1]);
        return 1;
    }
}
