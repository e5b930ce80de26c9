// SPDX-License-Identifier: MIT
#include "projects/gltf_writer.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <fstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

namespace limn {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125;

// JSON shows 0.1 for 0.1, and -0 never appears.
double tidy(double value) {
    const double rounded = std::round(value * 1e6) / 1e6;
    return rounded == 0 ? 0 : rounded;
}

template <class V>
Json numbers(const V& v) {
    Json out = Json::array();
    for (int i = 0; i < V::length(); ++i)
        out.push_back(tidy(double(v[i])));
    return out;
}

/// The binary buffer with the views and accessors that describe it.
struct Buffer {
    std::vector<char> bytes;
    Json views = Json::array(), accessors = Json::array();

    template <class T>
    int add(const std::vector<T>& data, int target, Json accessor) {
        while (bytes.size() % 4 != 0)
            bytes.push_back(0);
        const std::size_t offset = bytes.size(), size = data.size() * sizeof(T);
        bytes.resize(offset + size);
        std::memcpy(bytes.data() + offset, data.data(), size);
        views.push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}, {"target", target}});
        accessor["bufferView"] = views.size() - 1;
        accessors.push_back(std::move(accessor));
        return int(accessors.size()) - 1;
    }
};

Json primitive(const Mesh& mesh, Buffer& buffer) {
    assert(!mesh.indices.empty() && mesh.normals.size() == mesh.positions.size());
    glm::vec3 lower = mesh.positions[0], upper = mesh.positions[0];
    for (glm::vec3 p : mesh.positions) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    // The bounds must be the stored floats exactly, so they are not tidied.
    const Json min = {lower.x, lower.y, lower.z}, max = {upper.x, upper.y, upper.z};
    const std::size_t count = mesh.positions.size();
    Json attributes;
    attributes["POSITION"] = buffer.add(mesh.positions, kArrayBuffer,
                                        {{"componentType", kFloat},
                                         {"count", count},
                                         {"type", "VEC3"},
                                         {"min", min},
                                         {"max", max}});
    attributes["NORMAL"] =
        buffer.add(mesh.normals, kArrayBuffer,
                   {{"componentType", kFloat}, {"count", count}, {"type", "VEC3"}});
    if (!mesh.uv0.empty())
        attributes["TEXCOORD_0"] =
            buffer.add(mesh.uv0, kArrayBuffer,
                       {{"componentType", kFloat}, {"count", count}, {"type", "VEC2"}});
    Json indices = {{"componentType", kUint32}, {"count", mesh.indices.size()}, {"type", "SCALAR"}};
    int accessor = 0;
    if (count < 65535) {
        indices["componentType"] = kUint16;
        accessor = buffer.add(std::vector<std::uint16_t>(mesh.indices.begin(), mesh.indices.end()),
                              kElementArrayBuffer, std::move(indices));
    } else {
        accessor = buffer.add(mesh.indices, kElementArrayBuffer, std::move(indices));
    }
    return {{"attributes", attributes}, {"indices", accessor}, {"material", mesh.material}};
}

Json meshesJson(const GltfFile& file, Buffer& buffer) {
    Json out = Json::array();
    for (const Mesh& mesh : file.meshes)
        out.push_back(
            {{"name", mesh.name}, {"primitives", Json::array({primitive(mesh, buffer)})}});
    return out;
}

/// `images` collects the file names in order of first use; texture i shows image i.
Json textureJson(const std::string& file, std::vector<std::string>& images) {
    auto at = std::find(images.begin(), images.end(), file);
    if (at == images.end())
        at = images.insert(images.end(), file);
    return {{"index", at - images.begin()}};
}

Json materialJson(const GltfMaterial& material, std::vector<std::string>& images) {
    Json surface;
    if (material.baseColor != glm::dvec3(1))
        surface["baseColorFactor"] = numbers(glm::dvec4(material.baseColor, 1));
    if (!material.texture.empty())
        surface["baseColorTexture"] = textureJson(material.texture, images);
    surface["metallicFactor"] = material.metallic == 0 ? Json(0) : Json(tidy(material.metallic));
    surface["roughnessFactor"] = tidy(material.roughness);
    Json out = {{"name", material.name}, {"pbrMetallicRoughness", surface}};
    if (material.emissive != glm::dvec3(0)) {
        out["emissiveFactor"] = numbers(material.emissive);
        out["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
            tidy(material.emissiveStrength);
    }
    if (material.transmission > 0)
        out["extensions"]["KHR_materials_transmission"]["transmissionFactor"] =
            tidy(material.transmission);
    if (material.thickness > 0)
        out["extensions"]["KHR_materials_volume"]["thicknessFactor"] = tidy(material.thickness);
    if (!material.emissiveTexture.empty())
        out["emissiveTexture"] = textureJson(material.emissiveTexture, images);
    if (material.alphaMask)
        out["alphaMode"] = "MASK";
    if (material.doubleSided)
        out["doubleSided"] = true;
    return out;
}

Json nodesJson(const GltfFile& file, Json& roots) {
    Json out = Json::array();
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
        const GltfNode& node = file.nodes[i];
        Json json = {{"name", node.name}};
        if (node.translation != glm::dvec3(0))
            json["translation"] = numbers(node.translation);
        if (node.rotation != glm::dvec4(0, 0, 0, 1))
            json["rotation"] = numbers(node.rotation);
        if (node.scale != glm::dvec3(1))
            json["scale"] = numbers(node.scale);
        if (node.mesh >= 0)
            json["mesh"] = node.mesh;
        if (node.camera >= 0)
            json["camera"] = node.camera;
        if (node.sun >= 0)
            json["extensions"]["KHR_lights_punctual"]["light"] = node.sun;
        if (node.spot >= 0)
            json["extensions"]["KHR_lights_punctual"]["light"] =
                file.suns.size() + std::size_t(node.spot);
        if (node.point >= 0)
            json["extensions"]["KHR_lights_punctual"]["light"] =
                file.suns.size() + file.spots.size() + std::size_t(node.point);
        out.push_back(std::move(json));
        assert(node.parent < int(i));
        if (node.parent >= 0)
            out[std::size_t(node.parent)]["children"].push_back(i);
        else
            roots.push_back(i);
    }
    return out;
}

Json camerasJson(const GltfFile& file) {
    Json out = Json::array();
    for (const GltfCamera& camera : file.cameras)
        out.push_back({{"name", camera.name},
                       {"type", "perspective"},
                       {"perspective", {{"yfov", tidy(camera.fovY)}, {"znear", 0.05}}}});
    return out;
}

Json lightsJson(const GltfFile& file) {
    Json out = Json::array();
    for (const GltfSun& sun : file.suns)
        out.push_back({{"name", sun.name},
                       {"type", "directional"},
                       {"color", numbers(sun.color)},
                       {"intensity", tidy(sun.lux)}});
    for (const GltfSpot& spot : file.spots)
        out.push_back({{"name", spot.name},
                       {"type", "spot"},
                       {"color", numbers(spot.color)},
                       {"intensity", tidy(spot.candela)},
                       {"spot",
                        {{"innerConeAngle", tidy(spot.innerAngle)},
                         {"outerConeAngle", tidy(spot.outerAngle)}}}});
    for (const GltfPoint& point : file.points)
        out.push_back({{"name", point.name},
                       {"type", "point"},
                       {"color", numbers(point.color)},
                       {"intensity", tidy(point.candela)}});
    return out;
}

Json texturesJson(const std::vector<std::string>& images, Json& json) {
    Json out = Json::array();
    for (std::size_t i = 0; i < images.size(); ++i) {
        json["images"].push_back({{"uri", images[i]}});
        out.push_back({{"source", i}, {"sampler", 0}});
    }
    json["samplers"] = Json::array({{{"wrapS", 10497}, {"wrapT", 10497}}}); // repeat
    return out;
}

// One line per element of each top-level array: small diffs, readable in a review.
std::string text(const Json& json) {
    std::string out = "{\n";
    for (auto it = json.begin(); it != json.end(); ++it) {
        out += (it == json.begin() ? "" : ",\n") + Json(it.key()).dump() + ": ";
        if (!it.value().is_array()) {
            out += it.value().dump();
            continue;
        }
        for (std::size_t i = 0; i < it.value().size(); ++i)
            out += (i == 0 ? "[\n  " : ",\n  ") + it.value()[i].dump();
        out += "\n]";
    }
    return out + "\n}\n";
}

bool writeFile(const std::string& path, const char* data, std::size_t size) {
    std::ofstream out(path, std::ios::binary);
    out.write(data, std::streamsize(size));
    out.close();
    return out.good();
}

} // namespace

glm::dvec4 lookAlong(glm::dvec3 direction) {
    const glm::dvec3 up = std::abs(direction.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dquat q = glm::quatLookAtRH(direction, up);
    return {q.x, q.y, q.z, q.w};
}

bool writeGltf(const GltfFile& file, const std::string& folder) {
    Buffer buffer;
    Json json, roots = Json::array(), materials = Json::array();
    std::vector<std::string> images;
    json["asset"] = {
        {"version", "2.0"}, {"generator", "limn projects"}, {"copyright", file.copyright}};
    json["extensionsUsed"] = {"KHR_materials_emissive_strength"};
    if (std::ranges::any_of(file.materials, [](const auto& m) { return m.transmission > 0; }))
        json["extensionsUsed"].push_back("KHR_materials_transmission");
    if (std::ranges::any_of(file.materials, [](const auto& m) { return m.thickness > 0; }))
        json["extensionsUsed"].push_back("KHR_materials_volume");
    if (!file.suns.empty() || !file.spots.empty() || !file.points.empty()) {
        json["extensionsUsed"].push_back("KHR_lights_punctual");
        json["extensions"]["KHR_lights_punctual"]["lights"] = lightsJson(file);
    }
    json["scene"] = 0;
    json["scenes"] = Json::array(); // keeps its place; filled once the roots are known
    json["nodes"] = nodesJson(file, roots);
    json["scenes"].push_back({{"name", file.name}, {"nodes", roots}});
    if (!file.cameras.empty())
        json["cameras"] = camerasJson(file);
    for (const GltfMaterial& material : file.materials)
        materials.push_back(materialJson(material, images));
    json["materials"] = materials;
    if (!images.empty())
        json["textures"] = texturesJson(images, json);
    json["meshes"] = meshesJson(file, buffer);
    json["accessors"] = buffer.accessors;
    json["bufferViews"] = buffer.views;
    json["buffers"] =
        Json::array({{{"uri", file.name + ".bin"}, {"byteLength", buffer.bytes.size()}}});
    const std::string main = text(json), stem = folder + "/" + file.name;
    return writeFile(stem + ".gltf", main.data(), main.size()) &&
           writeFile(stem + ".bin", buffer.bytes.data(), buffer.bytes.size());
}

} // namespace limn
