// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/bench.h"
#include "app/bench/leak_room.h"
#include "app/bench/light_place.h"
#include "app/bench/measured_scene.h"
#include "app/bench/technique_variants.h"
#include "app/bench/timed_updates.h"

#include "engine/lighting/precomputed.h"
#include "engine/lighting/technique.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limn {

/// A technique with some settings, ready to light a scene anywhere.
struct Configuration {
    const Technique* technique;
    Variant variant;
    Scene scene;
    Prepared prepared;
    std::shared_ptr<const LightmapLayout> layout;
    double seconds = 0, bytes = 0; ///< of what was precomputed
};

/// Precomputes what the technique needs. Fails as Precomputation::prepare().
Result<Configuration> configure(const MeasuredScene& m, const Technique& technique, Variant variant,
                                const Progress& progress);

/// How long one configuration may be measured.
struct PointLimits {
    UpdateRuns runs;
    std::optional<double> liveSeconds; ///< for leak, flicker and lag; none: no limit
};

/// The costs and the errors of a configuration in one place, and its irradiance. In `row`, null
/// stands for what does not exist or did not end in time.
struct Point {
    Json row;
    ImageF picture;
};

/// Fails where the device is too small.
Result<Point> measurePoint(const MeasuredScene& m, const LeakRoom& room, const LightPlace& place,
                           const Configuration& configuration, const PointLimits& limits);

/// Adds how far irradiance is from that of the CPU, rms and at the worst pixel, relative to the
/// CPU's mean. `onCpu`: null if the CPU was not measured.
void addDifference(const ImageF& picture, const ImageF* onCpu, Json& row);

} // namespace limn
