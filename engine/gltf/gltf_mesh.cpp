// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_mesh.h"

#include "engine/gltf/gltf_accessor.h"
#include "engine/scene/mesh/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace limn {

namespace {

/// An attribute's name in glTF and the numbers of components it may have.
struct Attribute {
    std::string name;
    std::uint32_t minComponents, maxComponents;
};

} // namespace

namespace {

/// Reads attributes of the vertices that a primitive uses.
struct AttributeReader {
    const tinygltf::Model& model;
    std::vector<std::uint32_t> rows; ///< of all accessors, in ascending order
    std::size_t count = 0;           ///< of POSITION

    /// An attribute in a map of accessors; empty if that lacks it.
    Result<AccessorValues> read(const std::map<std::string, int>& accessors,
                                const Attribute& attribute) const {
        const auto found = accessors.find(attribute.name);
        if (found == accessors.end())
            return AccessorValues{};
        const Result<std::size_t> elements = countOfAccessor(model, found->second);
        if (elements && *elements != count)
            return fail(fmt::format("{}: accessors[{}] has {} elements, POSITION has {}",
                                    attribute.name, found->second, *elements, count));
        Result<AccessorValues> values = readNumbers(model, found->second, rows);
        if (!values)
            return fail(fmt::format("{}: {}", attribute.name, values.error().message));
        if (values->components < attribute.minComponents ||
            values->components > attribute.maxComponents)
            return fail(fmt::format("{}: accessors[{}] has {} components", attribute.name,
                                    found->second, values->components));
        return values;
    }
};

} // namespace

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

/// Brings vertex colours into the range that glTF gives them.
static void clampColors(std::vector<glm::vec4>& colors, GltfRepairs& repairs) {
    repairs.add("vertex colors not finite, set to 1", mendRows(colors, glm::vec4(1)));
    std::size_t outside = 0;
    for (glm::vec4& c : colors) {
        const glm::vec4 inside = glm::clamp(c, 0.f, 1.f);
        outside += c != inside;
        c = inside;
    }
    repairs.add("vertex colors out of range brought into [0, 1]", outside);
}

static Result<void> readOptional(const AttributeReader& reader,
                                 const tinygltf::Primitive& primitive, const PrimitiveUse& use,
                                 Mesh& mesh, GltfRepairs& repairs) {
    const auto read = [&](const Attribute& attribute, auto& out, float missing) -> Result<void> {
        Result<AccessorValues> values = reader.read(primitive.attributes, attribute);
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
    std::size_t bad = mendRows(mesh.uv0, glm::vec2(0)) + mendRows(mesh.uv1, glm::vec2(0));
    for (const std::uint32_t set : use.uvSets) {
        if (set < 2 || !done)
            continue;
        mesh.furtherUv.resize(set - 1);
        done = read({fmt::format("TEXCOORD_{}", set), 2, 2}, mesh.furtherUv.back(), 0);
        bad += mendRows(mesh.furtherUv.back(), glm::vec2(0));
    }
    if (done)
        done = read({"COLOR_0", 3, 4}, mesh.colors, 1);
    if (done && use.normalMapSet)
        done = read({"TANGENT", 4, 4}, mesh.tangents, 0);
    if (!done)
        return done;
    repairs.add("texture coordinates not finite, set to 0", bad);
    clampColors(mesh.colors, repairs);
    return {};
}

/// Adds what a morph target moves, times its weight.
static Result<void> addTarget(const AttributeReader& reader,
                              const std::map<std::string, int>& target, float weight, Mesh& mesh) {
    const auto add = [&](const char* name, auto& values) -> Result<void> {
        const Result<AccessorValues> moved = reader.read(target, {name, 3, 3});
        if (!moved)
            return tl::make_unexpected(moved.error());
        for (std::size_t i = 0; i < std::min(moved->count(), values.size()); ++i)
            for (int c = 0; c < 3; ++c)
                values[i][c] += weight * moved->row(i)[std::size_t(c)];
        return {};
    };
    Result<void> done = add("POSITION", mesh.positions);
    if (done)
        done = add("NORMAL", mesh.normals);
    return done ? add("TANGENT", mesh.tangents) : done;
}

static Result<void> addTargets(const AttributeReader& reader, const tinygltf::Primitive& primitive,
                               std::span<const double> weights, Mesh& mesh) {
    for (std::size_t k = 0; k < std::min(primitive.targets.size(), weights.size()); ++k)
        if (weights[k] != 0)
            if (const Result<void> added =
                    addTarget(reader, primitive.targets[k], float(weights[k]), mesh);
                !added)
                return fail(fmt::format("targets[{}].{}", k, added.error().message));
    return {};
}

/// Adds the weighted matrices of one set of joints to those of the vertices, and their weights.
static Result<void> addJoints(const AttributeReader& reader, const tinygltf::Primitive& primitive,
                              std::uint32_t set, const SkinPose& skin,
                              std::vector<glm::dmat4>& matrices, std::vector<double>& weights) {
    const Result<AccessorValues> joints =
        reader.read(primitive.attributes, {fmt::format("JOINTS_{}", set), 4, 4});
    const Result<AccessorValues> shares =
        reader.read(primitive.attributes, {fmt::format("WEIGHTS_{}", set), 4, 4});
    for (const auto* each : {&joints, &shares})
        if (!*each)
            return tl::make_unexpected(each->error());
    for (std::size_t i = 0; i < std::min(joints->count(), shares->count()); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const double weight = double(shares->row(i)[k]);
            const float joint = joints->row(i)[k];
            if (!(weight > 0))
                continue;
            if (!(joint >= 0 && joint < float(skin.joints.size())))
                return fail(fmt::format("JOINTS_{}: element {} is {}, there are {} joints", set, i,
                                        joint, skin.joints.size()));
            matrices[i] += weight * skin.joints[std::size_t(joint)];
            weights[i] += weight;
        }
    return {};
}

/// Moves vertices to where their joints have them.
static Result<void> applySkin(const AttributeReader& reader, const tinygltf::Primitive& primitive,
                              const SkinPose& skin, Mesh& mesh) {
    if (skin.joints.empty())
        return {};
    std::vector<glm::dmat4> matrices(mesh.positions.size(), glm::dmat4(0));
    std::vector<double> weights(mesh.positions.size(), 0);
    for (std::uint32_t set = 0; primitive.attributes.contains(fmt::format("JOINTS_{}", set)); ++set)
        if (const Result<void> added = addJoints(reader, primitive, set, skin, matrices, weights);
            !added)
            return added;
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        const glm::dmat4 m = weights[i] > 0 ? matrices[i] / weights[i] : skin.joints[0];
        mesh.positions[i] = glm::vec3(m * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
        const glm::dmat3 linear(m);
        const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]),
                                  glm::cross(linear[2], linear[0]),
                                  glm::cross(linear[0], linear[1]));
        // Lengths are mended afterwards.
        if (!mesh.normals.empty())
            mesh.normals[i] = glm::vec3(cofactor * glm::dvec3(mesh.normals[i]));
        if (!mesh.tangents.empty())
            mesh.tangents[i] =
                glm::vec4(glm::vec3(linear * glm::dvec3(mesh.tangents[i])), mesh.tangents[i].w);
    }
    return {};
}

/// Numbers the vertices that triangles use anew, and returns those in ascending order.
static std::vector<std::uint32_t> usedVertices(std::vector<std::uint32_t>& indices) {
    std::vector<std::uint32_t> used = indices;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t& i : indices)
        i = std::uint32_t(std::ranges::lower_bound(used, i) - used.begin());
    return used;
}

static void repairTangents(Mesh& mesh, std::uint32_t uvSet, GltfRepairs& repairs) {
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
    generateTangents(mesh, uvSet);
}

Result<Mesh> readPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                           const PrimitiveUse& use, GltfRepairs& repairs) {
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
    const Result<std::size_t> count = countOfAccessor(model, position->second);
    if (!count)
        return fail(fmt::format("POSITION: {}", count.error().message));
    Result<std::vector<std::uint32_t>> triangles = readTriangles(model, primitive, *count, repairs);
    if (!triangles)
        return tl::make_unexpected(triangles.error());
    mesh.indices = std::move(*triangles);
    const AttributeReader reader{model, usedVertices(mesh.indices), *count};
    const Result<AccessorValues> positions = reader.read(primitive.attributes, {"POSITION", 3, 3});
    if (!positions)
        return tl::make_unexpected(positions.error());
    mesh.positions = toVectors<glm::vec3>(*positions, 0);
    if (Result<void> read = readOptional(reader, primitive, use, mesh, repairs); !read)
        return tl::make_unexpected(read.error());
    if (Result<void> added = addTargets(reader, primitive, use.morphWeights, mesh); !added)
        return tl::make_unexpected(added.error());
    if (use.skin)
        if (Result<void> moved = applySkin(reader, primitive, *use.skin, mesh); !moved)
            return tl::make_unexpected(moved.error());

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
    if (use.normalMapSet)
        repairTangents(mesh, *use.normalMapSet, repairs);
    return mesh;
}

} // namespace limn
