// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/relight_report.h"

namespace limn {

LightingReport reportOf(const RelightStats& r) {
    LightingReport report;
    report.totalMs = r.totalMs;
    report.bounces = r.bounces;
    report.converged = r.converged;
    report.skipped = r.skipped;
    report.diverges = r.grows;
    report.whole = r.cachesUnseen == 0;
    report.steps = {
        {"direct", "Direct light", "Lights onto the surfels, with shadow rays", r.directMs},
        {"surfel_light", "Surfel light", "Bounced light at the surfels, and what they send on",
         r.surfelLightMs + r.surfelReadMs},
        {"pull", "Pull", "Sums flux up the cluster tree", r.pullMs},
        {"cache_light", "Cache light",
         "Gathers linked clusters into the caches; finds what moved objects occlude",
         r.cacheLightMs + r.occlusionMs},
        {"sources", "Sources",
         "Sum of sources' light that is kept, in place of all other steps but the field, where "
         "only "
         "colours and strengths have changed",
         r.basisMs},
        {"field", "Field", "What the viewport samples, from the caches", r.fieldMs}};
    report.counters = {
        {"passed_on", "Passed on",
         "Share of a bounce's light that the next bounce passes on; below 1, as surfaces reflect "
         "less "
         "than they receive. Known from the third bounce after an edit",
         r.passedOn, CounterUnit::Share},
        {"shadow_rays", "Shadow rays",
         "Of the last call; 0 when no light moved, and on the GPU, which draws shadow maps",
         double(r.shadowRays)},
        {"lights_recomputed", "Lights recomputed",
         "Lights that moved, or past which an object moved; 0 where only their colour or strength "
         "changed",
         double(r.lightsTraced)},
        {"lights_off", "Lights off",
         "Off, black or out of reach of every surface: they cost nothing", double(r.lightsOff)},
        {"links", "Links", "Of the caches that the last call lit, once for each bounce",
         double(r.links)},
        {"links_skipped", "  skipped",
         "Links from senders without light: a black sky or, where the CPU reads cones, unlit "
         "surfaces. The result is unchanged",
         double(r.linksSkipped)},
        {"bands_lit", "Bands lit", "Bands of spherical harmonics that some surface reads",
         double(r.bandsLit)},
        {"bands_skipped", "  skipped",
         "Bands that only glossy reflections would show, where no surface is glossy enough",
         double(r.bandsSkipped)},
        {"grid_skipped", "Grid skipped",
         "Grid cells not lit, because no object is dynamic or without a lightmap",
         double(r.gridCachesSkipped)},
        {"caches_unseen", "Unseen",
         "Caches of the lightmap that the last bounce did not light, because the picture does not "
         "show them; they are lit when the light stands still",
         double(r.cachesUnseen)},
        {"caches_unread", "Unread",
         "Caches of the lightmap that the bounces before the last did not light, because no surfel "
         "reads them",
         double(r.cachesUnread)},
        {"caches_occluded", "Occluded", "Caches whose bounced light dynamic objects occlude",
         double(r.cachesOccluded)},
        {"links_occluded", "  links", "Of those caches", double(r.linksOccluded)},
        {"occlusion_ms", "Occlusion",
         "Time to find what dynamic objects occlude; 0 while they stand still", r.occlusionMs,
         CounterUnit::Milliseconds}};
    report.counters.push_back(
        {"sources_kept", "Sources kept",
         "Lights, emissive materials and skies whose light is known alone: a change of their "
         "colour "
         "or strength needs no bounce. They are found while nothing else is to be done",
         double(r.sourcesKept)});
    if (r.bytes > 0)
        report.counters.push_back({"light_bytes", "Memory of light",
                                   "Beside the bake: radiosity of surfels and clusters, harmonics "
                                   "of caches, direct light, and the field",
                                   double(r.bytes), CounterUnit::Bytes});
    return report;
}

} // namespace limn
