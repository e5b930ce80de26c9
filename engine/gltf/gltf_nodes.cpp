// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_nodes.h"

#include "engine/gltf/gltf_accessor.h"
#include "engine/gltf/gltf_lights.h"
#include "engine/scene/origin.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

using tinygltf::Model;

static constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

static bool finite(const Transform& t) {
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(float(t.translation[c])) || !std::isfinite(t.scale[c]))
            return false;
    return std::isfinite(t.rotation.x + t.rotation.y + t.rotation.z + t.rotation.w);
}

/// Normalises the rotation. A single scale of 0 becomes one so small that what it flattens is
/// thinner than light can tell, and normals keep their directions. Where two scales are 0, nothing
/// is left to see: returns false, and replaces scales of 0 by 1.
static bool normalise(Transform& t, GltfRepairs& repairs) {
    const glm::dquat q(t.rotation);
    const double length = glm::length(q);
    if (!(length > 1e-12)) {
        t.rotation = glm::quat(1, 0, 0, 0);
        repairs.add("rotations of length 0 taken as none");
    } else {
        if (std::abs(length - 1) > 1e-3)
            repairs.add("rotations brought to unit length");
        t.rotation = glm::quat(q / length);
    }
    constexpr float kFlat = 1e-6f; // of the largest scale
    const auto isZero = [&](int c) { return !(std::abs(t.scale[c]) > 1e-20f); };
    const int zeros = int(isZero(0)) + int(isZero(1)) + int(isZero(2));
    const glm::vec3 size = glm::abs(t.scale);
    const float flat = kFlat * std::max({size.x, size.y, size.z});
    for (int c = 0; c < 3; ++c)
        if (isZero(c))
            t.scale[c] = zeros == 1 ? flat : 1.f;
    if (zeros > 1)
        repairs.add("nodes of scale 0 along two axes hidden");
    return zeros < 2;
}

bool decompose(const glm::mat4& m, Transform& transform, GltfRepairs& repairs) {
    glm::dmat3 a{glm::dvec3(m[0]), glm::dvec3(m[1]), glm::dvec3(m[2])};
    glm::dvec3 scale{glm::length(a[0]), glm::length(a[1]), glm::length(a[2])};
    transform.translation = glm::dvec3(m[3]);
    if (glm::determinant(a) < 0)
        scale.x = -scale.x;
    glm::dmat3 r(1);
    for (int c = 0; c < 3; ++c) { // a flat matrix: any third axis will do
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        const glm::dvec3 third = glm::cross(a[d], a[e]);
        if (scale[c] == 0 && glm::length(third) > 0)
            a[c] = glm::normalize(third) * 1e-6 * std::max(scale[d], scale[e]);
        scale[c] = scale[c] == 0 ? glm::length(a[c]) : scale[c];
    }
    if (scale.x != 0 && scale.y != 0 && scale.z != 0) {
        // Gram-Schmidt orthogonalisation; without shear it changes nothing.
        r[0] = a[0] / scale.x;
        r[1] = a[1] / scale.y - r[0] * glm::dot(r[0], a[1] / scale.y);
        r[1] = glm::length(r[1]) > 1e-6 ? glm::normalize(r[1]) : glm::dvec3(0);
        r[2] = glm::cross(r[0], r[1]);
        if (r[1] == glm::dvec3(0))
            r = glm::dmat3(1);
    }
    transform.rotation = glm::quat(glm::normalize(glm::quat_cast(r)));
    transform.scale = glm::vec3(scale);
    double error = 0, largest = 0;
    for (int c = 0; c < 3; ++c) {
        error = std::max(error, glm::length(r[c] * scale[c] - a[c]));
        largest = std::max(largest, glm::length(a[c]));
    }
    if (error > 1e-3 * largest)
        repairs.add("matrices with shear, which is left out");
    return normalise(transform, repairs);
}

static glm::mat4 toMatrix(const std::vector<double>& values) {
    glm::mat4 m(1);
    for (int i = 0; i < 16; ++i)
        m[i / 4][i % 4] = float(values[std::size_t(i)]);
    return m;
}

/// Reads the node's local transform. Returns false if it makes the node invisible.
static bool readTransform(const tinygltf::Node& node, Transform& t, GltfRepairs& repairs) {
    if (node.matrix.size() == 16) {
        const bool visible = decompose(toMatrix(node.matrix), t, repairs);
        t.translation = {node.matrix[12], node.matrix[13], node.matrix[14]};
        return visible;
    }
    for (int c = 0; c < 3; ++c) {
        if (node.translation.size() == 3)
            t.translation[c] = node.translation[std::size_t(c)];
        if (node.scale.size() == 3)
            t.scale[c] = float(node.scale[std::size_t(c)]);
    }
    if (node.rotation.size() == 4)
        t.rotation = glm::quat(float(node.rotation[3]), float(node.rotation[0]),
                               float(node.rotation[1]), float(node.rotation[2]));
    return normalise(t, repairs);
}

namespace {

/// A node of the file and its parent in the document.
struct Visit {
    int node = 0;
    ObjectId parent = 0;
};

/// State of one call of addNodes().
struct NodeReader {
    Document& document;
    const Model& model;
    const MeshesOfGltf& meshes;
    GltfRepairs& repairs;
    std::vector<ObjectId> ids; ///< per node of the file; 0: not in the scene
    std::vector<int> skinned;  ///< nodes whose mesh is placed by its skin
};

} // namespace

static Result<std::vector<int>> parentsOf(const Model& model) {
    std::vector<int> parents(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children) {
            if (child < 0 || std::size_t(child) >= parents.size())
                return fail(fmt::format("nodes[{}].children: {} is out of range", i, child));
            if (parents[std::size_t(child)] != -1)
                return fail(fmt::format("nodes[{}]: has two parents, {} and {}", child,
                                        parents[std::size_t(child)], i));
            parents[std::size_t(child)] = int(i);
        }
    // Walks up from every node; reaching the same walk again is a cycle, reaching an earlier one is
    // not.
    std::vector<std::size_t> walk(parents.size(), 0);
    for (std::size_t i = 0; i < parents.size(); ++i)
        for (int ancestor = int(i); ancestor >= 0; ancestor = parents[std::size_t(ancestor)]) {
            std::size_t& mark = walk[std::size_t(ancestor)];
            if (mark == i + 1)
                return fail(
                    fmt::format("nodes[{}].children: the node is its own ancestor", ancestor));
            if (mark != 0)
                break;
            mark = i + 1;
        }
    return parents;
}

static Result<std::vector<int>> rootsOf(const Model& model, const std::vector<int>& parents) {
    std::vector<int> roots;
    if (model.scenes.empty()) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] < 0)
                roots.push_back(int(i));
        return roots;
    }
    const std::size_t scene = model.defaultScene < 0 ? 0 : std::size_t(model.defaultScene);
    if (scene >= model.scenes.size())
        return fail(fmt::format("scene: {} is out of range", scene));
    std::vector<bool> seen(model.nodes.size());
    for (const int node : model.scenes[scene].nodes) {
        if (node < 0 || std::size_t(node) >= model.nodes.size())
            return fail(fmt::format("scenes[{}].nodes: {} is out of range", scene, node));
        if (seen[std::size_t(node)] || parents[std::size_t(node)] >= 0)
            return fail(
                fmt::format("scenes[{}].nodes: {} is not a root, or there twice", scene, node));
        seen[std::size_t(node)] = true;
        roots.push_back(node);
    }
    return roots;
}

static Result<AccessorValues> instanceAttribute(const Model& model,
                                                const tinygltf::Value& attributes, const char* name,
                                                std::uint32_t components) {
    if (!attributes.Has(name))
        return AccessorValues{};
    const tinygltf::Value& index = attributes.Get(name);
    Result<AccessorValues> values = readNumbers(model, index.IsInt() ? index.GetNumberAsInt() : -1);
    if (values && values->components != components)
        return fail(fmt::format("{}: not {} components", name, components));
    return values;
}

/// Reads the transforms of EXT_mesh_gpu_instancing.
static Result<std::vector<Transform>>
readInstances(const Model& model, const tinygltf::Value& value, GltfRepairs& repairs) {
    if (!value.IsObject() || !value.Has("attributes") || !value.Get("attributes").IsObject())
        return fail("attributes: missing");
    const tinygltf::Value& attributes = value.Get("attributes");
    const Result<AccessorValues> t = instanceAttribute(model, attributes, "TRANSLATION", 3);
    const Result<AccessorValues> r = instanceAttribute(model, attributes, "ROTATION", 4);
    const Result<AccessorValues> s = instanceAttribute(model, attributes, "SCALE", 3);
    for (const auto* each : {&t, &r, &s})
        if (!*each)
            return tl::make_unexpected(each->error());
    const std::size_t count = std::max({t->count(), r->count(), s->count()});
    std::vector<Transform> out;
    for (std::size_t i = 0; i < count; ++i) {
        Transform one;
        for (const auto* each : {&t, &r, &s})
            if ((*each)->count() != 0 && (*each)->count() != count)
                return fail("attributes: of different counts");
        if (t->count())
            one.translation = {t->row(i)[0], t->row(i)[1], t->row(i)[2]};
        if (r->count())
            one.rotation = glm::quat(r->row(i)[3], r->row(i)[0], r->row(i)[1], r->row(i)[2]);
        if (s->count())
            one.scale = {s->row(i)[0], s->row(i)[1], s->row(i)[2]};
        if (!finite(one))
            repairs.add("instances with numbers not finite left out");
        else if (normalise(one, repairs))
            out.push_back(one);
    }
    return out;
}

static Result<void> addInstancedMeshes(NodeReader& reader, const tinygltf::Value& value,
                                       ObjectId id, const Node& node,
                                       const std::vector<std::uint32_t>& meshes) {
    const Result<std::vector<Transform>> transforms =
        readInstances(reader.model, value, reader.repairs);
    if (!transforms)
        return fail(fmt::format("extensions.{}.{}", kInstancing, transforms.error().message));
    for (std::size_t i = 0; i < transforms->size(); ++i) {
        Node instance;
        instance.name = fmt::format("{} {}", node.name, i);
        instance.parent = id;
        instance.transform = (*transforms)[i];
        instance.meshes = meshes;
        addObject(reader.document, std::move(instance));
    }
    return {};
}

/// What KHR_node_visibility says of a node. Nothing below a node that is not visible is.
static bool isVisible(const tinygltf::Node& source) {
    const auto found = source.extensions.find("KHR_node_visibility");
    if (found == source.extensions.end() || !found->second.Has("visible"))
        return true;
    const tinygltf::Value& visible = found->second.Get("visible");
    return !visible.IsBool() || visible.Get<bool>();
}

static Result<void> addNode(NodeReader& reader, const Visit& visit) {
    const auto index = std::size_t(visit.node);
    const tinygltf::Node& source = reader.model.nodes[index];
    Node node;
    node.name = source.name.empty() ? fmt::format("Node {}", index) : source.name;
    node.parent = visit.parent;
    node.visible = readTransform(source, node.transform, reader.repairs) && isVisible(source);
    if (!finite(node.transform))
        return fail(fmt::format("nodes[{}]: transform is not finite", index));

    const auto instancing = source.extensions.find(kInstancing);
    const bool instanced = source.mesh >= 0 && instancing != source.extensions.end();
    const bool skinned = source.mesh >= 0 && source.skin >= 0;
    if (skinned)
        reader.skinned.push_back(visit.node);
    else if (source.mesh >= 0 && !instanced)
        node.meshes = reader.meshes.of(index);
    const ObjectId id = reader.ids[index] = addObject(reader.document, node);
    if (instanced && !skinned)
        if (Result<void> added =
                addInstancedMeshes(reader, instancing->second, id, node, reader.meshes.of(index));
            !added)
            return fail(fmt::format("nodes[{}].{}", index, added.error().message));
    return {};
}

/// Adds a skinned mesh, whose vertices are where its joints have them: glTF ignores the transform
/// of its node.
static void addSkinned(NodeReader& reader, std::size_t index, const glm::dvec3& origin,
                       bool visible) {
    const tinygltf::Node& source = reader.model.nodes[index];
    Node node;
    node.name = source.name.empty() ? fmt::format("Skinned {}", index) : source.name;
    node.meshes = reader.meshes.of(index);
    node.transform.translation = origin;
    node.visible = visible;
    addObject(reader.document, std::move(node));
}

Result<NodesOfGltf> addNodes(Document& document, const Model& model, const MeshesOfGltf& meshes,
                             std::span<const SkinPose> skins, std::span<const ProfileRef> profiles,
                             std::span<const Mesh> placed, GltfRepairs& repairs) {
    const Result<std::vector<int>> parents = parentsOf(model);
    if (!parents)
        return tl::make_unexpected(parents.error());
    const Result<std::vector<int>> roots = rootsOf(model, *parents);
    if (!roots)
        return tl::make_unexpected(roots.error());
    NodeReader reader{document, model, meshes, repairs, {}, {}};
    reader.ids.assign(model.nodes.size(), 0);
    std::vector<Visit> stack;
    for (auto root = roots->rbegin(); root != roots->rend(); ++root)
        stack.push_back({*root, 0});
    std::vector<int> visited;
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        visited.push_back(visit.node);
        if (const Result<void> added = addNode(reader, visit); !added)
            return tl::make_unexpected(added.error());
        const std::vector<int>& children = model.nodes[std::size_t(visit.node)].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            stack.push_back({*child, reader.ids[std::size_t(visit.node)]});
    }
    std::vector<bool> hidden(model.nodes.size());
    for (const int node : visited) { // parents before children
        const auto n = std::size_t(node);
        hidden[n] = !isVisible(model.nodes[n]) ||
                    ((*parents)[n] >= 0 && hidden[std::size_t((*parents)[n])]);
    }
    for (const int node : reader.skinned)
        addSkinned(reader, std::size_t(node), skins[std::size_t(node)].origin,
                   !hidden[std::size_t(node)]);
    document.origin = originOf(document, placed);
    Placements placements(document);
    NodesOfGltf result;
    result.ids = reader.ids;
    result.lights.resize(model.lights.size());
    for (const int node : visited) {
        const auto n = std::size_t(node);
        ObjectId added = document.nextId;
        const std::optional<std::size_t> light =
            addLightAndCamera(document, model, profiles, n,
                              glm::mat4(placements.of(reader.ids[n]).toWorld), !hidden[n], repairs);
        if (light)
            result.lights[*light].push_back(added); // the first of them
        for (; added < document.nextId; ++added)
            result.carried.push_back({added, reader.ids[n]});
    }
    return result;
}

} // namespace limn
