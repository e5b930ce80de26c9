// SPDX-License-Identifier: MIT
#include "editor_ui/document/first_light.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/light_angles.h"
#include "editor_ui/editor_state.h"
#include "engine/scene/mesh/input_hash.h"

#include <algorithm>

namespace limn {

static bool isBlack(const Sky& sky) {
    const glm::vec3 black(0);
    if (sky.showsImage())
        return sky.strength == 0;
    return sky.radiance == black &&
           (sky.kind != SkyKind::Gradient || (sky.horizon == black && sky.ground == black));
}

bool nothingShines(const Scene& scene) {
    return !scene.instances.empty() && isBlack(scene.sky) &&
           std::ranges::none_of(scene.lights, shines) &&
           std::ranges::none_of(scene.instances, [&](const Instance& instance) {
               return emits(scene.materials[instance.material]);
           });
}

void addSunAndSky(EditorState& state) {
    // 4 lx from 53 degrees above and 0.5 nits from everywhere are 4.8 lx on the ground, of which a
    // surface of albedo 0.5 sends 0.76 nits.
    Light sun;
    sun.kind = LightKind::Directional;
    sun.name = "Sun";
    sun.strength = 4;
    sun.position = state.view.camera.target;
    sun.direction = kNewSunDirection;
    Sky sky = singleton<Sky>(state.document);
    if (isBlack(sky)) {
        sky.kind = SkyKind::Color;
        sky.radiance = glm::vec3(0.5f);
    }
    addLightAndSky(state, sun, sky);
}

} // namespace limn
