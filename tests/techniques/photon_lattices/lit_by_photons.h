// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/photon_lattices/lattice_part.h"
#include "engine/techniques/photon_lattices/photon_lattices.h"
#include "engine/techniques/photon_lattices/photon_sources.h"
#include "tests/trace/simple_scene.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace limn {

/// Settings of photon lattices by their keys without "photon-lattices.".
using PhotonChoice = std::map<std::string, double>;

inline TechniqueChoice photonChoice(const PhotonChoice& settings) {
    TechniqueChoice choice{"photon-lattices", {}};
    for (const auto& [key, value] : settings)
        choice.settings["photon-lattices." + key] = value;
    return choice;
}

using PhotonParts = std::vector<std::shared_ptr<const FieldPart>>;
inline bool samePartsOf(const PhotonParts& a, const PhotonParts& b) {
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return x->equals(*y); });
}

/// A scene lit by photon lattices.
struct LitByPhotons {
    Scene scene;
    LightmapLayout layout;
    std::unique_ptr<TraceScene> trace;
    std::unique_ptr<Lighting> lighting = kPhotonTechnique.light({});

    explicit LitByPhotons(Scene s, const PhotonChoice& settings = {})
        : scene(std::move(s)), layout(layoutWithoutLightmap(scene)) {
        scene.technique = photonChoice(settings);
        retrace();
    }
    void retrace() { trace = std::make_unique<TraceScene>(scene); }
    void set(const std::string& key, double value) {
        scene.technique.settings["photon-lattices." + key] = value;
    }
    LightingReport update(const Progress& progress = {}) {
        return lighting->update({.scene = scene, .trace = trace.get()}, progress);
    }
    FieldPoint at(glm::vec3 p, glm::vec3 n) const {
        return {.field = *lighting->field(),
                .layout = layout,
                .scene = scene,
                .instance = 0,
                .triangle = 0,
                .u = 0,
                .v = 0,
                .position = p,
                .normal = n};
    }
    glm::vec3 irradiance(glm::vec3 p, glm::vec3 n) const { return sampleIrradiance(at(p, n)); }
    PhotonScene photons() const { return {*trace, scene, photonSettingsOf(scene.technique).paths}; }
    const PhotonLatticePart& part(PhotonLattice lattice) const {
        return static_cast<const PhotonLatticePart&>(
            *lighting->field()->parts[std::size_t(lattice)]);
    }
    bool sameLight(const LitByPhotons& other) const {
        return samePartsOf(lighting->field()->parts, other.lighting->field()->parts);
    }
};

/// A metal that reflects like a mirror.
inline Material mirror(glm::vec3 base) {
    Material m = simple::lambert(base);
    m.metallic = 1;
    m.roughness = 0;
    return m;
}

} // namespace limn
