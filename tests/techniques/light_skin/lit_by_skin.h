// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/light_skin/light_skin.h"
#include "engine/techniques/light_skin/skin_part.h"
#include "engine/trace/trace_scene.h"

#include <memory>

namespace limn {

/// A scene lit by LightSkin.
struct LitBySkin {
    Scene scene;
    LightmapLayout layout;
    std::unique_ptr<TraceScene> trace;
    std::unique_ptr<Lighting> lighting = kLightSkinTechnique.light({});

    explicit LitBySkin(const Scene& of) : scene(of), layout(layoutWithoutLightmap(scene)) {
        retrace();
    }
    void retrace() { trace = std::make_unique<TraceScene>(scene); }
    LightingReport update(const Viewpoint* view = nullptr, const Progress& progress = {}) {
        return lighting->update({.scene = scene, .trace = trace.get(), .view = view}, progress);
    }
    const SkinPart& part() const {
        return static_cast<const SkinPart&>(*lighting->field()->parts.at(0));
    }
    FieldPoint at(glm::vec3 p, glm::vec3 n, std::uint32_t instance = 0) const {
        return {.field = *lighting->field(),
                .layout = layout,
                .scene = scene,
                .instance = instance,
                .triangle = 0,
                .u = 0,
                .v = 0,
                .position = p,
                .normal = n};
    }
    glm::vec3 irradiance(glm::vec3 p, glm::vec3 n, std::uint32_t instance = 0) const {
        return sampleIrradiance(at(p, n, instance));
    }
};

} // namespace limn
