// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace limn {

/// Kinds of random changes to a scene.
enum class Shake {
    MoveLight,
    ChangeLight,
    SwitchLight,
    AddLight,
    RemoveLight,
    ChangeMaterial,
    ChangeSky,
    MoveObject
};
inline constexpr std::array<std::string_view, 8> kShakeNames = {
    "move_light",   "change_light",    "switch_light", "add_light",
    "remove_light", "change_material", "change_sky",   "move_object"};

/// Changes a scene at random in ways that need no new bake. The same seed makes the same changes.
class RandomScene {
public:
    /// Appends two dynamic instances, copies of the scene's smallest one.
    RandomScene(const Scene& scene, std::uint32_t seed);

    Scene scene;

    Shake shake(); ///< makes one change

    float number(); ///< [0, 1)
    std::uint32_t below(std::uint32_t end);

private:
    glm::vec3 point();
    glm::vec3 direction();
    void changeLight(Light& light);
    void changeMaterial(Material& material);
    void moveObject(Instance& instance);

    std::uint32_t m_state;
    std::size_t m_firstObject; ///< index of the first added instance
    Instance m_object;         ///< as copied
    glm::vec3 m_objectCentre;
};

} // namespace limn
