// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gltf/gltf_import.h"
#include "tests/core/temporary_folder.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace limn {

/// Writes small glTF files for tests: JSON that may be edited freely, and one buffer.
struct GltfBuilder {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    static constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                         kUnsignedInt = 5125, kFloat = 5126;

    /// A view of its own for `data`; returns its index.
    template <class T>
    int view(const std::vector<T>& data, int stride = 0) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        nlohmann::json v = {
            {"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size() * sizeof(T)}};
        if (stride)
            v["byteStride"] = stride;
        bytes.append(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
        json["bufferViews"].push_back(v);
        return int(json["bufferViews"].size()) - 1;
    }
    int accessor(int bufferView, const char* type, int componentType, std::size_t count,
                 bool normalized = false, std::size_t offset = 0) {
        json["accessors"].push_back({{"bufferView", bufferView},
                                     {"byteOffset", offset},
                                     {"componentType", componentType},
                                     {"normalized", normalized},
                                     {"count", count},
                                     {"type", type}});
        return int(json["accessors"].size()) - 1;
    }
    int vec3(const std::vector<glm::vec3>& data) {
        return accessor(view(data), "VEC3", kFloat, data.size());
    }
    int indices(const std::vector<std::uint16_t>& data) {
        return accessor(view(data), "SCALAR", kUnsignedShort, data.size());
    }
    /// One mesh with one primitive, and a node for it.
    nlohmann::json& mesh(nlohmann::json primitive) {
        json["meshes"].push_back({{"primitives", {std::move(primitive)}}});
        json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
        json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
        return json["meshes"].back()["primitives"][0];
    }

    std::string glb() const {
        nlohmann::json whole = json;
        if (!bytes.empty())
            whole["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string binary = bytes;
        binary.resize((binary.size() + 3) / 4 * 4);
        std::string out;
        const auto put = [&](std::size_t value) {
            const auto word = std::uint32_t(value);
            out.append(reinterpret_cast<const char*>(&word), 4);
        };
        out += "glTF";
        put(2);
        put(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
        put(text.size());
        out += "JSON" + text;
        if (!binary.empty()) {
            put(binary.size());
            out += std::string("BIN\0", 4) + binary;
        }
        return out;
    }
    Result<ImportedScene> import() const {
        const TemporaryFolder folder;
        writeFile(folder.file("scene.glb"), glb());
        return importGltf(folder.file("scene.glb"));
    }
};

/// One right triangle in the xy plane that faces +z.
inline GltfBuilder triangleScene() {
    GltfBuilder b;
    b.mesh({{"attributes", {{"POSITION", b.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}}});
    return b;
}

inline int scalars(GltfBuilder& b, const std::vector<float>& values) {
    return b.accessor(b.view(values), "SCALAR", GltfBuilder::kFloat, values.size());
}

/// Adds a channel to the only animation.
inline void animate(GltfBuilder& b, const nlohmann::json& target, int input, int output,
                    const char* interpolation = "LINEAR") {
    nlohmann::json& animation = b.json["animations"][0];
    const std::size_t sampler = animation.contains("samplers") ? animation["samplers"].size() : 0;
    animation["samplers"].push_back(
        {{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back({{"sampler", sampler}, {"target", target}});
}

inline bool hasRepair(const ImportedScene& scene, const std::string& text) {
    return std::ranges::any_of(scene.repairs, [&](const std::string& line) {
        return line.find(text) != std::string::npos;
    });
}

/// The import, which must succeed.
inline ImportedScene imported(const GltfBuilder& b) {
    Result<ImportedScene> scene = b.import();
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
    return scene ? *scene : ImportedScene{};
}

/// The reason of an import, which must fail.
inline std::string refusal(const GltfBuilder& b) {
    const Result<ImportedScene> scene = b.import();
    EXPECT_FALSE(scene);
    return scene ? "" : scene.error().message;
}

} // namespace limn
