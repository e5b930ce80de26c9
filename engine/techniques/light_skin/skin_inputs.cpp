// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_inputs.h"

namespace limn {

SkinInputs skinInputsOf(const Scene& scene, const Viewpoint* view) {
    SkinInputs now{.surfaces = rsmSurfacesOf(scene),
                   .settings = skinSettingsOf(scene.technique),
                   .sources = rsmSourcesOf(scene)};
    if (view && (!now.settings.all || now.settings.glossy)) {
        now.view = *view;
        now.view->camera.name.clear();
    }
    if (now.isGlossy())
        for (const Material& m : scene.materials)
            now.gloss.push_back({m.roughness, m.metallicRoughnessTexture});
    return now;
}

} // namespace limn
