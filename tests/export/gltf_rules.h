// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

/// Checks a glTF file among its siblings against rules of the specification of glTF 2.0 that a
/// writer can break. Returns what is wrong, in words.
class GltfRules {
public:
    static std::vector<std::string> problems(const std::vector<ExportFile>& files,
                                             const std::string& name) {
        GltfRules rules(files);
        rules.check(rules.m_files.at(name));
        return rules.m_problems;
    }

private:
    using Json = nlohmann::json;

    explicit GltfRules(const std::vector<ExportFile>& files) {
        for (const ExportFile& file : files)
            m_files[file.name] = file.bytes;
    }

    void require(bool holds, const std::string& problem) {
        if (!holds)
            m_problems.push_back(problem);
    }

    /// An index into the array `where` of the file.
    void index(const Json& value, const char* where) {
        const bool valid = value.is_number_unsigned() && m_gltf.contains(where) &&
                           value.get<std::size_t>() < m_gltf[where].size();
        require(valid, fmt::format("{} is no index of {}", value.dump(), where));
    }

    void check(const std::string& text) {
        m_gltf = Json::parse(text);
        require(m_gltf["asset"]["version"] == "2.0", "asset.version");
        for (const auto& [key, value] : m_gltf.items())
            require(!value.is_array() || !value.empty(), key + " is an empty array");
        for (const auto& buffer : m_gltf["buffers"]) {
            const std::string uri = buffer["uri"];
            require(m_files.contains(uri), uri + " is not exported");
            m_buffers.push_back(m_files[uri]);
            require(buffer["byteLength"] == m_buffers.back().size(), "byteLength of " + uri);
        }
        for (const auto& image : m_gltf.value("images", Json::array()))
            checkImage(image);
        for (const auto& accessor : m_gltf["accessors"])
            checkAccessor(accessor);
        for (const auto& mesh : m_gltf["meshes"])
            for (const auto& primitive : mesh["primitives"])
                checkPrimitive(primitive);
        checkNodes();
        checkExtensions();
    }

    void checkImage(const Json& image) {
        if (image.contains("uri")) {
            require(m_files.contains(image["uri"]), image["uri"].dump() + " is not exported");
            return;
        }
        index(image["bufferView"], "bufferViews");
        require(image["mimeType"] == "image/png", "an image in a buffer has no type");
        const Json& view = m_gltf["bufferViews"].at(image["bufferView"].get<std::size_t>());
        index(view["buffer"], "buffers");
        const std::string& buffer = m_buffers.at(view["buffer"].get<std::size_t>());
        const auto begin = view["byteOffset"].get<std::size_t>();
        require(begin + view["byteLength"].get<std::size_t>() <= buffer.size(),
                "an image leaves its buffer");
        require(buffer.compare(begin, 4, "\x89PNG") == 0, "an image is no PNG");
    }

    void checkAccessor(const Json& accessor) {
        index(accessor["bufferView"], "bufferViews");
        const Json& view = m_gltf["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
        index(view["buffer"], "buffers");
        const std::size_t component = accessor["componentType"] == 5123 ? 2 : 4;
        const std::map<std::string, std::size_t> types = {
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
        const std::size_t offset =
            view.value("byteOffset", std::size_t(0)) + accessor.value("byteOffset", std::size_t(0));
        const std::size_t bytes =
            accessor["count"].get<std::size_t>() * component * types.at(accessor["type"]);
        require(accessor["count"] > 0, "an accessor of nothing");
        require(offset % component == 0, "an accessor is not aligned");
        require(accessor.value("byteOffset", std::size_t(0)) + bytes <= view["byteLength"],
                "an accessor leaves its buffer view");
        require(view.value("byteOffset", std::size_t(0)) + view["byteLength"].get<std::size_t>() <=
                    m_buffers.at(view["buffer"].get<std::size_t>()).size(),
                "a buffer view leaves its buffer");
    }

    template <class T>
    std::vector<T> read(const Json& accessor, std::size_t components) {
        const Json& view = m_gltf["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
        std::vector<T> values(accessor["count"].get<std::size_t>() * components);
        const std::size_t offset =
            view.value("byteOffset", std::size_t(0)) + accessor.value("byteOffset", std::size_t(0));
        const std::string& buffer = m_buffers.at(view["buffer"].get<std::size_t>());
        if (offset + values.size() * sizeof(T) <= buffer.size())
            std::memcpy(values.data(), buffer.data() + offset, values.size() * sizeof(T));
        return values;
    }

    void checkPrimitive(const Json& primitive) {
        std::set<std::size_t> counts;
        for (const auto& [name, number] : primitive["attributes"].items()) {
            index(number, "accessors");
            const Json& accessor = m_gltf["accessors"].at(number.get<std::size_t>());
            counts.insert(accessor["count"].get<std::size_t>());
            require(accessor["componentType"] == 5126, name + " is not of floats");
            if (name == "TEXCOORD_1")
                for (const float v : read<float>(accessor, 2))
                    require(v >= 0 && v <= 1, fmt::format("lightmap coordinate {}", v));
            if (name == "POSITION")
                checkBounds(accessor);
        }
        for (int set = 1; set < 4; ++set)
            require(!primitive["attributes"].contains(fmt::format("TEXCOORD_{}", set)) ||
                        primitive["attributes"].contains(fmt::format("TEXCOORD_{}", set - 1)),
                    "sets of texture coordinates are not numbered without gaps");
        require(counts.size() == 1, "attributes of a primitive differ in length");
        require(primitive["attributes"].contains("POSITION"), "a primitive without positions");
        index(primitive["indices"], "accessors");
        index(primitive["material"], "materials");
        const Json& accessor = m_gltf["accessors"].at(primitive["indices"].get<std::size_t>());
        require(accessor["count"].get<std::size_t>() % 3 == 0, "indices are not of triangles");
        std::vector<std::uint32_t> indices;
        if (accessor["componentType"] == 5123)
            for (const std::uint16_t i : read<std::uint16_t>(accessor, 1))
                indices.push_back(i);
        else
            indices = read<std::uint32_t>(accessor, 1);
        const std::uint32_t restart = accessor["componentType"] == 5123 ? 0xffff : 0xffffffff;
        for (const std::uint32_t i : indices)
            require(i < *counts.begin() && i != restart, fmt::format("vertex {}", i));
    }

    void checkBounds(const Json& accessor) {
        const std::vector<float> positions = read<float>(accessor, 3);
        for (std::size_t a = 0; a < 3; ++a) {
            float lower = positions[a], upper = positions[a];
            for (std::size_t i = a; i < positions.size(); i += 3) {
                lower = std::min(lower, positions[i]);
                upper = std::max(upper, positions[i]);
            }
            require(accessor.contains("min") && accessor["min"][a].get<float>() == lower &&
                        accessor["max"][a].get<float>() == upper,
                    "min and max of positions");
        }
    }

    void checkNodes() {
        for (const auto& scene : m_gltf["scenes"])
            for (const auto& node : scene["nodes"])
                index(node, "nodes");
        std::multiset<std::size_t> children;
        for (const auto& node : m_gltf["nodes"]) {
            if (node.contains("mesh"))
                index(node["mesh"], "meshes");
            if (node.contains("camera"))
                index(node["camera"], "cameras");
            require(!node.contains("matrix") || !node.contains("rotation"),
                    "a node has both a matrix and its parts");
            for (const auto& child : node.value("children", Json::array())) {
                index(child, "nodes");
                children.insert(child.get<std::size_t>());
            }
        }
        for (const std::size_t child : children)
            require(children.count(child) == 1, "a node has two parents");
    }

    /// Names of all extensions in the file.
    static void collect(const Json& json, std::set<std::string>& names) {
        for (const auto& [key, value] : json.items()) {
            if (key == "extensions" && value.is_object())
                for (const auto& [name, content] : value.items())
                    names.insert(name);
            if (value.is_structured())
                collect(value, names);
        }
    }

    void checkExtensions() {
        std::set<std::string> found, listed;
        collect(m_gltf, found);
        for (const auto& name : m_gltf.value("extensionsUsed", Json::array()))
            require(listed.insert(name).second, "an extension is listed twice");
        require(found == listed, "extensionsUsed differs from the extensions that are used");
    }

    std::map<std::string, std::string> m_files;
    std::vector<std::string> m_buffers;
    Json m_gltf;
    std::vector<std::string> m_problems;
};

} // namespace limn
