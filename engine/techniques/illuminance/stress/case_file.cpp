// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/case_file.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/files/project_file.h"
#include "engine/json/json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

Json jsonOf(const std::vector<glm::vec3>& points) {
    Json out = Json::array();
    for (const glm::vec3 p : points)
        for (int c = 0; c < 3; ++c)
            out.push_back(p[c]);
    return out;
}

/// Points, three numbers each; what is no number counts as NaN, which no mesh has.
std::vector<glm::vec3> pointsOf(const Json& json) {
    std::vector<glm::vec3> points(json.size() / 3);
    for (std::size_t i = 0; i < 3 * points.size(); ++i)
        points[i / 3][int(i % 3)] =
            json[i].isNumber() ? json[i].get<float>() : std::numeric_limits<float>::quiet_NaN();
    return points;
}

bool isFinite(const std::vector<glm::vec3>& points) {
    return std::ranges::all_of(points, [](glm::vec3 p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

/// Fails where a field is missing or has the wrong type, or where an index leads to no vertex.
Result<Mesh> meshOf(const Json& json) {
    Mesh mesh;
    const auto material = json["material"].integerWithin<std::uint32_t>();
    mesh.positions = pointsOf(json["positions"]);
    mesh.normals = pointsOf(json["normals"]);
    for (const Json& index : json["indices"])
        mesh.indices.push_back(index.integerWithin<std::uint32_t>().value_or(~0U));
    if (!material || !isFinite(mesh.positions) || !isFinite(mesh.normals))
        return fail("a mesh lacks its material, or has vertices that are not numbers");
    mesh.material = *material;
    const bool exist = std::ranges::all_of(
        mesh.indices, [&](std::uint32_t index) { return index < mesh.positions.size(); });
    if (!exist || mesh.normals.size() != mesh.positions.size() || mesh.indices.size() % 3 != 0)
        return fail("a mesh names vertices that it does not have");
    return mesh;
}

} // namespace

Result<void> writeCase(const std::string& path, const StressCase& c) {
    Json json = {{"seed", c.seed}, {"description", c.description}};
    json["document"] = *parseJson(documentToJson(c.document));
    for (const Mesh& m : c.assets->meshes)
        json["meshes"].push_back({{"material", m.material},
                                  {"positions", jsonOf(m.positions)},
                                  {"normals", jsonOf(m.normals)},
                                  {"indices", m.indices}});
    return replaceFile(path, json.dump() + "\n");
}

Result<StressCase> readCase(const std::string& path) {
    const Result<std::string> text = readFile(path);
    if (!text)
        return fail(fmt::format("{}: {}", path, text.error().message));
    const Result<Json> json = parseJson(*text);
    if (!json)
        return fail(fmt::format("{}: {}", path, json.error().message));
    StressCase c;
    const auto seed = (*json)["seed"].integerWithin<std::uint64_t>();
    if (!seed)
        return fail(path + ": seed: not an integer >= 0");
    c.seed = *seed;
    if (const Json& description = (*json)["description"]; description.isString())
        c.description = description.get<std::string>();
    Result<Document> document = documentFromJson((*json)["document"].dump());
    if (!document)
        return fail(fmt::format("{}: {}", path, document.error().message));
    c.document = std::move(*document);
    const auto assets = std::make_shared<Assets>();
    for (const Json& entry : (*json)["meshes"]) {
        Result<Mesh> mesh = meshOf(entry);
        if (!mesh)
            return fail(fmt::format("{}: {}", path, mesh.error().message));
        assets->meshes.push_back(std::move(*mesh));
    }
    c.assets = assets;
    return c;
}

} // namespace limn
