// SPDX-License-Identifier: MIT
#include "app/commands/describe_transport.h"

#include "engine/core/read_file.h"
#include "engine/runtime/transport_view.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn {

static Json describe(const runtime::TransportView& view, std::uint64_t fileBytes) {
    const runtime::Dims& d = view.dims;
    Json json, sections = Json::object();
    for (std::uint32_t k = 0; k < view.sectionCount; ++k)
        sections[std::string(view.sections[k].tag, 4)] = view.sections[k].bytes;
    json["kind"] = "transport";
    json["version"] = fmt::format("{}.{}", runtime::kMajor, view.minor);
    json["surfels"] = d.surfels;
    json["light_points"] = d.lightPoints;
    json["sky_cells"] = d.skyCells;
    json["caches"] = d.caches;
    json["lightmap_caches"] = d.lightmapCaches;
    json["links"] = d.links;
    json["bands"] = d.bands;
    json["chroma_bands"] = d.chromaBands;
    json["materials"] = d.materials;
    json["lights"] = d.lights;
    json["triangles"] = d.triangles;
    json["lightmap"] = {{"width", d.lightmapWidth}, {"height", d.lightmapHeight}};
    json["grid"] = {{"x", d.grid[0]}, {"y", d.grid[1]}, {"z", d.grid[2]}};
    json["bytes"] = std::move(sections);
    json["bytes"]["total"] = fileBytes;
    return json;
}

Result<Json> describeTransport(const std::string& file) {
    Result<std::string> bytes = readFile(file);
    if (!bytes)
        return fail(fmt::format("{}: {}", file, bytes.error().message));
    bytes->reserve(64); // short strings are not aligned as the view wants its bytes
    char why[256] = {};
    runtime::TransportView view{};
    if (!viewTransport(bytes->data(), bytes->size(), false, view, {why, sizeof why}))
        return fail(fmt::format("{}: {}", file, why));
    return describe(view, bytes->size());
}

} // namespace limn
