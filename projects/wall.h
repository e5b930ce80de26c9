// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gallery/mesh_builder.h"

#include <string>

namespace limn {

/// A rectangle about `centre` with `right` and `up` half its edges [m], its front towards
/// right x up.
inline Mesh wall(const std::string& name, std::uint32_t material, glm::dvec3 centre,
                 glm::dvec3 right, glm::dvec3 up) {
    Mesh mesh{.name = name, .material = material};
    addQuad(mesh, centre - right - up, centre + right - up, centre + right + up,
            centre - right + up);
    return mesh;
}

} // namespace limn
