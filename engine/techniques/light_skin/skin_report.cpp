// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_report.h"

namespace limn {

void describeSkin(const SkinObjects& objects, std::uint64_t bytes, const SkinCost& cost,
                  LightingReport& report) {
    report.steps = {
        {"caches", "Caches", "Caches of new meshes, and those of all objects in the world",
         cost.cacheMs},
        {"shadow_maps", "Reflective shadow maps", "Maps of lights that are out of date",
         cost.mapMs},
        {"importance", "Importance", "What the texels of maps mean to the view", cost.importanceMs},
        {"choice", "Choice", "Texels are chosen by their importance", cost.choiceMs},
        {"gathering", "Gathering", "Caches gather the light of chosen texels", cost.gatherMs},
        {"shade", "Proxy lights", "Proxy lights are placed and shaded by other caches",
         cost.shadeMs}};
    const double caches = objects.caches() ? double(objects.caches()->size()) : 0;
    report.counters = {
        {"caches", "Caches", "Light caches on all objects", caches},
        {"meshes", "Meshes given caches", "Meshes whose caches were made", double(cost.meshes)},
        {"lights_traced", "Lights traced",
         "Lights whose shadow map was cast: they or an object moved", double(cost.traced)},
        {"lights_gathered", "Lights gathered", "Lights whose texels were gathered anew",
         double(cost.gathered)},
        {"shadow_rays", "Rays", "Rays cast for shadow maps and view samples", double(cost.rays)},
        {"bytes", "Memory", "Caches, maps, sums and proxy lights", double(bytes),
         CounterUnit::Bytes}};
}

} // namespace limn
