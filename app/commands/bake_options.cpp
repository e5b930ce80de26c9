// SPDX-License-Identifier: MIT
#include "app/commands/bake_options.h"
#include "app/commands/number_range.h"

#include "engine/core/hash.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace limn {

static std::optional<glm::uvec3> gridOf(const std::string& text) {
    glm::uvec3 cells{0};
    char rest = 0;
    if (text.find('-') != std::string::npos ||
        std::sscanf(text.c_str(), "%3ux%3ux%3u%c", &cells.x, &cells.y, &cells.z, &rest) != 3)
        return {};
    for (int c = 0; c < 3; ++c)
        if (cells[c] < 1 || cells[c] > 256)
            return {};
    return cells;
}

/// "draft, medium or high".
static std::string presetNames() {
    std::string names;
    for (const BakePreset& p : kBakePresets)
        names += fmt::format("{}{}",
                             names.empty()                ? ""
                             : &p == &kBakePresets.back() ? " or "
                                                          : ", ",
                             p.name);
    return names;
}

static const BakePreset* presetNamed(const std::string& name) {
    const auto* at = std::ranges::find(kBakePresets, name, &BakePreset::name);
    return at == kBakePresets.end() ? nullptr : at;
}

void addBakeOptions(CLI::App& command, BakeOptions& o) {
    command
        .add_option_function<std::string>(
            "--preset", [&o](const std::string& name) { o.preset = presetNamed(name); },
            "Surfels, links, rays and lightmap caches that go together: " + presetNames() +
                "; other options replace single ones")
        ->check([](const std::string& name) {
            return presetNamed(name) ? "" : fmt::format("\"{}\" is not {}", name, presetNames());
        });
    command.add_option("--surfels", o.surfels, "Surfels n_S")->check(CLI::Range(64, 1 << 20));
    command.add_option("--links", o.links, "Links per cache n_L")->check(CLI::Range(1, 4096));
    command.add_option("--bands", o.bands, "SH bands of the caches")->check(CLI::Range(2, 8));
    command
        .add_option("--chroma-bands", o.chromaBands,
                    "SH bands of the lit caches' chrominance; 0: as many as --bands")
        ->check(CLI::Range(0, 8));
    command.add_option("--rays", o.rays, "Gather rays per cache")->check(CLI::Range(16, 65536));
    auto* lightmap =
        command.add_option("--lightmap", o.lightmap, "Wanted number of lightmap caches")
            ->check(CLI::Range(1, 1 << 24));
    command
        .add_option("--texels-per-metre", o.texelsPerMetre,
                    "Lightmap density, instead of --lightmap")
        ->excludes(lightmap)
        ->check(numberWithin(1e-9, 1e6));
    command.add_option("--grid", o.grid, "Cells of the grid caches, XxYxZ")
        ->check([](const std::string& text) {
            return gridOf(text) ? "" : fmt::format("\"{}\" is not XxYxZ, each 1 to 256", text);
        });
    command.add_option("--placement", o.placement, "Where surfels lie: relaxed, halton or random")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, SurfelPlacement>{{"relaxed", SurfelPlacement::Relaxed},
                                                   {"halton", SurfelPlacement::Halton},
                                                   {"random", SurfelPlacement::Random}}));
    command
        .add_option("--linker", o.linker, "How caches find what they see: gather or form-factor")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Linker>{
            {"gather", Linker::Gather}, {"form-factor", Linker::FormFactor}}));
    command.add_option("--cut", o.cut, "Which clusters caches link: detail or solid-angle")
        ->transform(CLI::CheckedTransformer(std::map<std::string, CutCriterion>{
            {"detail", CutCriterion::Detail}, {"solid-angle", CutCriterion::SolidAngle}}));
    command
        .add_option("--storage", o.storage,
                    "How links are kept: rtp, small, or sh, quicker to light in few bands")
        ->transform(CLI::CheckedTransformer(std::map<std::string, LinkStorage>{
            {"rtp", LinkStorage::Rtp}, {"sh", LinkStorage::Sh}}));
    command.add_option("--clustering", o.clustering, "How surfels are joined: agglomerative or kd")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Clustering>{
            {"agglomerative", Clustering::Agglomerative}, {"kd", Clustering::KdTree}}));
    command
        .add_option("--cluster-normal-weight", o.clusterNormalWeight,
                    "C_n, weight of normals in the clusters' metric")
        ->check(numberWithin(0., 100.));
    command
        .add_option("--cluster-balance-weight", o.clusterBalanceWeight,
                    "C_b, weight of equal areas in it; agglomerative only")
        ->check(numberWithin(0., 100.));
    command.add_option("--threads", o.threads, "Threads to use; 0: all")
        ->check(CLI::Range(0, 1024));
}

void applyBakeOptions(const BakeOptions& o, BakeSettings& s) {
    if (o.preset)
        o.preset->applyTo(s);
    s.surfels = o.surfels.value_or(s.surfels);
    s.links = o.links.value_or(s.links);
    s.bands = o.bands.value_or(s.bands);
    s.chromaBands = o.chromaBands.value_or(s.chromaBands);
    s.rays = o.rays.value_or(s.rays);
    if (o.lightmap) {
        s.lightmapCaches = *o.lightmap;
        s.texelsPerMetre = 0;
    }
    s.texelsPerMetre = o.texelsPerMetre.value_or(s.texelsPerMetre);
    s.placement = o.placement.value_or(s.placement);
    s.linker = o.linker.value_or(s.linker);
    s.cut = o.cut.value_or(s.cut);
    s.storage = o.storage.value_or(s.storage);
    s.clustering = o.clustering.value_or(s.clustering);
    s.clusterNormalWeight = o.clusterNormalWeight.value_or(s.clusterNormalWeight);
    s.clusterBalanceWeight = o.clusterBalanceWeight.value_or(s.clusterBalanceWeight);
    if (!o.grid.empty())
        s.grid = *gridOf(o.grid);
}

nlohmann::json bytesSummary(const BakeBytes& b) {
    return {{"surfels", b.surfels},
            {"clusters", b.clusters},
            {"links", b.links},
            {"caches", b.caches},
            {"total", b.total()}};
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
    return {{"seconds", seconds},
            {"counts",
             {{"triangles", c.triangles},
              {"surfels", c.surfels},
              {"clusters", c.clusters},
              {"caches", c.caches},
              {"invalid_caches", c.invalidCaches},
              {"links", c.links},
              {"rays", c.rays}}},
            {"bytes", bytesSummary(bytesOf(bake))},
            {"notes", bake.notes},
            {"hash", hexHash(bake.hash())}};
}

} // namespace limn
