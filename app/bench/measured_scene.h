// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/smooth_motion.h"
#include "app/commands/scene_options.h"

#include "engine/measure/reference_set.h"
#include "engine/reference/reference.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// A scene with its references, which techniques are measured against.
struct MeasuredScene {
    std::string name; ///< of its file, with what tells it from the others of a benchmark
    Scene scene;
    std::unique_ptr<TraceScene> trace;
    ReferenceOptions view;
    ReferenceSet one, all;            ///< of one bounce, and of all
    ImageF lit;                       ///< with direct light and all bounces
    std::vector<MotionTruth> motions; ///< of lights, camera and, where there are any, objects
};

/// Opens a scene and renders its references. `samplesPerPixel`: of all references of a kind
/// together. `points`: number of point lights over the scene's surfaces in place of its own lights
/// (moving_lights.h); 0: its own. Shows progress on stderr. Fails as openScene() and
/// chooseCamera().
Result<MeasuredScene> openMeasured(const SceneOptions& options, const CameraOptions& camera,
                                   std::uint32_t samplesPerPixel, std::uint32_t points = 0);

} // namespace limn
