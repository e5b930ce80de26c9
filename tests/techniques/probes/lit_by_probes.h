// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/techniques/probes/probes.h"
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

inline Light pointLight(glm::vec3 at, float candela) {
    Light light;
    light.position = at;
    light.strength = candela;
    return light;
}

/// A room with a block, lit by two lamps.
inline Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
    b.scene.lights = {pointLight({2, 2.5f, 2}, 5), pointLight({3, 1, 4}, 2)};
    return b.build();
}

} // namespace limn
