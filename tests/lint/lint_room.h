// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gallery/mesh_builder.h"
#include "engine/lint/lint.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace limn::lint_test {

/// A document and its assets, to plant faults in.
struct LintRoom {
    Document document;
    std::shared_ptr<Assets> assets = std::make_shared<Assets>();
    std::vector<std::string> repairs;

    /// Adds a material of that albedo. Meshes name it by the number of materials before it.
    std::uint32_t addMaterial(const std::string& name, glm::vec3 albedo) {
        Material material;
        material.name = name;
        material.baseColor = glm::vec4(albedo, 1);
        materials.push_back(addObject(document, material));
        return std::uint32_t(materials.size() - 1);
    }
    Material& material(std::uint32_t index) {
        return std::get<Material>(document.objects.at(materials[index]));
    }
    /// Adds a mesh and a node that shows it; returns the node.
    ObjectId add(const std::string& name, Mesh mesh, std::uint32_t material,
                 Transform transform = {}) {
        mesh.material = material;
        mesh.name = name;
        assets->meshes.push_back(std::move(mesh));
        Node node;
        node.name = name;
        node.transform = transform;
        node.meshes = {std::uint32_t(assets->meshes.size() - 1)};
        return addObject(document, node);
    }
    Mesh& meshOf(ObjectId node) {
        return assets->meshes[std::get<Node>(document.objects.at(node)).meshes[0]];
    }
    std::vector<Finding> lint() const {
        const Scene scene = flatten(document, assets);
        const TraceScene trace(scene);
        return *lintScene({document, scene, trace, repairs});
    }

    std::vector<ObjectId> materials;
};

inline Mesh boxMesh(glm::dvec3 lower, glm::dvec3 upper, unsigned faces = AllFaces) {
    Mesh mesh;
    addBox(mesh, lower, upper, faces);
    projectUvs(mesh, 1);
    return mesh;
}

/// An image of two texels that differ.
inline Image twoTexels() {
    Image image;
    image.width = 2;
    image.height = 1;
    image.rgba = {200, 60, 60, 255, 60, 60, 200, 255};
    return image;
}

/// Two rooms of 5 x 3 x 4 m with walls of 30 cm and a doorway between them, a crate, a table and a
/// lamp in each: nothing is wrong with it. Materials 0 to 2: walls, wood with a texture, glow.
struct CleanRoom : LintRoom {
    ObjectId shell = 0, crate = 0, table = 0, lamp = 0;

    CleanRoom() {
        assets->images.push_back(twoTexels());
        addMaterial("plaster", {0.7f, 0.7f, 0.65f});
        addMaterial("wood", {0.8f, 0.8f, 0.8f});
        addMaterial("paint", {0.3f, 0.5f, 0.4f});
        material(1).baseColorTexture.image = 0;
        Mesh walls;
        const double t = 0.3;
        addBox(walls, {-5.3, -t, -2.3}, {5.3, 0, 2.3});
        addBox(walls, {-5.3, 3, -2.3}, {5.3, 3 + t, 2.3});
        addBox(walls, {-5.3, 0, -2.3}, {5.3, 3, -2});
        addBox(walls, {-5.3, 0, 2}, {5.3, 3, 2.3});
        addBox(walls, {-5.3, 0, -2}, {-5, 3, 2});
        addBox(walls, {5, 0, -2}, {5.3, 3, 2});
        addBox(walls, {-0.15, 0, -2}, {0.15, 3, 0.5}); // the doorway is beside it
        shell = add("Shell", walls, 0);
        crate = add("Crate", boxMesh({-3, 0, -1}, {-2, 1, 0}), 1);
        Mesh top;
        addBox(top, {2, 0, -1}, {4, 0.8, 0.5});
        table = add("Table", top, 2);
        lamp = addLamp("Lamp", {-1.5f, 2.5f, 1});
        addLamp("Other lamp", {2.5f, 2.5f, 1});
        Camera camera;
        camera.name = "Camera";
        camera.eye = {-4, 1.6f, 1.5f};
        camera.target = {-2, 1, 0};
        addObject(document, camera);
    }
    ObjectId addLamp(const std::string& name, glm::vec3 position) {
        Light light;
        light.name = name;
        light.position = position;
        light.strength = 60;
        return addObject(document, light);
    }
    Light& light(ObjectId id) { return std::get<Light>(document.objects.at(id)); }
};

} // namespace limn::lint_test
