// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/passes/geometry_passes.h"
#include "engine/render/shadows/shadow_cascades.h"
#include "engine/render/viewport.h"
#include "shaders/shared/gpu_frame.h"

#include <cstdint>

namespace limn::render {

/// The view of a picture. `grid`: instances without lightmap read the grid.
GeometryView geometryView(const ViewportOptions& options, const Bounds& bounds, bool grid);

/// Where sample `number` of every pixel lies, from the pixel's middle to the right and downwards,
/// each in [-0.5, 0.5) of a pixel. Sample 0 is the middle. The first 2^k samples lie in different
/// ones of 2^k equal columns, and of as many rows: they are the first two dimensions of Sobol's
/// sequence with their highest bits flipped (Sobol, "On the distribution of points in a cube and
/// the approximate evaluation of integrals", 1967).
glm::vec2 samplePoint(std::uint32_t number);

/// `view` with the points at `point` of all pixels in their middles; the picture has `width` x
/// `height` pixels.
GeometryView throughPoint(GeometryView view, glm::vec2 point, std::uint32_t width,
                          std::uint32_t height);

/// Sets what shaders need to compute positions from depths: the eye, the rays through `point` of
/// all pixels, as in throughPoint(), the depth range, and the positions' error on a device that
/// moves vertices to steps of 1/2^`subPixelBits` of a pixel.
void describePixels(const ViewportOptions& options, const Bounds& bounds, glm::vec2 point,
                    std::uint32_t subPixelBits, shared::GpuFrame& frame);

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
