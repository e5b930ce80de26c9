// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/gpu/gpu_relight.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/techniques/illuminance/relight/surfel_light.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"
#include "tests/gpu/test_device.h"
#include "tests/techniques/illuminance/shared_bake.h"
#include "tests/trace/simple_scene.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace limn {

/// What Relighter makes of a scene before it lights anything: the inputs of GpuRelighter.
struct SurfelValues {
    std::vector<glm::vec3> direct, albedo, emitted, sky;

    /// `occluders`: as SurfelInputs::occluders.
    SurfelInputs inputs(const Scene* occluders = nullptr) const {
        SurfelInputs in{direct, albedo, emitted, sky};
        in.occluders = occluders;
        return in;
    }
};

/// What a Relighter's nodes send, without the spare fourth number.
inline std::vector<glm::vec3> radiosityOf(const Relighter& relighter) {
    return {relighter.radiosity().begin(), relighter.radiosity().end()};
}

inline SurfelValues surfelValues(const Bake& bake, const Scene& scene, const TraceScene& trace) {
    SurfelValues out;
    DirectIrradiance light;
    updateDirectIrradiance(bake.surfels, scene, trace, light);
    out.direct = light.irradiance;
    surfelMaterials(bake.surfels, scene, out.albedo, out.emitted);
    out.sky = skyRadiosity(bake.tree, scene.sky);
    return out;
}

/// A court under a coloured sky: walls of three colours, one of which glows, a lamp, and a block
/// that hides caches below and inside it. A dynamic object, a small ball, reads the grid; it
/// occludes nothing.
inline Scene court(const Mesh& object = simple::sphere(0.1f, 0, false, 0)) {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert({0.8f, 0.7f, 0.5f}));
    b.addMaterial(lambert({0.7f, 0.1f, 0.1f}, {0.3f, 0.1f, 0.6f}));
    b.addMaterial(lambert({0.1f, 0.2f, 0.7f}));
    b.add(quad({0, 0, 5}, {4, 0, 0}, {0, 0, -5}, 0)); // floor
    b.add(quad({0, 0, 5}, {0, 0, -5}, {0, 3, 0}, 1)); // looks along +x
    b.add(quad({4, 0, 0}, {0, 0, 5}, {0, 3, 0}, 2));  // looks along -x
    b.add(quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 0));  // looks along +z
    b.add(box({1, 0, 1.5f}, {2.5f, 1.5f, 3.5f}, false, 2));
    b.add(object, glm::mat4(1), true).toWorld[3] = {3.5f, 1, 1, 1};
    Scene scene = b.build();
    scene.relight.dynamicOcclusion = false;
    Light lamp;
    lamp.position = {3, 2, 4};
    lamp.color = {1, 0.6f, 0.2f};
    lamp.strength = 6;
    scene.lights = {lamp};
    scene.sky.radiance = {0.1f, 0.3f, 0.9f};
    scene.bake.surfels = 600;
    scene.bake.lightmapCaches = 400;
    scene.bake.rays = 128;
    scene.bake.links = 48;
    scene.bake.grid = {4, 4, 4};
    return scene;
}

/// A copy, which the test may change, of the bake that the program made of these inputs.
inline std::shared_ptr<Bake> baked(const TraceScene& trace, const BakeSettings& settings) {
    return std::make_shared<Bake>(*sharedBake(trace, settings));
}

inline std::unique_ptr<GpuRelighter> gpuRelighter(gpu::Device& device,
                                                  std::shared_ptr<const Bake> bake) {
    auto made = GpuRelighter::create(device, std::move(bake));
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::move(*made) : nullptr;
}

} // namespace limn
