// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/measure/baked_senders.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// One step from path-traced light to the light of the picture.
struct EnergyStep {
    std::string name;
    double energy = 0; ///< mean irradiance / that of the reference
    double nrmse = 0;  ///< rms(E - E_ref) / mean(E_ref), with the noise of both
};

/// Light of the surfels that caches see from one range of distances, of the caches that the
/// camera's pixels look up.
struct SendersAt {
    float from = 0, to = 0; ///< distance in widths of the surfel's patch, sqrt(area); `to` excluded
    double share = 0;  ///< irradiance that the points seen bring, path-traced / the reference's
    double excess = 0; ///< the same if these had the light of their surfels, minus `share`
    double noise = 0;  ///< standard error of `excess`
};

struct EnergyOptions {
    Camera camera;
    std::uint32_t width = 160, height = 90; ///< one surface point for each pixel
    std::uint32_t paths = 64;               ///< number for each point and each surfel
    std::uint32_t seed = 1;
};

/// The pixels that see emissive surfaces are left out of all but `onLamps`, unless the camera sees
/// nothing else: texels of lamps show what light falls on them, which is of little use, and a small
/// lamp's few may be far off.
struct EnergyChain {
    /// "reference": path tracing at the pixels' points. "texels": path tracing at the points of the
    /// lightmap caches that each pixel looks up, so interpolation alone differs. "surfels": caches
    /// gather from surfels that hold path-traced light, through one link for each visible sender.
    /// "cut": the same through the bake's own links. "bounces": relighting, as in the picture.
    /// "bounces, uncut": relighting through one link for each sender.
    std::vector<EnergyStep> steps;
    std::vector<EnergyStep> onLamps; ///< the same of the pixels left out; empty where none are
    /// Light straight from emissive surfaces: what the bake's links bring to the caches that pixels
    /// look up, against samples of the emissive surfaces at the caches' points. Energy 0 where
    /// nothing emits.
    EnergyStep emitters;
    /// By ascending distance. Their `excess` sums to about what "surfels" gains over "texels".
    /// Light of the sky is not among them.
    std::vector<SendersAt> senders;
    double noise = 0;         ///< standard error of the reference's mean, relative
    std::uint64_t pixels = 0; ///< number that see a surface with a lightmap
    std::uint64_t lamps = 0;  ///< of these, number in `onLamps`
    bool complete = false;    ///< false when cancelled
};

/// The bakes that measureEnergyChain() compares.
struct EnergyBakes {
    std::shared_ptr<const Bake> bake;
    std::shared_ptr<const Bake> uncut; ///< same scene, CutCriterion::SolidAngle and 4096 links
    const BakedSenders& senders;       ///< of `bake`
};

/// Replaces the chain from surfels to picture by path tracing one step at a time, and measures the
/// irradiance (View::Irradiance) at the points that the camera's pixels see. Unbiased except that
/// paths end after a maximum number of bounces.
EnergyChain measureEnergyChain(const TraceScene& trace, const EnergyBakes& bakes,
                               const EnergyOptions& options, const Progress& progress = {});

} // namespace limn
