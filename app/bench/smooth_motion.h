// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/reference_set.h"
#include "engine/reference/reference.h"
#include "engine/scene/camera.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What moves while flicker is measured.
enum class Motion : std::uint8_t {
    Lights,
    Camera, ///< which looks at the same surfaces all the while
    Objects ///< the dynamic ones
};

/// Frames of a smooth motion, the first of which shows the scene as it is.
inline constexpr int kMotionFrames = 5;
/// What changes in each of them: the share of their way by which lights move (withLightsMoved()),
/// and the angle by which the camera turns [rad].
inline constexpr float kMotionStep = 0.02f;
/// How far the camera moves in each, as a share of the diagonal of the scene.
inline constexpr float kCameraStep = 0.002f;

/// The direction turned about the vertical, counter-clockwise as seen from above [rad].
glm::vec3 turned(glm::vec3 direction, float angle);

/// The scene with its lights moved by `share` [0, 1] of the way to a place near its centre;
/// directional ones turn about the vertical by as many radians. Sky and emissive surfaces of a
/// scene without lights are brighter by that share.
Scene withLightsMoved(const Scene& scene, float share);

/// A scene and the camera that looks at it.
struct MotionFrame {
    Scene scene;
    Camera camera;
};

/// Frame `k` of a motion. The camera moves to its right and turns to its left; objects move as
/// moveObjects() says.
MotionFrame motionFrame(Motion motion, const Scene& scene, const Camera& camera, int k);

/// Numbers of the pixels by which frames of a motion are compared, in the picture of `view` that
/// the camera shows where it stands. Lights: all of them. Camera: those whose middle and corners
/// show surfaces that the cameras of all frames see. Objects: those whose middle and corners show
/// static surfaces that no object hides in any frame. `trace` is of the scene at rest.
std::vector<std::uint32_t> comparedPixels(Motion motion, const TraceScene& trace,
                                          const ReferenceOptions& view);

/// These pixels, as a picture of one row.
ImageF pickedPixels(const ImageF& image, std::span<const std::uint32_t> pixels);

/// How irradiance changes while something moves, by path tracing.
struct MotionTruth {
    Motion motion = Motion::Lights;
    std::vector<std::uint32_t> pixels; ///< as comparedPixels()
    /// pickedPixels() of two references of each frame with independent noise, or of one frame for
    /// the camera, on which irradiance does not depend.
    std::vector<ImageF> first, second;
};

/// Renders the references of a motion. `view`: size, samples and camera; its seed is not used.
/// `standing`: references of the scene at rest.
MotionTruth renderMotion(Motion motion, const TraceScene& trace, const ReferenceOptions& view,
                         const ReferenceSet& standing);

/// Change between consecutive frames, rms over frames, pixels and channels, less that of the truth,
/// both relative to the mean of the truth. `truth` and `truth2` are references of the same frames
/// with independent noise, which does not count as change. Negative where light lags behind.
/// Precondition: `frames` are at least two pictures of one size; there are as many of the truth, or
/// a single one, where it does not change.
double flickerOf(std::span<const ImageF> frames, std::span<const ImageF> truth,
                 std::span<const ImageF> truth2);

} // namespace limn
