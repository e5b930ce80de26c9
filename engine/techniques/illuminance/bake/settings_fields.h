// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout_rules.h"
#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/bake/settings_defect.h"

namespace limn {

// The fields of a Bake that are not arrays.

template <class A, class B>
void settingsFields(A& a, B& b) {
    auto& s = b.settings;
    using rule::any;
    a("surfels", s.surfels, any), a("links", s.links, any), a("bands", s.bands, any);
    a("rays", s.rays, any), a("lightmapCaches", s.lightmapCaches, any);
    a("texelsPerMetre", s.texelsPerMetre, any), a("placement", s.placement, any);
    a("linker", s.linker, any), a("cut", s.cut, any), a("storage", s.storage, any);
    a("chromaBands", s.chromaBands, any), a("clustering", s.clustering, any);
    a("clusterNormalWeight", s.clusterNormalWeight, any);
    a("clusterBalanceWeight", s.clusterBalanceWeight, any), a("grid", s.grid, any);
    a("maxBounces", s.maxBounces, any);
    // The last of the settings has the rule for all of them.
    a("dimming", s.dimming,
      rule::holds("out of range", [&s](bool) { return settingsDefect(s).empty(); }));
    a("sceneHash", b.sceneHash, any), a("gridSize", b.gridSize, rule::within(0, 256));
    a("gridBounds.lower", b.gridBounds.lower, rule::inReach());
    a("gridBounds.upper", b.gridBounds.upper, rule::inReach());
    auto& c = b.counts; // shown, never computed with
    a("triangles", c.triangles, any), a("surfels", c.surfels, any);
    a("clusters", c.clusters, any), a("caches", c.caches, any);
    a("invalidCaches", c.invalidCaches, any), a("links", c.links, any), a("rays", c.rays, any);
}

template <class A, class B>
void timingFields(A& a, B& b) {
    a.each("stages", b.seconds, rule::any, [&](auto& stage) {
        a("name", stage.first, rule::any), a("seconds", stage.second, rule::within(0, 1e9));
    });
}

} // namespace limn
