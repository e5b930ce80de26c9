// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/illuminance_program.h"

#include "app/commands/bake_options.h"

#include "engine/core/hash.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/format/bake_bytes.h"
#include "engine/techniques/illuminance/format/surfel_spacing.h"
#include "engine/techniques/illuminance/format/tree_shape.h"
#include "engine/techniques/illuminance/illuminance.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn {

// Memory of the bake's links and of the whole bake in either storage, as Table 4 of Jendersie,
// Kuri, Grosch. Real-Time Global Illumination Using Precomputed Illuminance Composition with
// Chrominance Compression. 2016
static Json storageTable(const Bake& bake) {
    Json table = Json::array();
    for (std::uint32_t bands = 2; bands <= 8; ++bands) {
        const BakeBytes rtp = bytesOf(bake, LinkStorage::Rtp, bands),
                        sh = bytesOf(bake, LinkStorage::Sh, bands);
        table.push_back({{"bands", bands},
                         {"rtp_links", rtp.links},
                         {"sh_links", sh.links},
                         {"rtp_total", rtp.total()},
                         {"sh_total", sh.total()}});
    }
    return table;
}

static Json describeBake(const Precomputed& data) {
    const Bake& bake = *bakeOf(data);
    Json json;
    json["kind"] = "bake";
    const BakeSettings& s = bake.settings;
    json["settings"] = settingsJson(s);
    json["settings"]["chroma_bands"] = chromaBandsOf(s);
    json["settings"]["grid"] = {bake.gridSize.x, bake.gridSize.y, bake.gridSize.z};
    const LightmapLayout& map = bake.lightmap;
    json["lightmap"] = {{"width", map.width},
                        {"height", map.height},
                        {"utilisation", double(bake.caches.lightmapCount) /
                                            std::max(1., double(map.width) * double(map.height))}};
    const SurfelSpacing spacing = surfelSpacing(bake.surfels);
    json["spacing"] = {{"mean", spacing.mean}, {"spread", spacing.spread}};
    const TreeShape tree = treeShapeOf(bake.tree);
    json["tree"] = {
        {"most_depth", tree.maxDepth}, {"mean_depth", tree.meanDepth}, {"balance", tree.balance}};
    json["input"] = hexHash(bake.sceneHash);
    const Json summary = bakeSummary(data);
    for (const auto& [key, value] : summary.members())
        json[key] = value;
    json["storage_bytes"] = storageTable(bake);
    return json;
}

static void printStorageTable(const Json& table) {
    fmt::print("\n{:>5} {:>15} {:>14} {:>15} {:>14}\n", "bands", "RTP links [MiB]",
               "SH links [MiB]", "RTP total [MiB]", "SH total [MiB]");
    const auto mib = [](const Json& bytes) {
        return double(bytes.get<std::uint64_t>()) / (1 << 20);
    };
    for (const Json& row : table)
        fmt::print("{:>5} {:>15.2f} {:>14.2f} {:>15.2f} {:>14.2f}\n", row["bands"].dump(),
                   mib(row["rtp_links"]), mib(row["sh_links"]), mib(row["rtp_total"]),
                   mib(row["sh_total"]));
}

static bool print(const std::string& key, const Json& value) {
    if (key != "storage_bytes")
        return false;
    printStorageTable(value);
    return true;
}

static void addBenches(Command& bench) {
    addEditsBench(bench);
    addEnergyBench(bench);
    addErrorBench(bench);
    addGlossyBench(bench);
    addLinksBench(bench);
    addPredictBench(bench);
    addRegressionBench(bench);
    addRelightBench(bench);
    addSkipBench(bench);
    addStressBench(bench);
    addFrameBench(bench);
    addFrontBench(bench);
}

constinit const TechniqueProgram kIlluminanceProgram = {.technique = &kIlluminanceTechnique,
                                                        .describe = describeBake,
                                                        .print = print,
                                                        .addBenches = addBenches,
                                                        .experiments = illuminanceExperiments};

} // namespace limn
