// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/camera.h"
#include "engine/scene/view.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// Times of a frame: GPU times of passes, except for relighting on the CPU [ms].
struct FrameTimes {
    double shadowMaps = 0;
    double lightsOnSurfels = 0; ///< from shadow maps, or by rays on the CPU
    double surfels = 0, pull = 0, caches = 0, field = 0;
    double upload = 0; ///< of the field where it comes from the CPU
    double geometry = 0, indirect = 0, direct = 0, tonemap = 0;
    double perLight = 0; ///< shadow maps and lights on surfels over the lights
    double total = 0;    ///< of the clock on the wall
    std::uint32_t cachesUnseen = 0;
    std::uint32_t bandsLit = 0; ///< of the bake's, those that some surface needs
};

struct FrameOptions {
    std::string device; ///< part of the Vulkan device's name; empty: the best one
    View view = View::Lit;
    std::uint32_t width = 1280, height = 720;
    bool onGpu = true;    ///< bounced light; else the CPU's
    bool indirect = true; ///< else there is no bounced light
    bool seenOnly = true; ///< light the caches that the picture reads; else all
    bool coarseShadows = false;
    std::uint32_t bounces = 1; ///< a frame
};

/// Frames of a viewport, but for the first, which lights materials and makes pipelines too.
struct DrawnFrames {
    std::string device;
    std::vector<FrameTimes> frames;
    std::uint32_t lightsLeftOut = 0, geometryDrawn = 0; ///< geometry: number of frames that drew it
    std::uint64_t bytes = 0;                            ///< allocated on the device
};

/// What a frame shows.
struct FrameScene {
    Scene scene;
    Camera camera;
};

/// Draws `runs` frames and one before them; frame k shows sceneAt(k). `trace` belongs to a scene
/// that differs from these in its lights at most. Fails if there is no such device or the bake is
/// too large for it.
Result<DrawnFrames> drawFrames(const FrameOptions& options, const TraceScene& trace,
                               const std::shared_ptr<const Bake>& bake, int runs,
                               const std::function<FrameScene(int k)>& sceneAt);

} // namespace limn
