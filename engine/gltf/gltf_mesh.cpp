// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_mesh.h"

#include "engine/gltf/gltf_accessor.h"
#include "engine/scene/mesh/mesh_repair.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// An attribute's name in glTF and the numbers of components it may have.
struct Attribute {
    const char* name;
    std::uint32_t minComponents, maxComponents;
};

} // namespace

/// Reads an attribute; empty if the primitive lacks it.
static Result<AccessorValues> readAttribute(const tinygltf::Model& model,
                                            const tinygltf::Primitive& primitive,
                                            const Attribute& attribute, std::size_t count) {
    const auto found = primitive.attributes.find(attribute.name);
    if (found == primitive.attributes.end())
        return AccessorValues{};
    Result<AccessorValues> values = readNumbers(model, found->second);
    if (!values)
        return fail(fmt::format("{}: {}", attribute.name, values.error().message));
    if (values->components < attribute.minComponents ||
        values->components > attribute.maxComponents)
        return fail(fmt::format("{}: accessors[{}] has {} components", attribute.name,
                                found->second, values->components));
    if (values->count() != count)
        return fail(fmt::format("{}: accessors[{}] has {} elements, POSITION has {}",
                                attribute.name, found->second, values->count(), count));
    return values;
}

template <class V>
static std::vector<V> toVectors(const AccessorValues& values, float missing) {
    std::vector<V> out(values.count(), V(missing));
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::span<const float> row = values.row(i);
        for (std::size_t c = 0; c < row.size(); ++c)
            out[i][int(c)] = row[c];
    }
    return out;
}

/// Replaces rows that contain a non-finite number by `instead`. Returns their number.
template <class V>
static std::size_t mendRows(std::vector<V>& rows, V instead) {
    std::size_t count = 0;
    for (V& row : rows)
        for (int c = 0; c < V::length(); ++c)
            if (!std::isfinite(row[c])) {
                row = instead;
                ++count;
                break;
            }
    return count;
}

/// Converts the primitive's mode to triangle lists. Degenerate triangles that join strips are left
/// out.
static std::vector<std::uint32_t> asTriangles(const std::vector<std::uint32_t>& indices, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES)
        return {indices.begin(), indices.end() - std::ptrdiff_t(indices.size() % 3)};
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            a = indices[i + 1], b = indices[i + 2], c = indices[0];
        else if (i % 2 == 1)
            std::swap(b, c);
        if (a != b && b != c && c != a)
            out.insert(out.end(), {a, b, c});
    }
    return out;
}

static Result<std::vector<std::uint32_t>> readTriangles(const tinygltf::Model& model,
                                                        const tinygltf::Primitive& primitive,
                                                        std::size_t vertices,
                                                        GltfRepairs& repairs) {
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
        Result<std::vector<std::uint32_t>> read = readIndices(model, primitive.indices);
        if (!read)
            return fail(fmt::format("indices: {}", read.error().message));
        indices = std::move(*read);
        for (std::size_t i = 0; i < indices.size(); ++i)
            if (indices[i] >= vertices)
                return fail(
                    fmt::format("indices: accessors[{}] element {} is {}, there are {} vertices",
                                primitive.indices, i, indices[i], vertices));
    } else {
        indices.resize(vertices);
        for (std::size_t i = 0; i < vertices; ++i)
            indices[i] = std::uint32_t(i);
    }
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)
        repairs.add("triangle lists with an incomplete last triangle, which is left out");
    return asTriangles(indices, primitive.mode);
}

static Result<void> readOptional(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                 bool withTangents, Mesh& mesh, GltfRepairs& repairs) {
    const std::size_t count = mesh.positions.size();
    const auto read = [&](const Attribute& attribute, auto& out, float missing) -> Result<void> {
        Result<AccessorValues> values = readAttribute(model, primitive, attribute, count);
        if (!values)
            return tl::make_unexpected(values.error());
        out = toVectors<typename std::remove_reference_t<decltype(out)>::value_type>(*values,
                                                                                     missing);
        return {};
    };
    Result<void> done = read({"NORMAL", 3, 3}, mesh.normals, 0);
    if (done)
        done = read({"TEXCOORD_0", 2, 2}, mesh.uv0, 0);
    if (done)
        done = read({"TEXCOORD_1", 2, 2}, mesh.uv1, 0);
    if (done)
        done = read({"COLOR_0", 3, 4}, mesh.colors, 1);
    if (done && withTangents)
        done = read({"TANGENT", 4, 4}, mesh.tangents, 0);
    if (!done)
        return done;
    repairs.add("texture coordinates not finite, set to 0",
                mendRows(mesh.uv0, glm::vec2(0)) + mendRows(mesh.uv1, glm::vec2(0)));
    repairs.add("vertex colors not finite, set to 1", mendRows(mesh.colors, glm::vec4(1)));
    std::size_t negative = 0;
    for (glm::vec4& c : mesh.colors)
        if (c.x < 0 || c.y < 0 || c.z < 0 || c.w < 0) {
            c = glm::max(c, glm::vec4(0));
            ++negative;
        }
    repairs.add("negative vertex colors set to 0", negative);
    return {};
}

static void repairTangents(Mesh& mesh, bool fromUv1, GltfRepairs& repairs) {
    const auto bad = [](const glm::vec4& t) {
        const float length = glm::length(glm::vec3(t));
        return !(length > 0.01f && length < 100.f) || !(std::abs(t.w) == 1);
    };
    if (mesh.tangents.empty()) {
        repairs.add("meshes with a normal map and no tangents, which are generated");
    } else if (const auto count = std::ranges::count_if(mesh.tangents, bad); count > 0) {
        repairs.add("meshes with invalid tangents, which are generated");
    } else {
        for (glm::vec4& t : mesh.tangents)
            t = glm::vec4(glm::normalize(glm::vec3(t)), t.w);
        return;
    }
    generateTangents(mesh, fromUv1);
}

Result<Mesh> readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           bool withTangents, GltfRepairs& repairs) {
    Mesh mesh;
    if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        repairs.add("primitives of points or lines left out");
        return mesh;
    }
    if (primitive.mode < 0 || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        return fail(fmt::format("mode: {} is unknown", primitive.mode));
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        repairs.add("primitives without POSITION left out");
        return mesh;
    }
    const Result<AccessorValues> positions = readNumbers(model, position->second);
    if (!positions)
        return fail(fmt::format("POSITION: {}", positions.error().message));
    if (positions->components != 3)
        return fail(fmt::format("POSITION: accessors[{}] is not VEC3", position->second));
    mesh.positions = toVectors<glm::vec3>(*positions, 0);
    Result<std::vector<std::uint32_t>> triangles =
        readTriangles(model, primitive, mesh.positions.size(), repairs);
    if (!triangles)
        return tl::make_unexpected(triangles.error());
    mesh.indices = std::move(*triangles);
    if (Result<void> read = readOptional(model, primitive, withTangents, mesh, repairs); !read)
        return tl::make_unexpected(read.error());
    if (!primitive.targets.empty())
        repairs.add("primitives whose morph targets are left out");

    const RemovedTriangles removed = removeBadTriangles(mesh);
    repairs.add("triangles of zero area removed", removed.zeroArea);
    repairs.add("triangles with positions not finite removed", removed.notFinite);
    if (mesh.indices.empty())
        return mesh;
    if (mesh.normals.empty()) {
        repairs.add("meshes without normals, which are generated flat");
        mesh.tangents.clear(); // glTF: without normals, tangents do not count
        generateFlatNormals(mesh);
    } else {
        repairs.add("invalid normals generated", mendNormals(mesh));
    }
    if (withTangents)
        repairTangents(mesh, mesh.uv0.empty(), repairs);
    return mesh;
}

} // namespace limn
