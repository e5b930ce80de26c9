// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/lighting/lighting_report.h"
#include "engine/lighting/overlay_source.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace limn {

/// Duration of each stage of a precomputation in order [s].
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// What a precomputation did and what it made, as printed by the statistics panel and --json.
struct PrecomputedReport {
    std::vector<LightingCounter> counts;
    std::vector<LightingCounter> bytes; ///< memory that updates read, part by part [bytes]
    StageSeconds seconds;
    std::vector<std::string> keptStages; ///< of them: found in the store rather than computed
    std::vector<std::string> notes;      ///< what was recomputed and why
};

/// What a precomputation and the updates of its light cost.
struct PrecomputedCost {
    StageSeconds seconds;             ///< of every stage, computed anew
    double bytes = 0;                 ///< memory that updates read
    std::vector<LightingStep> update; ///< steps of one update of one bounce on the CPU with all
                                      ///< lights moved; empty: not known
    double updateMs = 0;              ///< of that update
};

/// Sum of the counters' values.
inline double totalOf(const std::vector<LightingCounter>& counters) {
    double total = 0;
    for (const LightingCounter& counter : counters)
        total += counter.value;
    return total;
}

/// Sum of the stages' durations [s].
inline double totalOf(const StageSeconds& seconds) {
    double total = 0;
    for (const auto& [stage, s] : seconds)
        total += s;
    return total;
}

/// Estimate of a precomputation, made before it starts.
struct Prediction {
    std::uint64_t caches = 0;           ///< number of places that gather light
    std::uint64_t minTexels = 0;        ///< needed, where more than were asked for; else 0
    std::vector<LightingCounter> bytes; ///< as PrecomputedReport::bytes
    std::uint64_t file = 0;             ///< size of its file [bytes]
    std::uint64_t working = 0; ///< peak memory while it runs and is written, besides the scene
                               ///< [bytes]
};

/// What a technique computed of a scene in advance, so that its light can follow changes of lights,
/// materials, sky and dynamic objects. Immutable.
class Precomputed : public OverlaySource {
public:
    /// The settings that it was made with.
    virtual const BakeSettings& settings() const = 0;
    /// Precomputation::inputHash() of the scene that it was made from.
    virtual std::uint64_t inputHash() const = 0;
    /// Hash of the content; equal for equal documents, whatever the stage store held.
    virtual std::uint64_t hash() const = 0;
    /// The lightmap that the light is computed for.
    virtual const LightmapLayout& layout() const = 0;
    /// Cells along the axes of the grid that the light is computed for; 0: none.
    virtual glm::uvec3 gridSize() const = 0;
    virtual PrecomputedReport report() const = 0;

    /// Names the size on which the time of an update depends, coarsely: "links 4^12". Measured
    /// times are remembered by it.
    virtual std::string sizeClass() const = 0;
    /// Expected cost with other settings for the scene that this was made from, where this cost
    /// `measured` on the same machine. `limn bench predict` compares such predictions with what is
    /// then measured.
    virtual PrecomputedCost expectedCost(const Scene& scene, const BakeSettings& wanted,
                                         const PrecomputedCost& measured) const = 0;

    /// Describes the first defect that makes it unsafe to light `scene` with it; empty: none.
    virtual std::string defect(const Scene& scene) const = 0;
    /// Writes a file that Precomputation::read() reads.
    virtual Result<void> write(const std::string& path) const = 0;
};

/// Precomputed data with the scene that it was made from. Both are null where a technique
/// precomputes nothing.
struct Prepared {
    std::shared_ptr<const Precomputed> data;
    std::shared_ptr<const Scene> scene;
};

} // namespace limn
