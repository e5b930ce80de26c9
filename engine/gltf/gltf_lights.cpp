// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_lights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

/// Unit world direction of the node's local axis, or `otherwise` if the matrix is singular.
static glm::vec3 axis(const glm::mat4& toWorld, glm::vec3 local, glm::vec3 otherwise) {
    const glm::dvec3 d = glm::dmat3(toWorld) * glm::dvec3(local);
    const double length = glm::length(d);
    return length > 0 && std::isfinite(length) ? glm::vec3(d / length) : otherwise;
}

static float notNegative(double value, GltfRepairs& repairs) {
    const float f = float(value);
    if (f >= 0 && std::isfinite(f))
        return f;
    repairs.add("light numbers negative or not finite set to 0");
    return 0;
}

static float lightNumber(double value, GltfRepairs& repairs) {
    const float f = notNegative(value, repairs);
    if (f > kMaxLight)
        repairs.add("light numbers above 1e10 set to it");
    return std::min(f, kMaxLight);
}

static void readSpot(Light& light, const tinygltf::SpotLight& spot, GltfRepairs& repairs) {
    const double half = glm::half_pi<double>();
    light.outerAngle = float(std::clamp(spot.outerConeAngle, 1e-3, half));
    light.innerAngle =
        float(std::clamp(spot.innerConeAngle, 0.0, double(light.outerAngle) * 0.9999));
    if (std::abs(double(light.outerAngle) - spot.outerConeAngle) > 1e-5 ||
        std::abs(double(light.innerAngle) - spot.innerConeAngle) > 1e-3)
        repairs.add("spot cones outside 0 <= inner < outer <= 90 degrees brought into it");
}

static void addLight(Document& document, const tinygltf::Light& source, const std::string& nodeName,
                     const glm::mat4& toWorld, bool visible, GltfRepairs& repairs) {
    Light light;
    if (source.type == "directional") {
        light.kind = LightKind::Directional;
    } else if (source.type == "spot") {
        light.kind = LightKind::Spot;
        readSpot(light, source.spot, repairs);
    } else if (source.type != "point") {
        repairs.add("lights of unknown type left out");
        return;
    }
    light.name = !nodeName.empty() ? nodeName : !source.name.empty() ? source.name : "Light";
    light.position = glm::vec3(toWorld[3]);
    light.direction = axis(toWorld, {0, 0, -1}, {0, -1, 0});
    if (source.color.size() == 3)
        for (int c = 0; c < 3; ++c)
            light.color[c] = lightNumber(source.color[std::size_t(c)], repairs);
    light.strength = lightNumber(source.intensity, repairs);
    light.enabled = visible;
    light.range = notNegative(source.range, repairs);
    addObject(document, light);
}

static void addCamera(Document& document, const tinygltf::Camera& source,
                      const std::string& nodeName, const glm::mat4& toWorld, GltfRepairs& repairs) {
    if (source.type != "perspective") {
        repairs.add("orthographic cameras left out");
        return;
    }
    const float fovY = float(source.perspective.yfov);
    if (!(fovY > 0.001f && fovY < 3.14f)) {
        repairs.add("cameras with a field of view outside 0 to 180 degrees left out");
        return;
    }
    Camera camera;
    camera.name = !nodeName.empty() ? nodeName : !source.name.empty() ? source.name : "Camera";
    camera.fovY = fovY;
    camera.eye = glm::vec3(toWorld[3]);
    // Far from the origin, floats cannot distinguish a point one metre ahead.
    const float ahead = std::max({1.f, 1e-3f * std::abs(camera.eye.x),
                                  1e-3f * std::abs(camera.eye.y), 1e-3f * std::abs(camera.eye.z)});
    camera.target = camera.eye + ahead * axis(toWorld, {0, 0, -1}, {0, 0, -1});
    camera.up = axis(toWorld, {0, 1, 0}, {0, 1, 0});
    addObject(document, camera);
}

void addLightAndCamera(Document& document, const tinygltf::Model& model, std::size_t index,
                       const glm::mat4& toWorld, bool visible, GltfRepairs& repairs) {
    const tinygltf::Node& node = model.nodes[index];
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension != node.extensions.end() && extension->second.IsObject() &&
        extension->second.Has("light") && extension->second.Get("light").IsInt()) {
        const int light = extension->second.Get("light").GetNumberAsInt();
        if (light < 0 || std::size_t(light) >= model.lights.size())
            repairs.sentences.push_back(
                fmt::format("nodes[{}]: light {} does not exist", index, light));
        else
            addLight(document, model.lights[std::size_t(light)], node.name, toWorld, visible,
                     repairs);
    }
    if (node.camera >= 0 && std::size_t(node.camera) < model.cameras.size())
        addCamera(document, model.cameras[std::size_t(node.camera)], node.name, toWorld, repairs);
}

} // namespace limn
