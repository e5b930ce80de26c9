// SPDX-License-Identifier: MIT
#include "app/bake_options.h"

#include "engine/core/hash.h"

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

void addBakeOptions(CLI::App& command, BakeOptions& o) {
    command.add_option("--surfels", o.surfels, "Surfels n_S, 64 to 1048576");
    command.add_option("--links", o.links, "Links per cache n_L, 1 to 4096");
    command.add_option("--bands", o.bands, "SH bands of the caches, 2 to 8");
    command.add_option("--rays", o.rays, "Gather rays per cache, 16 to 65536");
    auto* lightmap =
        command.add_option("--lightmap", o.lightmap, "Wanted number of lightmap caches");
    command
        .add_option("--texels-per-metre", o.texelsPerMetre,
                    "Lightmap density, instead of --lightmap")
        ->excludes(lightmap);
    command.add_option("--grid", o.grid, "Cells of the grid caches, XxYxZ");
    command.add_option("--threads", o.threads, "Threads to use; 0: all")
        ->check(CLI::Range(0, 1024));
}

Result<void> applyBakeOptions(const BakeOptions& o, BakeSettings& s) {
    s.surfels = o.surfels.value_or(s.surfels);
    s.links = o.links.value_or(s.links);
    s.bands = o.bands.value_or(s.bands);
    s.rays = o.rays.value_or(s.rays);
    if (o.lightmap) {
        s.lightmapCaches = *o.lightmap;
        s.texelsPerMetre = 0;
    }
    s.texelsPerMetre = o.texelsPerMetre.value_or(s.texelsPerMetre);
    if (!o.grid.empty()) {
        char rest = 0;
        if (std::sscanf(o.grid.c_str(), "%ux%ux%u%c", &s.grid.x, &s.grid.y, &s.grid.z, &rest) != 3)
            return fail(fmt::format("--grid: \"{}\" is not XxYxZ", o.grid));
    }
    return {};
}

nlohmann::json bakeSummary(const Bake& bake) {
    nlohmann::json seconds;
    double total = 0;
    for (const auto& [stage, s] : bake.seconds) {
        seconds[stage] = s;
        total += s;
    }
    seconds["total"] = total;
    const BakeCounts& c = bake.counts;
    const BakeBytes b = bytesOf(bake);
    return {{"seconds", seconds},
            {"counts",
             {{"triangles", c.triangles},
              {"surfels", c.surfels},
              {"clusters", c.clusters},
              {"caches", c.caches},
              {"invalid_caches", c.invalidCaches},
              {"links", c.links},
              {"rays", c.rays}}},
            {"bytes",
             {{"surfels", b.surfels},
              {"clusters", b.clusters},
              {"links", b.links},
              {"caches", b.caches},
              {"total", b.total()}}},
            {"hash", hexHash(bake.hash())}};
}

} // namespace limn
