// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/case_file.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/files/project_file.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const std::vector<glm::vec3>& points) {
    Json out = Json::array();
    for (const glm::vec3 p : points)
        for (int c = 0; c < 3; ++c)
            out.push_back(p[c]);
    return out;
}

std::vector<glm::vec3> pointsOf(const Json& json) {
    std::vector<glm::vec3> points(json.size() / 3);
    for (std::size_t i = 0; i < 3 * points.size(); ++i)
        points[i / 3][int(i % 3)] = json[i].get<float>();
    return points;
}

} // namespace

Result<void> writeCase(const std::string& path, const StressCase& c) {
    Json json = {{"seed", c.seed}, {"description", c.description}};
    json["document"] = Json::parse(documentToJson(c.document));
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
    try {
        const Json json = Json::parse(*text);
        StressCase c;
        c.seed = json.at("seed").get<std::uint64_t>();
        c.description = json.value("description", "");
        Result<Document> document = documentFromJson(json.at("document").dump());
        if (!document)
            return fail(fmt::format("{}: {}", path, document.error().message));
        c.document = std::move(*document);
        const auto assets = std::make_shared<Assets>();
        for (const Json& m : json.value("meshes", Json::array())) {
            Mesh mesh;
            mesh.material = m.at("material").get<std::uint32_t>();
            mesh.positions = pointsOf(m.at("positions"));
            mesh.normals = pointsOf(m.at("normals"));
            mesh.indices = m.at("indices").get<std::vector<std::uint32_t>>();
            for (const std::uint32_t i : mesh.indices)
                if (i >= mesh.positions.size() || mesh.normals.size() != mesh.positions.size() ||
                    mesh.indices.size() % 3 != 0)
                    return fail(path + ": a mesh names vertices that it does not have");
            assets->meshes.push_back(std::move(mesh));
        }
        c.assets = assets;
        return c;
    } catch (const Json::exception& e) {
        return fail(fmt::format("{}: {}", path, e.what()));
    }
}

} // namespace limn
