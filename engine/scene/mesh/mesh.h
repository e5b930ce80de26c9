// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// One glTF primitive: indexed triangles in object space [m]. Counter-clockwise is the front.
/// The importer guarantees: indices in range and a multiple of 3; every number finite; unit
/// normals; optional arrays empty or as long as `positions`; triangles of zero area removed.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< unit; generated when the file has none
    std::vector<glm::vec4> tangents; ///< w = handedness ±1; empty without normal map
    std::vector<glm::vec2> uv0;      ///< TEXCOORD_0, v down; empty: none
    std::vector<glm::vec2> uv1;      ///< TEXCOORD_1, authored lightmap UV; empty: none
    /// TEXCOORD_2 and up; those that its material does not read are empty.
    std::vector<std::vector<glm::vec2>> furtherUv;
    std::vector<glm::vec4> colors; ///< COLOR_0, linear, multiplies base colour; empty: none
    std::vector<std::uint32_t> indices;
    std::uint32_t material = 0; ///< index into Scene::materials

    /// Texture coordinates of a set, TEXCOORD_0, 1 and so on; empty: it has none.
    const std::vector<glm::vec2>& uv(std::uint32_t set) const {
        static const std::vector<glm::vec2> kNone;
        if (set < 2)
            return set == 0 ? uv0 : uv1;
        return set - 2 < furtherUv.size() ? furtherUv[set - 2] : kNone;
    }
    std::size_t triangleCount() const { return indices.size() / 3; }
    std::array<std::uint32_t, 3> triangle(std::size_t t) const {
        return {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]};
    }
    bool operator==(const Mesh&) const = default;
};

} // namespace limn
