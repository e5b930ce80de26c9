// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/volume_report.h"

#include <array>
#include <iterator>

namespace limn {

namespace {

struct GridText {
    const char *id, *label, *tooltip;
};
constexpr std::array<GridText, 4> kGrids = {
    {{"caches_0", "Caches, finest cascade", "Caches in the smallest grid"},
     {"caches_1", "Caches, second cascade", "Caches in the second smallest grid"},
     {"caches_2", "Caches, third cascade", "Caches in the third smallest grid"},
     {"caches_3", "Caches, fourth cascade", "Caches in the largest of four grids"}}};

} // namespace

void describeVolume(const CacheAllocation* caches, const VoxelVolume* voxels,
                    const VolumeCost& cost, LightingReport& report) {
    report.steps = {
        {"shadow_maps", "Reflective shadow maps",
         "Maps of lights that are out of date, and the area lights that are read of them",
         cost.mapMs},
        {"voxels", "Voxels", "Voxels that surfaces touch, and their averages", cost.voxelMs},
        {"allocation", "Allocation", "Caches are placed around what the view shows",
         cost.allocationMs},
        {"caches", "Cache light", "Caches gather the light of all area lights", cost.lightMs}};
    const CacheAllocation none;
    if (!caches)
        caches = &none;
    report.counters = {
        {"caches", "Caches", "Caches in all grids", double(caches->caches())},
        {"caches_dropped", "Caches dropped", "Caches that the view needs beyond their number",
         double(caches->droppedCount)},
        {"pixels_missed", "Pixels missed", "Pixels of the view that find no cache",
         double(caches->missed)},
        {"lights_traced", "Lights traced",
         "Lights whose shadow map was cast: they or an object moved", double(cost.traced)},
        {"voxels", "Voxels", "Voxels that surfaces touch",
         double(voxels ? voxels->solid.count() : 0)}};
    for (std::size_t g = 0; g < caches->ofGrid.size(); ++g)
        report.counters.push_back(
            {kGrids[g].id, kGrids[g].label, kGrids[g].tooltip, double(caches->ofGrid[g])});
}

void describeVolume(const LitVolume& lit, const VolumeCost& cost, LightingReport& report) {
    describeVolume(lit.part ? lit.part->caches.get() : nullptr, lit.voxels.get(), cost, report);
    std::size_t areaLights = 0, bytes = lit.part ? lit.part->bytes() : 0;
    for (const auto& lights : lit.lights) {
        areaLights += lights->count();
        bytes += lights->bytes();
    }
    if (lit.voxels)
        bytes += lit.voxels->bytes();
    const LightingCounter more[] = {
        {"area_lights", "Virtual area lights", "Of all lights", double(areaLights)},
        {"shadow_rays", "Shadow map rays", "Rays cast for shadow maps", double(cost.mapRays)},
        {"view_rays", "View rays", "Rays through pixels that placed caches", double(cost.viewRays)},
        {"cones", "Cones", "Shadow cones that were followed", double(cost.cones)},
        {"bytes", "Memory", "Caches, their addresses, area lights, voxels and maps", double(bytes),
         CounterUnit::Bytes}};
    report.counters.insert(report.counters.end(), std::begin(more), std::end(more));
}

} // namespace limn
