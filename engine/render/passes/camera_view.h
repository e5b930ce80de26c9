// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/passes/geometry_passes.h"
#include "engine/render/shadows/shadow_cascades.h"
#include "engine/render/viewport.h"

#include <cstdint>

namespace limn::render {

struct DepthRange {
    float zNear = 0, zFar = 0; ///< [m]
};

/// Depth range around the scene as the camera sees it.
DepthRange depthRange(const ViewportOptions& options, const Bounds& bounds);

/// The view of a picture. `grid`: instances without lightmap read the grid.
GeometryView geometryView(const ViewportOptions& options, const Bounds& bounds, bool grid);

/// Result of nearestInSight() for the last frame that needed it.
struct NearestSeen {
    glm::mat4 toClip{0};
    std::uint64_t scene = 0; ///< RenderScene::version
    float distance = 0;      ///< [m]
};

/// The camera of a picture's cascades. Updates `seen` if it is of another view or scene.
ShadowCamera shadowCamera(const ViewportOptions& options, const GeometryView& view,
                          const RenderScene& scene, NearestSeen& seen);

} // namespace limn::render
