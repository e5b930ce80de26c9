// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/radiance_volumes/radiance_volumes.h"
#include "engine/techniques/radiance_volumes/volume_part.h"
#include "tests/trace/simple_scene.h"

#include <memory>

namespace limn {

/// A scene lit by radiance volumes.
struct LitByVolumes {
    Scene scene;
    LightmapLayout layout;
    std::unique_ptr<TraceScene> trace;
    std::unique_ptr<Lighting> lighting = kRadianceVolumesTechnique.light({});

    explicit LitByVolumes(const Scene& lit) : scene(lit), layout(layoutWithoutLightmap(scene)) {
        retrace();
    }
    void retrace() { trace = std::make_unique<TraceScene>(scene); }
    void set(const char* key, double value) {
        scene.technique.settings[std::string("radiance-volumes.") + key] = value;
    }
    LightingReport update(const Viewpoint* view = nullptr, const Progress& progress = {}) {
        return lighting->update({.scene = scene, .trace = trace.get(), .view = view}, progress);
    }
    FieldPoint point(glm::vec3 p, glm::vec3 n) const {
        return {.field = *lighting->field(),
                .layout = layout,
                .scene = scene,
                .instance = 0,
                .triangle = 0,
                .u = 0.3f,
                .v = 0.3f,
                .position = p,
                .normal = n};
    }
    glm::vec3 irradiance(glm::vec3 p, glm::vec3 n) const { return sampleIrradiance(point(p, n)); }
    const VolumePart& part() const {
        return static_cast<const VolumePart&>(*lighting->field()->parts[0]);
    }
};

} // namespace limn
