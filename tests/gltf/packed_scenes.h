// SPDX-License-Identifier: MIT
#pragma once

#include "tests/gltf/gltf_builder.h"

#include <cmath>
#include <memory>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <meshoptimizer.h>

namespace limn {

/// A wavy strip: positions of 8 x 8 vertices and the triangles between them.
struct Grid {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    Grid() {
        for (std::uint32_t i = 0; i < 64; ++i)
            positions.emplace_back(float(i % 8), float(i / 8), 0.1f * float(i % 5));
        for (std::uint32_t y = 0; y < 7; ++y)
            for (std::uint32_t x = 0; x < 7; ++x) {
                const std::uint32_t a = 8 * y + x;
                indices.insert(indices.end(), {a, a + 1, a + 8, a + 8, a + 1, a + 9});
            }
    }
};

/// A view of packed bytes, and of what they unpack to in a buffer without data.
inline int packedView(GltfBuilder& b, const std::vector<std::uint8_t>& packed, std::size_t stride,
                      std::size_t count, const char* mode) {
    const int view = b.view(packed);
    nlohmann::json& json = b.json["bufferViews"][std::size_t(view)];
    nlohmann::json extension = json;
    extension["byteStride"] = stride;
    extension["count"] = count;
    extension["mode"] = mode;
    json["byteLength"] = stride * count;
    json["extensions"]["EXT_meshopt_compression"] = extension;
    return view;
}

inline GltfBuilder meshoptScene(const Grid& grid) {
    GltfBuilder b;
    constexpr std::size_t kStride = sizeof(glm::vec3);
    std::vector<std::uint8_t> vertices(meshopt_encodeVertexBufferBound(64, kStride)),
        indices(meshopt_encodeIndexBufferBound(grid.indices.size(), 64));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(),
                                               grid.positions.data(), 64, kStride));
    indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), grid.indices.data(),
                                             grid.indices.size()));
    const int position = b.accessor(packedView(b, vertices, kStride, 64, "ATTRIBUTES"), "VEC3",
                                    GltfBuilder::kFloat, 64),
              index = b.accessor(packedView(b, indices, 4, grid.indices.size(), "TRIANGLES"),
                                 "SCALAR", GltfBuilder::kUnsignedInt, grid.indices.size());
    b.mesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
    b.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return b;
}

inline std::vector<std::uint8_t> dracoBytes(const Grid& grid, int speed) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(int(grid.indices.size() / 3));
    const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::uint32_t f = 0; f < grid.indices.size() / 3; ++f)
        builder.SetAttributeValuesForFace(
            id, draco::FaceIndex(f), &grid.positions[grid.indices[3 * f]],
            &grid.positions[grid.indices[3 * f + 1]], &grid.positions[grid.indices[3 * f + 2]]);
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetSpeedOptions(speed, speed);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

inline GltfBuilder dracoScene(const std::vector<std::uint8_t>& bytes, std::size_t corners) {
    GltfBuilder b;
    const int view = b.view(bytes);
    b.json["accessors"] = {
        {{"componentType", GltfBuilder::kFloat}, {"count", 64}, {"type", "VEC3"}},
        {{"componentType", GltfBuilder::kUnsignedShort}, {"count", corners}, {"type", "SCALAR"}}};
    b.mesh({{"attributes", {{"POSITION", 0}}},
            {"indices", 1},
            {"extensions",
             {{"KHR_draco_mesh_compression",
               {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
    b.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return b;
}

/// A strip along x on two joints, of which the second is bent up by 90 degrees at x = 1.
inline GltfBuilder bentStrip() {
    GltfBuilder b;
    const std::vector<std::array<std::uint8_t, 4>> joints(
        {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}});
    const std::vector<glm::vec4> weights({{1, 0, 0, 0},
                                          {1, 0, 0, 0},
                                          {0.5f, 0.5f, 0, 0},
                                          {0.5f, 0.5f, 0, 0},
                                          {1, 0, 0, 0},
                                          {2, 0, 0, 0}}); // the sum of weights does not matter
    b.mesh(
        {{"attributes",
          {{"POSITION", b.vec3({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}, {2, 0, 0}, {2, 0, 1}})},
           {"NORMAL", b.vec3(std::vector<glm::vec3>(6, {0, 1, 0}))},
           {"JOINTS_0", b.accessor(b.view(joints), "VEC4", GltfBuilder::kUnsignedByte, 6)},
           {"WEIGHTS_0", b.accessor(b.view(weights), "VEC4", GltfBuilder::kFloat, 6)}}},
         {"indices", b.indices({0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5})}});
    glm::mat4 back(1);
    back[3] = {-1, 0, 0, 1};
    const std::vector<glm::mat4> inverse{glm::mat4(1), back};
    const float h = std::sqrt(0.5f);
    b.json["nodes"].push_back({{"translation", {5, 0, 0}}, {"children", {2}}});
    b.json["nodes"].push_back({{"translation", {1, 0, 0}}, {"rotation", {0, 0, h, h}}});
    b.json["nodes"][0]["skin"] = 0;
    b.json["nodes"][0]["translation"] = {100, 100, 100}; // which a skin makes meaningless
    b.json["scenes"][0]["nodes"].push_back(1);
    b.json["skins"] = {
        {{"joints", {1, 2}},
         {"inverseBindMatrices", b.accessor(b.view(inverse), "MAT4", GltfBuilder::kFloat, 2)}}};
    return b;
}

} // namespace limn
