// SPDX-License-Identifier: MIT
#include "app/techniques/sparse_probes/sparse_probes_program.h"

#include "app/commands/bake_options.h"

#include "engine/core/hash.h"
#include "engine/techniques/sparse_probes/sparse_probes.h"

namespace limn {

static Json describeProbes(const Precomputed& data) {
    Json json;
    json["kind"] = "sparse probes";
    json["settings"] = settingsJson(data.settings());
    json["lightmap"] = {{"width", data.layout().width}, {"height", data.layout().height}};
    json["input"] = hexHash(data.inputHash());
    const Json summary = bakeSummary(data);
    for (const auto& [key, value] : summary.members())
        json[key] = value;
    return json;
}

constinit const TechniqueProgram kSparseProbesProgram = {
    .technique = &kSparseProbesTechnique,
    .describe = describeProbes,
    .print = [](const std::string&, const Json&) { return false; },
    .addBenches = [](Command&) {}};

} // namespace limn
