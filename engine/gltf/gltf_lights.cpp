// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_lights.h"

#include "engine/gltf/gltf_value.h"
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

/// Unit world direction of the node's local axis, or `otherwise` if the matrix is singular.
static glm::vec3 axis(const glm::mat4& toWorld, glm::vec3 local, glm::vec3 otherwise) {
    const glm::dvec3 d = glm::dmat3(toWorld) * glm::dvec3(local);
    const double length = glm::length(d);
    return length > 0 && std::isfinite(length) ? glm::vec3(d / length) : otherwise;
}

/// The name of a light whose node may have one.
static std::string lightName(const std::string& nodeName, const std::string& name) {
    return !nodeName.empty() ? nodeName : !name.empty() ? name : "Light";
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

/// Nothing if it is of no known type.
static std::optional<Light> punctualLight(const tinygltf::Light& source,
                                          const std::string& nodeName, const glm::mat4& toWorld,
                                          bool visible, GltfRepairs& repairs) {
    Light light;
    if (source.type == "directional") {
        light.kind = LightKind::Directional;
    } else if (source.type == "spot") {
        light.kind = LightKind::Spot;
        readSpot(light, source.spot, repairs);
    } else if (source.type != "point") {
        repairs.add("lights of unknown type left out");
        return {};
    }
    light.name = lightName(nodeName, source.name);
    light.position = glm::vec3(toWorld[3]);
    light.direction = axis(toWorld, {0, 0, -1}, {0, -1, 0});
    if (source.color.size() == 3)
        for (int c = 0; c < 3; ++c)
            light.color[c] = lightNumber(source.color[std::size_t(c)], repairs);
    light.strength = lightNumber(source.intensity, repairs);
    light.enabled = visible;
    light.range = notNegative(source.range, repairs);
    return light;
}

/// The member `color` of an extension's light; white where it has none.
static glm::vec3 colorOf(const tinygltf::Value& source, GltfRepairs& repairs) {
    const tinygltf::Value* color = member(source, "color");
    glm::vec3 result(1);
    for (int c = 0; color && color->IsArray() && color->ArrayLen() == 3 && c < 3; ++c)
        result[c] = lightNumber(double(number(&color->Get(c), 1)), repairs);
    return result;
}

/// Light::roll of a light that its node's X axis turns.
static float rollOf(const Light& light, const glm::mat4& toWorld) {
    return rollTowards(light, axis(toWorld, {1, 0, 0}, lightRectangle(light).halfWidth));
}

/// Adds a light of EXT_lights_area, whose size grows with the largest scale of its node.
static void addAreaLight(Document& document, const tinygltf::Value& source,
                         const std::string& nodeName, const glm::mat4& toWorld, bool visible,
                         GltfRepairs& repairs) {
    const auto textOf = [&](const char* key) {
        const tinygltf::Value* value = member(source, key);
        return value && value->IsString() ? value->Get<std::string>() : std::string();
    };
    const std::string type = textOf("type"), name = textOf("name");
    if (type != "rect" && type != "disk") {
        repairs.add("area lights of unknown type left out");
        return;
    }
    Light light{.kind = LightKind::Rectangle, .enabled = visible};
    light.name = lightName(nodeName, name);
    light.position = glm::vec3(toWorld[3]);
    light.direction = axis(toWorld, {0, 0, -1}, {0, -1, 0});
    light.color = colorOf(source, repairs);
    light.strength = lightNumber(double(number(member(source, "intensity"), 1000)), repairs);
    const float scale =
        std::max({glm::length(glm::vec3(toWorld[0])), glm::length(glm::vec3(toWorld[1])),
                  glm::length(glm::vec3(toWorld[2]))});
    const float size = scale * notNegative(double(number(member(source, "size"), 1)), repairs);
    const tinygltf::Value* rectangle = member(source, "rect");
    if (type == "disk") {
        repairs.add("round lights shown as squares of the same area");
        light.size = glm::vec2(size * std::sqrt(glm::pi<float>()) / 2);
    } else {
        const tinygltf::Value* aspect = rectangle ? member(*rectangle, "aspect") : nullptr;
        light.size = {size * notNegative(double(number(aspect, 1)), repairs), size};
    }
    light.size = glm::clamp(light.size, kMinLightSize, kMaxLightSize);
    light.roll = rollOf(light, toWorld);
    addObject(document, light);
}

/// Gives a point or spot light the profile and the strength that its node's EXT_lights_ies says.
static void setProfile(Light& light, const tinygltf::Value& use, const ProfileRef& profile,
                       const glm::mat4& toWorld, GltfRepairs& repairs) {
    light.profile = profile;
    light.roll = rollOf(light, toWorld);
    light.color = colorOf(use, repairs);
    const float multiplier = number(member(use, "multiplier"), 1);
    light.strength = lightNumber(double(multiplier) * double(profile->peak), repairs);
}

/// The light that a node's EXT_lights_area names; null if there is none.
static const tinygltf::Value* areaLightOf(const tinygltf::Model& model,
                                          const tinygltf::Node& node) {
    constexpr const char* kArea = "EXT_lights_area";
    const auto named = node.extensions.find(kArea), all = model.extensions.find(kArea);
    if (named == node.extensions.end() || all == model.extensions.end())
        return nullptr;
    const std::optional<std::size_t> index = wholeNumber(member(named->second, "light"));
    const tinygltf::Value* lights = member(all->second, "lights");
    if (!index || !lights || !lights->IsArray() || *index >= lights->ArrayLen())
        return nullptr;
    return &lights->Get(int(*index));
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

/// What a node's EXT_lights_ies says, and the profile that it names; none if that could not be
/// read.
struct ProfileUse {
    const tinygltf::Value* use = nullptr;
    ProfileRef profile;
};

static ProfileUse profileUseOf(const tinygltf::Node& node, std::span<const ProfileRef> profiles,
                               std::size_t index, GltfRepairs& repairs) {
    const auto use = node.extensions.find("EXT_lights_ies");
    if (use == node.extensions.end())
        return {};
    const std::optional<std::size_t> light = wholeNumber(member(use->second, "light"));
    if (light && *light < profiles.size())
        return {&use->second, profiles[*light]};
    repairs.sentences.push_back(
        fmt::format("nodes[{}]: its light of EXT_lights_ies does not exist", index));
    return {};
}

/// The light of a node's KHR_lights_punctual, and its index there.
static std::pair<std::optional<Light>, std::size_t>
punctualLightOf(const tinygltf::Model& model, std::size_t index, const glm::mat4& toWorld,
                bool visible, GltfRepairs& repairs) {
    const tinygltf::Node& node = model.nodes[index];
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end() || !extension->second.IsObject() ||
        !extension->second.Has("light") || !extension->second.Get("light").IsInt())
        return {};
    const int light = extension->second.Get("light").GetNumberAsInt();
    if (light < 0 || std::size_t(light) >= model.lights.size()) {
        repairs.sentences.push_back(
            fmt::format("nodes[{}]: light {} does not exist", index, light));
        return {};
    }
    return {punctualLight(model.lights[std::size_t(light)], node.name, toWorld, visible, repairs),
            std::size_t(light)};
}

std::optional<std::size_t> addLightAndCamera(Document& document, const tinygltf::Model& model,
                                             std::span<const ProfileRef> profiles,
                                             std::size_t index, const glm::mat4& toWorld,
                                             bool visible, GltfRepairs& repairs) {
    const tinygltf::Node& node = model.nodes[index];
    std::optional<std::size_t> added;
    auto [light, punctual] = punctualLightOf(model, index, toWorld, visible, repairs);
    const auto [use, profile] = profileUseOf(node, profiles, index, repairs);
    // A light without its profile is there for those who cannot read one.
    const bool isOne = light && light->kind != LightKind::Directional && profile;
    if (light && !isOne) {
        addObject(document, *light);
        added = punctual;
    }
    if (profile) {
        if (!isOne) {
            light = Light{.kind = LightKind::Point, .enabled = visible};
            light->name = lightName(node.name, profile->name);
            light->position = glm::vec3(toWorld[3]);
            light->direction = axis(toWorld, {0, 0, -1}, {0, -1, 0});
        }
        setProfile(*light, *use, profile, toWorld, repairs);
        addObject(document, *light);
    }
    if (const tinygltf::Value* area = areaLightOf(model, node))
        addAreaLight(document, *area, node.name, toWorld, visible, repairs);
    if (node.camera >= 0 && std::size_t(node.camera) < model.cameras.size())
        addCamera(document, model.cameras[std::size_t(node.camera)], node.name, toWorld, repairs);
    return added;
}

} // namespace limn
