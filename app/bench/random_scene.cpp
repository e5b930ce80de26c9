// SPDX-License-Identifier: MIT
#include "app/bench/random_scene.h"

#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxLights = 8;
constexpr float kPi = std::numbers::pi_v<float>;

} // namespace

RandomScene::RandomScene(const Scene& start, std::uint32_t seed)
    : scene(start), m_state(mixBits(seed + 1)), m_firstObject(start.instances.size()) {
    float smallest = std::numeric_limits<float>::max();
    for (const Instance& i : start.instances) {
        const Bounds b = worldBounds(start, i);
        if (const float size = glm::length(b.size()); size > 0 && size < smallest) {
            smallest = size;
            m_object = i;
            m_objectCentre = b.centre();
        }
    }
    if (start.instances.empty())
        return;
    m_object.dynamic = true;
    for (int k = 0; k < 2; ++k)
        moveObject(scene.instances.emplace_back(m_object));
}

float RandomScene::number() {
    m_state += 0x9e3779b9U;
    return unitFloat(mixBits(m_state));
}

std::uint32_t RandomScene::below(std::uint32_t end) {
    return std::min(std::uint32_t(number() * float(end)), end - 1);
}

glm::vec3 RandomScene::point() { // now and then outside
    const glm::vec3 share = glm::vec3(number(), number(), number()) * 1.2f - 0.1f;
    return scene.bounds.lower + share * scene.bounds.size();
}

glm::vec3 RandomScene::direction() {
    const float z = 2 * number() - 1, angle = 2 * kPi * number(), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

void RandomScene::changeLight(Light& light) {
    light.kind = LightKind(below(4));
    light.color = {number(), number(), number()};
    light.strength = std::pow(10.f, 12 * number() - 6); // from next to nothing to far too much
    light.range = number() < 0.3f ? number() * glm::length(scene.bounds.size()) : 0;
    light.outerAngle = 0.05f + 1.5f * number();
    light.innerAngle = light.outerAngle * number();
    light.size = glm::vec2(0.01f + number(), 0.01f + number());
}

void RandomScene::changeMaterial(Material& m) {
    m.baseColor = {number(), number(), number(), m.baseColor.w};
    m.metallic = number();
    m.roughness = number();
    m.transmission = number() < 0.2f ? number() : 0;
    m.ior = number() < 0.2f ? 1 + number() : 1.5f;
    m.emission = number() < 0.2f ? glm::vec3(number(), number(), number()) * 5.f : glm::vec3(0);
}

void RandomScene::moveObject(Instance& instance) {
    const glm::mat4 turn = glm::rotate(glm::mat4(1), 2 * kPi * number(), direction());
    instance.toWorld = glm::translate(glm::mat4(1), point()) * turn *
                       glm::translate(glm::mat4(1), -m_objectCentre) * m_object.toWorld;
    instance.normalToWorld = glm::mat3(turn) * m_object.normalToWorld;
}

Shake RandomScene::shake() {
    const auto lights = std::uint32_t(scene.lights.size());
    Shake what = Shake(below(std::uint32_t(kShakeNames.size())));
    const bool ofLight = what <= Shake::SwitchLight || what == Shake::RemoveLight;
    if (ofLight && lights == 0)
        what = Shake::AddLight;
    if (what == Shake::AddLight && lights >= kMaxLights)
        what = Shake::RemoveLight;
    if (what == Shake::MoveObject && m_firstObject == scene.instances.size())
        what = Shake::ChangeSky;
    if (what == Shake::ChangeMaterial && scene.materials.empty())
        what = Shake::ChangeSky;
    switch (what) {
    case Shake::MoveLight: {
        Light& light = scene.lights[below(lights)];
        light.position = point();
        light.direction = direction();
        break;
    }
    case Shake::ChangeLight:
        changeLight(scene.lights[below(lights)]);
        break;
    case Shake::SwitchLight: {
        Light& light = scene.lights[below(lights)];
        light.enabled = !light.enabled;
        break;
    }
    case Shake::AddLight: {
        Light& light = scene.lights.emplace_back();
        light.position = point();
        light.direction = direction();
        changeLight(light);
        break;
    }
    case Shake::RemoveLight:
        scene.lights.erase(scene.lights.begin() + below(lights));
        break;
    case Shake::ChangeMaterial:
        changeMaterial(scene.materials[below(std::uint32_t(scene.materials.size()))]);
        break;
    case Shake::ChangeSky:
        scene.sky.radiance =
            number() < 0.5f ? glm::vec3(0) : glm::vec3(number(), number(), number());
        break;
    case Shake::MoveObject:
        moveObject(scene.instances[m_firstObject +
                                   below(std::uint32_t(scene.instances.size() - m_firstObject))]);
        break;
    }
    return what;
}

} // namespace limn
