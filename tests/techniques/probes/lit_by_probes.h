// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/techniques/probes/probes.h"
#include "tests/techniques/room_with_lamps.h"
#include "tests/trace/simple_scene.h"

#include <map>
#include <memory>
#include <string>

namespace limn {

/// A scene that probes light.
struct LitByProbes {
    Scene scene;
    std::shared_ptr<const TraceScene> trace;
    std::unique_ptr<Lighting> lighting = kProbesTechnique.light({});

    explicit LitByProbes(Scene s, std::map<std::string, double> settings = {})
        : scene(std::move(s)) {
        settings.try_emplace("probes.side", 24);
        scene.technique = {"probes", std::move(settings)};
        trace = std::make_shared<const TraceScene>(scene);
    }
    LightingReport update(std::uint32_t bounces = 64) {
        return lighting->update({.scene = scene, .trace = trace.get(), .bounces = bounces}, {});
    }
    glm::vec3 irradiance(glm::vec3 p, glm::vec3 n) const {
        return sampleIrradiance({*lighting->field(), {}, scene, 0, 0, 0, 0, p, n});
    }
};

} // namespace limn
