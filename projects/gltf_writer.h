// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

struct GltfMaterial {
    std::string name{};
    glm::dvec3 baseColor{1}; ///< linear Rec. 709
    double metallic = 0;
    double roughness = 1;
    glm::dvec3 emissive{0};      ///< emissiveFactor, [0, 1]
    double emissiveStrength = 1; ///< [nits]
    std::string texture{};       ///< file name of the base colour image; empty: none
    std::string emissiveTexture{};
    bool alphaMask = false; ///< cut off at 0.5
    bool doubleSided = false;
    double transmission = 0; ///< of KHR_materials_transmission
    double thickness = 0;    ///< of KHR_materials_volume; the index of refraction is 1.5
};

/// Directional light of KHR_lights_punctual.
struct GltfSun {
    std::string name{};
    glm::dvec3 color{1};
    double lux = 0;
};

/// Spot light of KHR_lights_punctual.
struct GltfSpot {
    std::string name{};
    glm::dvec3 color{1};
    double candela = 0;
    double innerAngle = 0, outerAngle = 0.785398; ///< half-angles [rad]
};

/// Point light of KHR_lights_punctual.
struct GltfPoint {
    std::string name{};
    glm::dvec3 color{1};
    double candela = 0;
};

struct GltfCamera {
    std::string name{};
    double fovY = 0.9; ///< [rad]
};

/// A root node, or a child of `parent`. At most one of mesh, camera and lights is set (>= 0).
struct GltfNode {
    std::string name{};
    int parent = -1; ///< an earlier node
    int mesh = -1, camera = -1, sun = -1, spot = -1, point = -1;
    glm::dvec3 translation{0};
    glm::dvec4 rotation{0, 0, 0, 1}; ///< x, y, z, w; unit
    glm::dvec3 scale{1};
};

struct GltfFile {
    std::string name{}; ///< of the scene; also the stem of the two files
    std::string copyright{};
    std::vector<GltfMaterial> materials{};
    std::vector<Mesh> meshes{}; ///< their uv1, tangents and colours are not written
    std::vector<GltfSun> suns{};
    std::vector<GltfSpot> spots{};
    std::vector<GltfPoint> points{};
    std::vector<GltfCamera> cameras{};
    std::vector<GltfNode> nodes{};
};

/// The rotation (x, y, z, w) that turns -Z towards `direction` (unit) and keeps +Y as upright as it
/// can.
glm::dvec4 lookAlong(glm::dvec3 direction);

/// Writes `folder`/NAME.gltf and `folder`/NAME.bin: the same bytes for the same input.
/// False when a file cannot be written.
bool writeGltf(const GltfFile& file, const std::string& folder);

} // namespace limn
