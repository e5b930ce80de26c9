// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/compare.h"
#include "engine/scene/camera.h"
#include "engine/scene/image.h"
#include "engine/scene/view.h"

#include <cstdint>
#include <optional>
#include <string>

namespace limn {

/// What stands beside Limn's picture: nothing, the path-traced picture, the signed difference to
/// it, the perceived difference (FLIP), the squared relative error, or the scene lit by another
/// technique.
enum class Compare : std::uint8_t { Off, Reference, Difference, Flip, SquaredError, Technique };

/// Whether it shows or measures a path-traced picture.
inline bool needsReference(Compare mode) {
    return mode != Compare::Off && mode != Compare::Technique;
}

/// The reference as the panels show it.
struct ReferenceStatus {
    bool running = false;
    std::uint32_t samples = 0;       ///< per pixel; 0: no picture yet
    double noise = 0;                ///< standard error of a pixel, relative to the mean
    double seconds = 0;              ///< spent on it
    float fraction = 0;              ///< of the pass that doubles the samples
    std::optional<Comparison> error; ///< of Limn's picture; none before both exist
};

struct CompareState {
    Compare mode = Compare::Off;
    float split = 0.5f; ///< where the reference begins, as a fraction of the picture's width [0, 1]
    bool held = false;  ///< the line at `split` is being dragged
    double noise = 0.01; ///< at which the reference is good enough, as ReferenceStatus::noise
    ReferenceStatus reference;
    std::string technique;     ///< Technique::name of the other one; empty: not chosen yet
    std::string techniqueText; ///< how far its light is, or why there is none
};

/// A picture of the viewport before tone mapping, and what it shows.
struct LinearPicture {
    ImageF image;
    Camera camera;
    View view = View::Lit;
};

} // namespace limn
