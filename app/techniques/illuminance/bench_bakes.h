// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/bench.h"
#include "app/bench/spread.h"
#include "app/commands/scene_options.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/trace/trace_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// Scenes, each of which is baked with every combination of the listed settings.
struct BenchBakes {
    SceneOptions common; ///< lights and sky of every scene
    std::vector<std::string> scenes;
    std::vector<std::uint32_t> surfels = {32768}, links = {128}, bands = {3};
    std::vector<std::uint32_t> chromaBands = {0}; ///< 0: as many as bands
    std::vector<std::string> storages = {"rtp", "sh"};
    std::uint32_t rays = 1024, lightmap = 10000;
    glm::uvec3 grid{0}; ///< as BakeSettings::grid; no option sets it
    int threads = 0;    ///< 0: all
};
/// Adds the options to `command`. Returns the option of the scenes, which is required.
Option addBenchBakes(Command& command, BenchBakes& options);

struct BenchBake {
    std::string name; ///< of the scene: its file name without extension
    const Scene& scene;
    const TraceScene& trace; ///< of `scene`
    std::shared_ptr<const Bake> bake;
};

/// Bakes with progress on stderr and calls `measure` for each bake. Stops at the first failure;
/// errors name the scene.
Result<void> forEachBake(const BenchBakes& options,
                         const std::function<Result<void>(const BenchBake&)>& measure);

/// The settings that distinguish rows, in the order of their columns.
Json settingsOf(const BenchBake& baked);

/// Sums up how far the values of a field are from the right ones.
struct FieldDifference {
    double square = 0, difference = 0; ///< of the right values; of both

    void add(const glm::vec4& value, const glm::vec4& right) {
        const glm::vec4 d = value - right;
        square += double(glm::dot(right, right));
        difference += double(glm::dot(d, d));
    }
    /// Root mean square difference, over the root mean square of the right values.
    double nrmse() const { return std::sqrt(difference / std::max(square, 1e-300)); }
};

} // namespace limn
