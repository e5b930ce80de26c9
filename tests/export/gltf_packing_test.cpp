// SPDX-License-Identifier: MIT
// Quantised and compressed geometry against the geometry that it was made of.
#include "engine/export/gltf_meshopt.h"
#include "engine/export/gltf_quantization.h"

#include "engine/export/export_table.h"
#include "tests/export/known_light.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace limn::gltf_packing_test {
namespace {

using Json = nlohmann::json;

std::vector<glm::vec3> points() {
    std::vector<glm::vec3> list;
    for (int k = 0; k < 100; ++k)
        list.emplace_back(-3 + 0.07f * float(k), 5 - 0.011f * float(k * k % 97),
                          0.3f * float(k % 7));
    return list;
}

TEST(Quantization, PositionsAreOffByHalfAStep) {
    const std::vector<glm::vec3> p = points();
    const QuantizedCube cube = quantizedCube(boundsOf(p));
    const auto q = quantizedPositions(p, cube);
    const float half = 0.5f / 65535 * cube.edge * 1.01f;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::vec4 share(glm::vec3(q[i]) / 65535.f, 1);
        EXPECT_LE(glm::length(glm::vec3(fromQuantized(cube) * share) - p[i]), half * 1.8f);
        EXPECT_EQ(q[i].w, 0);
    }
}

TEST(Quantization, OfASinglePointIsThatPoint) {
    const std::array<glm::vec3, 2> p = {glm::vec3(1, 2, 3), glm::vec3(1, 2, 3)};
    const QuantizedCube cube = quantizedCube(boundsOf(p));
    const glm::vec4 share(glm::vec3(quantizedPositions(p, cube)[1]) / 65535.f, 1);
    EXPECT_EQ(glm::vec3(fromQuantized(cube) * share), p[0]);
}

TEST(Quantization, AxesAndSignsAreExact) {
    const std::array<glm::vec3, 3> axes = {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0),
                                           glm::vec3(0, 0, 1)};
    const auto q = quantizedDirections(axes);
    EXPECT_EQ(q[0], glm::i8vec4(127, 0, 0, 0));
    EXPECT_EQ(q[1], glm::i8vec4(0, -127, 0, 0));
    const std::array<glm::vec4, 1> tangent = {glm::vec4(0, 0, 1, -1)};
    EXPECT_EQ(quantizedTangents(tangent)[0], glm::i8vec4(0, 0, 127, -127));
}

TEST(Quantization, RefusesWhatIsOutsideOfTheUnit) {
    const std::array<glm::vec2, 2> inside = {glm::vec2(0, 1), glm::vec2(0.5f)};
    ASSERT_TRUE(quantizedUnit(inside));
    EXPECT_EQ((*quantizedUnit(inside))[0], glm::u16vec2(0, 65535));
    const std::array<glm::vec2, 1> outside = {glm::vec2(0, 1.001f)};
    EXPECT_FALSE(quantizedUnit(outside));
}

/// The triangle with its smallest corner first.
std::array<std::uint32_t, 3> turned(std::array<std::uint32_t, 3> t) {
    std::ranges::rotate(t, std::ranges::min_element(t));
    return t;
}

std::multiset<std::array<std::uint32_t, 3>> trianglesOf(const std::vector<std::uint32_t>& indices) {
    std::multiset<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        triangles.insert(turned({indices[i], indices[i + 1], indices[i + 2]}));
    return triangles;
}

TEST(Meshopt, VerticesComeBackAsTheyWere) {
    const std::vector<glm::vec3> p = points();
    const std::string packed = meshoptVertices(p.data(), p.size(), sizeof(glm::vec3));
    EXPECT_EQ(static_cast<unsigned char>(packed[0]), 0xa0) << "the extension's version";
    std::vector<glm::vec3> again(p.size());
    ASSERT_EQ(meshopt_decodeVertexBuffer(again.data(), p.size(), sizeof(glm::vec3),
                                         reinterpret_cast<const unsigned char*>(packed.data()),
                                         packed.size()),
              0);
    EXPECT_EQ(again, p);
}

TEST(Meshopt, TrianglesComeBackInAnotherOrder) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t k = 0; k < 97; ++k)
        indices.insert(indices.end(), {(k * 31) % 97, (k * 31 + 1) % 97, (k * 7 + 5) % 97});
    const auto ordered = orderedTriangles(indices, 97);
    const std::string packed = meshoptTriangles(ordered, 97);
    EXPECT_EQ(static_cast<unsigned char>(packed[0]), 0xe1) << "the extension's version";
    std::vector<std::uint32_t> again(indices.size());
    ASSERT_EQ(meshopt_decodeIndexBuffer(again.data(), again.size(), sizeof(std::uint32_t),
                                        reinterpret_cast<const unsigned char*>(packed.data()),
                                        packed.size()),
              0);
    EXPECT_EQ(trianglesOf(again), trianglesOf(indices));
}

/// An exported file with the bytes of its views, as a consumer unpacks them.
struct Exported {
    explicit Exported(const ExportSettings& settings) {
        const KnownLight light([](glm::vec3) { return KnownLight::probe(0); });
        const auto files = findExportFormat("gltf")->write(light.view(), settings, "room.gltf", {});
        EXPECT_TRUE(files);
        json = Json::parse(files->front().bytes);
        const std::string& buffer = (*files)[1].bytes;
        bytes = buffer.size();
        for (const Json& view : json["bufferViews"])
            views.push_back(unpacked(view, buffer));
    }

    static std::string unpacked(const Json& view, const std::string& buffer) {
        std::string plain(view["byteLength"].get<std::size_t>(), '\0');
        if (!view.contains("extensions"))
            return buffer.substr(view["byteOffset"], plain.size());
        const Json& packed = view["extensions"]["EXT_meshopt_compression"];
        const std::size_t count = packed["count"], stride = packed["byteStride"];
        const auto* data = reinterpret_cast<const unsigned char*>(buffer.data()) +
                           packed["byteOffset"].get<std::size_t>();
        EXPECT_LE(packed["byteOffset"].get<std::size_t>() + packed["byteLength"].get<std::size_t>(),
                  buffer.size());
        EXPECT_EQ(count * stride, plain.size());
        const int result =
            packed["mode"] == "TRIANGLES"
                ? meshopt_decodeIndexBuffer(plain.data(), count, stride, data, packed["byteLength"])
                : meshopt_decodeVertexBuffer(plain.data(), count, stride, data,
                                             packed["byteLength"]);
        EXPECT_EQ(result, 0);
        return plain;
    }

    /// Component of element i of an accessor, as a number.
    double value(std::size_t accessor, std::size_t i, std::size_t component) const {
        const Json& a = json["accessors"][accessor];
        const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
        const int type = a["componentType"];
        const std::size_t size = type == 5126 || type == 5125 ? 4 : type == 5123 ? 2 : 1;
        const std::size_t width = a["type"] == "VEC2"   ? 2
                                  : a["type"] == "VEC3" ? 3
                                  : a["type"] == "VEC4" ? 4
                                                        : 1;
        const std::size_t stride = view.value("byteStride", size * width);
        const char* data =
            views[a["bufferView"].get<std::size_t>()].data() + i * stride + component * size;
        const auto read = [&]<class T>(T v) {
            std::memcpy(&v, data, sizeof(T));
            return double(v);
        };
        switch (type) {
        case 5126:
            return read(float());
        case 5125:
            return read(std::uint32_t());
        case 5123:
            return read(std::uint16_t()) / (a.value("normalized", false) ? 65535. : 1.);
        default:
            return read(std::int8_t()) / 127.;
        }
    }

    /// Position of a vertex of a node's first primitive in the world.
    glm::dvec3 position(const Json& node, std::size_t i) const {
        const std::size_t accessor = attribute(node, "POSITION");
        glm::dvec3 p(0);
        for (int c = 0; c < 3; ++c)
            p[c] = value(accessor, i, std::size_t(c));
        if (!node.contains("matrix"))
            return p;
        const Json& m = node["matrix"];
        glm::dvec3 world(0);
        for (std::size_t r = 0; r < 3; ++r)
            world[int(r)] = m[r].get<double>() * p.x + m[4 + r].get<double>() * p.y +
                            m[8 + r].get<double>() * p.z + m[12 + r].get<double>();
        return world;
    }
    std::size_t attribute(const Json& node, const char* name) const {
        return json["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0]["attributes"][name];
    }

    Json json;
    std::size_t bytes = 0;
    std::vector<std::string> views;
};

TEST(PackedGltf, HasTheVerticesOfThePlainFile) {
    const Exported plain({});
    for (const auto& [quantize, meshopt] : {std::pair(false, true), {true, false}, {true, true}}) {
        const Exported packed({.quantize = quantize, .meshopt = meshopt});
        EXPECT_LT(packed.bytes, plain.bytes);
        const double error = quantize ? 2. / 65535 : 0;
        for (std::size_t n = 0; n < 2; ++n) { // the quad and the ball
            const Json &a = plain.json["nodes"][n], &b = packed.json["nodes"][n];
            const std::size_t count =
                plain.json["accessors"][plain.attribute(a, "POSITION")]["count"];
            ASSERT_EQ(packed.json["accessors"][packed.attribute(b, "POSITION")]["count"], count);
            for (std::size_t i = 0; i < count; ++i) {
                EXPECT_LE(glm::length(plain.position(a, i) - packed.position(b, i)), error);
                for (std::size_t c = 0; c < 3; ++c)
                    EXPECT_NEAR(plain.value(plain.attribute(a, "NORMAL"), i, c),
                                packed.value(packed.attribute(b, "NORMAL"), i, c),
                                quantize ? 0.5 / 127 + 1e-6 : 0);
            }
        }
        const std::size_t uv = packed.attribute(packed.json["nodes"][0], "TEXCOORD_1");
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(packed.value(uv, i, 0),
                        plain.value(plain.attribute(plain.json["nodes"][0], "TEXCOORD_1"), i, 0),
                        quantize ? 0.51 / 65535 : 0);
    }
}

TEST(PackedGltf, NamesWhatAConsumerMustKnow) {
    EXPECT_FALSE(Exported({}).json.contains("extensionsRequired"));
    EXPECT_EQ(Exported({.quantize = true}).json["extensionsRequired"],
              Json({"KHR_mesh_quantization"}));
    const Json json = Exported({.quantize = true, .meshopt = true}).json;
    EXPECT_EQ(json["extensionsRequired"],
              Json({"EXT_meshopt_compression", "KHR_mesh_quantization"}));
    ASSERT_EQ(json["buffers"].size(), 2U);
    EXPECT_FALSE(json["buffers"][1].contains("uri"));
    EXPECT_EQ(json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"], true);
}

TEST(PackedGltf, FormatsThatCannotReadItStayPlain) {
    const KnownLight light([](glm::vec3) { return KnownLight::probe(0); });
    for (const char* name : {"playcanvas", "godot", "blender", "ibl"}) {
        const auto files = findExportFormat(name)->write(
            light.view(), {.quantize = true, .meshopt = true}, "room.gltf", {});
        ASSERT_TRUE(files) << name;
        EXPECT_FALSE(Json::parse(files->front().bytes).contains("extensionsRequired")) << name;
    }
}

} // namespace
} // namespace limn::gltf_packing_test
