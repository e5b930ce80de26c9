// SPDX-License-Identifier: MIT
#include "engine/export/gltf_light_json.h"

#include "engine/export/vector_json.h"
#include "engine/scene/light/photometry.h"
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// A frame at `position` whose -Z axis is `direction` and whose X axis is `across`.
glm::mat4 frame(glm::vec3 position, glm::vec3 direction, glm::vec3 across) {
    const glm::vec3 z = -direction;
    return {glm::vec4(across, 0), glm::vec4(glm::cross(z, across), 0), glm::vec4(z, 0),
            glm::vec4(position, 1)};
}

glm::vec3 anyAcross(glm::vec3 direction) {
    const glm::vec3 other = glm::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(other, direction));
}

const char* typeOf(LightKind kind) {
    switch (kind) {
    case LightKind::Directional:
        return "directional";
    case LightKind::Point:
        return "point";
    case LightKind::Spot:
        return "spot";
    case LightKind::Rectangle:
        break;
    }
    return "";
}

} // namespace

Json matrixJson(const glm::mat4& m) {
    Json json = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            json.push_back(m[column][row]);
    return json;
}

Json lightJson(const Light& whole) {
    const Light light = withoutProfile(whole);
    // Colours end at 1; what is brighter is in the intensity.
    const glm::vec3 c = light.color;
    const float maximum = std::max({c.x, c.y, c.z, 1.f});
    Json json = {{"name", light.name},
                 {"type", typeOf(light.kind)},
                 {"color", {c.x / maximum, c.y / maximum, c.z / maximum}},
                 {"intensity", light.strength * maximum}};
    if (light.kind != LightKind::Directional && light.range > 0)
        json["range"] = light.range;
    if (light.kind == LightKind::Spot)
        json["spot"] = {{"innerConeAngle", light.innerAngle}, {"outerConeAngle", light.outerAngle}};
    return json;
}

Json lightNode(const Light& light, std::size_t index) {
    Json node = {
        {"name", light.name},
        {"matrix", matrixJson(frame(light.position, light.direction, anyAcross(light.direction)))}};
    node["extensions"]["KHR_lights_punctual"]["light"] = index;
    return node;
}

Json rectangleNode(const Light& light) {
    const LightRectangle rectangle = lightRectangle(light);
    const glm::vec3 radiance = light.color * light.strength;
    Json node = {{"name", light.name},
                 {"matrix", matrixJson(frame(rectangle.centre, rectangle.normal,
                                             glm::normalize(rectangle.halfWidth)))}};
    node["extras"]["limn"] = {{"light", "rectangle"},
                              {"size", {light.size.x, light.size.y}},
                              {"radiance", vectorJson(radiance)}};
    return node;
}

Json cameraJson(const Camera& camera, float zNear) {
    return {{"name", camera.name},
            {"type", "perspective"},
            {"perspective", {{"yfov", camera.fovY}, {"znear", zNear}}}};
}

Json cameraNode(const Camera& camera, std::size_t index) {
    return {{"name", camera.name},
            {"camera", index},
            {"matrix", matrixJson(glm::inverse(viewMatrix(camera)))}};
}

} // namespace limn
