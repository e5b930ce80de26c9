// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/describe_transport.h"
#include "app/commands/scene_options.h"
#include "app/techniques/technique_program.h"

#include "engine/core/hash.h"
#include "engine/export/vector_json.h"
#include "engine/files/document_fields.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "engine/json/json.h"
#include "engine/scene/dark_backs.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/origin.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace limn {

static std::uint64_t bytesOf(const Mesh& mesh) {
    const auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
    std::uint64_t further = 0;
    for (const std::vector<glm::vec2>& uv : mesh.furtherUv)
        further += bytes(uv);
    return further + bytes(mesh.positions) + bytes(mesh.normals) + bytes(mesh.tangents) +
           bytes(mesh.uv0) + bytes(mesh.uv1) + bytes(mesh.colors) + bytes(mesh.indices);
}

/// What bakes leave out: instances whose backs face sealed dark space, and the share of these backs
/// in the area of all lit sides.
static Json describeDarkBacks(Scene scene) {
    leaveOutDarkBacks(scene);
    std::uint64_t instances = 0;
    double dark = 0, all = 0;
    for (const Instance& i : scene.instances) {
        if (i.dynamic)
            continue;
        const double area = worldArea(scene, i);
        instances += i.darkBacks;
        dark += i.darkBacks ? area : 0;
        all += isTwoSided(scene.materialOf(i)) ? 2 * area : area;
    }
    return {{"instances", instances}, {"share", all > 0 ? dark / all : 0}};
}

static Json describe(const ImportedScene& imported) {
    const Scene scene = flatten(imported.document, imported.assets);
    std::uint64_t triangles = 0, vertices = 0, geometry = 0, images = 0, nodes = 0;
    for (const Instance& instance : scene.instances)
        triangles += scene.meshOf(instance).triangleCount();
    for (const Mesh& mesh : imported.assets->meshes) {
        vertices += mesh.positions.size();
        geometry += bytesOf(mesh);
    }
    for (const Image& image : imported.assets->images)
        images += image.rgba.size();
    for (const auto& [id, object] : imported.document.objects)
        nodes += std::holds_alternative<Node>(object);
    Json json;
    json["kind"] = "scene";
    json["scene"] = imported.document.scenePath;
    json["hash"] = hexHash(imported.document.sceneHash);
    json["nodes"] = nodes;
    json["instances"] = scene.instances.size();
    json["meshes"] = imported.assets->meshes.size();
    json["triangles"] = triangles; // as instanced
    json["vertices"] = vertices;
    json["materials"] = scene.materials.size();
    json["images"] = imported.assets->images.size();
    json["lights"] = scene.lights.size();
    json["cameras"] = scene.cameras.size();
    json["bounds"] = {{"lower", vectorJson(toFile(scene.origin, scene.bounds.lower))},
                      {"upper", vectorJson(toFile(scene.origin, scene.bounds.upper))}};
    json["bytes"] = {{"geometry", geometry}, {"images", images}, {"total", geometry + images}};
    json["dark_backs"] = describeDarkBacks(scene);
    json["repairs"] = imported.repairs;
    return json;
}

static Json describe(const ImageF& image) {
    std::uint64_t invalid = 0;
    float minimum = image.rgb[0].x, maximum = minimum;
    double sum = 0;
    for (const glm::vec3& p : image.rgb)
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(p[c])) {
                ++invalid;
                continue;
            }
            minimum = std::min(minimum, p[c]);
            maximum = std::max(maximum, p[c]);
            sum += double(p[c]);
        }
    Json json;
    json["kind"] = "float image";
    json["width"] = image.width;
    json["height"] = image.height;
    json["minimum"] = minimum;
    json["maximum"] = maximum;
    json["mean"] = sum / double(std::max<std::uint64_t>(image.rgb.size() * 3 - invalid, 1));
    json["invalid_numbers"] = invalid;
    return json;
}

static Json describe(const Image& image) {
    Json json;
    json["kind"] = "image";
    json["width"] = image.width;
    json["height"] = image.height;
    return json;
}

template <class T>
static Result<Json> describeResult(const Result<T>& read) {
    if (!read)
        return tl::make_unexpected(read.error());
    return describe(*read);
}

/// Describes a file according to its extension; files without one of our extensions are opened as
/// scenes.
static Result<Json> describeFile(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension == ".exr" || extension == ".hdr")
        return describeResult(readFloatImage(file));
    if (extension == ".png")
        return describeResult(readPng(file));
    if (extension == ".limnbake") {
        const auto read = readPrecomputed(file);
        return read ? Result<Json>(programOf((*read)->technique()).describe(**read))
                    : tl::make_unexpected(read.error());
    }
    if (extension == ".limnrt")
        return describeTransport(file);
    return describeResult(openAny(file, projectsFolder()));
}

static std::string valueText(const Json& value) {
    return value.isString() ? value.get<std::string>() : value.dump();
}

static void printForPeople(const Json& json) {
    for (const auto& [key, value] : json.members()) {
        if (std::ranges::any_of(techniquePrograms(), [&](const TechniqueProgram* program) {
                return program->print(key, value);
            }))
            continue;
        if (value.isObject()) {
            for (const auto& [inner, number] : value.members())
                fmt::print("{:<12} {} {}\n", key, inner, valueText(number));
        } else if (value.isArray()) {
            for (const Json& line : value)
                fmt::print("{:<12} {}\n", key, valueText(line));
        } else {
            fmt::print("{:<12} {}\n", key, valueText(value));
        }
    }
}

void addInfoCommand(Command& app) {
    struct Options {
        std::string file;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    Command command =
        app.addCommand("info", "Print what a scene, project, bake, transport or image contains");
    command.option("file", options->file, "File, or name of a sample project").required();
    command.flag("--json", options->json, "Print one JSON object to stdout");
    command.onRun([options] {
        const Result<Json> json = describeFile(options->file);
        if (!json)
            return failed(json.error().message);
        if (options->json)
            fmt::print("{}\n", json->dump());
        else
            printForPeople(*json);
        return Exit::Done;
    });
}

} // namespace limn
