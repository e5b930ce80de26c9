// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"
#include "engine/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace limn {

/// Kinds of scenes that generateScene() makes.
enum class SceneKind {
    Room,         ///< lit by lamps or through windows
    TwoRooms,     ///< one lit, the other one sealed and dark beside it: what shines there is a leak
    Court,        ///< walls round a court under the open sky
    Colonnade,    ///< a roof between a wall and a row of round columns
    Street,       ///< between two rows of houses
    Cave,         ///< a displaced closed surface, or one with an opening
    FurnishedBox, ///< a room with many small thin pieces: shelves, frames, tables
    Blinds,       ///< sun through slats
    DoorAjar,     ///< a dark room beside a lit one, the door between them ajar
    Lamps,        ///< a closed room with glowing spheres, tubes, panels and textured signs
    HouseOnPlane  ///< a small house on a very large ground
};
inline constexpr std::array<std::string_view, 11> kSceneKindNames = {
    "room",          "two_rooms", "court",     "colonnade", "street",        "cave",
    "furnished_box", "blinds",    "door_ajar", "lamps",     "house_on_plane"};

/// A static, lit scene made by a program.
struct GeneratedScene {
    SceneKind kind = SceneKind::Room;
    Document document; ///< with one camera, inside, that sees lit surfaces
    std::shared_ptr<const Assets> assets;
    /// TwoRooms: in the room that no light reaches, where a true picture is black.
    std::optional<Camera> darkCamera;
    std::string description; ///< what was drawn, for people: "x 10, solid walls 0.31 m, ..."
};

/// The scene of a seed, of kind `seed` modulo the number of kinds. The seed chooses dimensions,
/// scale (0.01 to 100), thickness of walls (none to 1 m, times the scale), tessellation, whether
/// there is one mesh per material or many, sides, albedo, textures and lights. The same scene on
/// every machine: nothing but integers, and arithmetic whose rounding IEEE 754 prescribes, decides;
/// sines of curved surfaces are rounded to 2^-13 m before they matter. Meshes keep what the
/// importer guarantees.
GeneratedScene generateScene(std::uint64_t seed);

GeneratedScene generateScene(SceneKind kind, std::uint64_t seed);

} // namespace limn
