// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/layout_rules.h"
#include "engine/scene/bake_settings_archive.h"
#include "engine/techniques/illuminance/format/bake.h"

namespace limn {

// The fields of a Bake that are not arrays.

template <class A, class B>
void settingsFields(A& a, B& b) {
    using rule::any;
    bakeSettingsFields(a, b.settings);
    // The place of two settings that no bake depends on. Files keep it; its values are not used.
    std::uint32_t maxBounces = 1000;
    bool dynamicOcclusion = true;
    a("maxBounces", maxBounces, any), a("dimming", dynamicOcclusion, any);
    a("sceneHash", b.sceneHash, rule::holds("after settings that exclude each other", [&b](auto) {
          return settingsDefect(b.settings).empty();
      }));
    a("gridSize", b.gridSize, rule::within(0, 256));
    a("gridBounds.lower", b.gridBounds.lower, rule::inReach());
    a("gridBounds.upper", b.gridBounds.upper, rule::inReach());
    auto& c = b.counts; // shown, never computed with
    a("triangles", c.triangles, any), a("surfels", c.surfels, any);
    a("clusters", c.clusters, any), a("caches", c.caches, any);
    a("invalidCaches", c.invalidCaches, any), a("links", c.links, any), a("rays", c.rays, any);
}

} // namespace limn
