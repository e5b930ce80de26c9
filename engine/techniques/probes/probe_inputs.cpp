// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_inputs.h"

#include "engine/math/sh.h"
#include "engine/scene/light/unit_light.h"
#include "engine/scene/surface/receiver_bands.h"

#include <algorithm>

namespace limn {

/// Bounds that moving objects do not change, if anything stands still.
static Bounds boundsOf(const Scene& scene) {
    const bool anyStatic =
        std::ranges::any_of(scene.instances, [](const Instance& i) { return !i.dynamic; });
    return anyStatic ? staticBounds(scene) : scene.bounds;
}

ProbeInputs inputsOf(const Scene& scene, const ProbeSettings& settings, const ProbeInputs& before) {
    ProbeInputs in{.grid = chooseProbes(boundsOf(scene), settings.count),
                   .side = settings.side,
                   .assets = scene.assets,
                   .materials = scene.materials,
                   .sky = scene.sky};
    for (const Instance& instance : scene.instances) {
        const Material& material = scene.materialOf(instance);
        ProbeSurface surface{
            .mesh = instance.mesh, .toWorld = instance.toWorld, .twoSided = isTwoSided(material)};
        if (isCutout(material)) {
            surface.cutoff = alphaCutoff(material);
            surface.alpha = material.baseColor.a;
            surface.holes = material.baseColorTexture;
        }
        in.surfaces.push_back(surface);
        in.materialOf.push_back(instance.material);
    }
    for (const Light& light : scene.lights) {
        in.shining.push_back(shines(light) ? 1 : 0);
        in.lights.push_back(unitLight(light));
    }
    const bool same = in.assets == before.assets && in.materials == before.materials &&
                      in.materialOf == before.materialOf;
    in.glossy = same ? before.glossy : receiverBands(scene, kMaxBands) > kIrradianceBands;
    return in;
}

bool sameLattice(const ProbeInputs& a, const ProbeInputs& b) {
    return a.grid == b.grid && a.side == b.side;
}

bool sameSurfaces(const ProbeInputs& a, const ProbeInputs& b) {
    return sameLattice(a, b) && a.assets == b.assets && a.surfaces == b.surfaces;
}

} // namespace limn
