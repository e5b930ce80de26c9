// SPDX-License-Identifier: MIT
#pragma once

#include "engine/rsm/rsm_inputs.h"
#include "engine/scene/camera.h"
#include "engine/techniques/light_skin/skin_settings.h"

#include <optional>
#include <vector>

namespace limn {

/// How a material reflects the view, as far as caches know it.
struct SkinGloss {
    float roughness;
    TextureRef texture;
    bool operator==(const SkinGloss&) const = default;
};

/// Everything that the light of a scene depends on.
struct SkinInputs {
    RsmSurfaces surfaces;
    std::vector<SkinGloss> gloss; ///< by material; empty where nothing glossy is asked for
    SkinSettings settings;
    std::vector<RsmSource> sources;
    std::optional<Viewpoint> view; ///< none: there is none, or nothing depends on it
    bool operator==(const SkinInputs&) const = default;

    /// Whether caches have glossy proxies.
    bool isGlossy() const { return settings.glossy && view.has_value(); }
    /// For which these are; null where there are none.
    const glm::vec3* eye() const { return isGlossy() ? &view->camera.eye : nullptr; }
};
SkinInputs skinInputsOf(const Scene& scene, const Viewpoint* view);

} // namespace limn
