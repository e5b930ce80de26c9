// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/smooth_motion.h"

#include "engine/core/progress.h"
#include "engine/lighting/lighting_driver.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/picture/field_render.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace limn {

/// rms(a - b) / mean(b) over pixels and channels; 0 for two black pictures.
double distanceOf(const ImageF& a, const ImageF& b);

/// Largest difference between two pictures of the same size, relative to the mean of `b`; 0 for two
/// black ones.
double largestDifference(const ImageF& a, const ImageF& b);

/// How a technique follows its light as the editor drives it: one update a frame, of what the
/// camera sees.
class LiveLight {
public:
    /// `scene`, `trace` and `layout` outlive the object; `scene` is what the technique lights.
    LiveLight(std::unique_ptr<Lighting> lighting, const Scene& scene, const TraceScene& trace,
              const LightmapLayout& layout, const FieldRenderOptions& view);

    /// Flicker of the motion that `truth` shows; std::nullopt: cancelled, or no pixel is compared.
    /// Irradiance is that of the surfaces which the camera shows where it stands, whatever moves.
    std::optional<double> flicker(const MotionTruth& truth, const Progress& progress = {});

    /// Updates after a jump by half the way until the picture differs from that of converged light
    /// by at most 5 %; std::nullopt: it takes more than kMaxUpdates, or was cancelled.
    std::optional<std::uint32_t> lag(const Progress& progress = {});

    static constexpr std::uint32_t kMaxUpdates = 4096;

private:
    void update(const Scene& scene, const TraceScene& trace, const Camera& camera);
    bool converge(const Scene& scene, const Progress& progress);
    ImageF picture(const TraceScene& trace) const;

    const Scene& m_scene;
    const TraceScene& m_trace;
    const LightmapLayout& m_layout;
    FieldRenderOptions m_view;
    LightingDriver m_driver;
};

} // namespace limn
