// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lighting/lighting_driver.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/picture/field_render.h"
#include "engine/reference/reference.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace limn {

/// The scene with its lights moved by `share` [0, 1] of the way to a place near its centre;
/// directional ones turn about the vertical by as many radians. Sky and emissive surfaces of a
/// scene without lights are brighter by that share.
Scene withLightsMoved(const Scene& scene, float share);

/// rms(a - b) / mean(b) over pixels and channels; 0 for two black pictures.
double distanceOf(const ImageF& a, const ImageF& b);

/// Change between consecutive frames, rms over frames, pixels and channels, less that of the truth,
/// both relative to the mean of the truth. `truth` and `truth2` are references of the same frames
/// with independent noise, which does not count as change. Negative where light lags behind.
/// Precondition: all have the same number of frames, >= 2, of the same size.
double flickerOf(std::span<const ImageF> frames, std::span<const ImageF> truth,
                 std::span<const ImageF> truth2);

/// References of a light's smooth move, two of each frame.
struct MotionTruth {
    std::vector<ImageF> first, second;
};

/// Frames of the smooth move, and share of its way by which lights move in each.
inline constexpr int kMotionFrames = 5;
inline constexpr float kMotionStep = 0.02f;

/// Renders the references of a move. `view`: size, samples and camera; its seed is not used.
MotionTruth renderMotion(const TraceScene& trace, const ReferenceOptions& view);

/// How a technique follows its light as the editor drives it: one update a frame, of what the
/// camera sees.
class LiveLight {
public:
    /// `scene`, `trace` and `layout` outlive the object; `scene` is what the technique lights.
    LiveLight(std::unique_ptr<Lighting> lighting, const Scene& scene, const TraceScene& trace,
              const LightmapLayout& layout, const FieldRenderOptions& view);

    /// Flicker of the move that `truth` shows; std::nullopt: cancelled.
    std::optional<double> flicker(const MotionTruth& truth, const Progress& progress = {});

    /// Updates after a jump by half the way until the picture differs from that of converged light
    /// by at most 5 %; std::nullopt: it takes more than kMaxUpdates, or was cancelled.
    std::optional<std::uint32_t> lag(const Progress& progress = {});

    static constexpr std::uint32_t kMaxUpdates = 4096;

private:
    void update(const Scene& scene);
    bool converge(const Scene& scene, const Progress& progress);
    ImageF picture() const;

    const Scene& m_scene;
    const TraceScene& m_trace;
    const LightmapLayout& m_layout;
    FieldRenderOptions m_view;
    LightingDriver m_driver;
};

} // namespace limn
