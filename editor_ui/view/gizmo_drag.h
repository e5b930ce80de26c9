// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/gesture.h"
#include "editor_ui/document/manipulation.h"
#include "editor_ui/view/gizmo_math.h"

#include <string>
#include <vector>

namespace limn {

/// Whose axes a gizmo has.
enum class GizmoSpace { World, Local, View };

/// Ranges of the steps below.
inline constexpr float kMaxMoveStep = 100;                          ///< [m]
inline constexpr float kMinRotateStep = 0.1f, kMaxRotateStep = 180; ///< [degrees]
inline constexpr float kMinScaleStep = 0.001f, kMaxScaleStep = 10;

/// How gizmos work; remembered from one start to the next.
struct GizmoSettings {
    GizmoSpace space = GizmoSpace::World;
    bool snap = false;        ///< snaps without Ctrl, and not with it
    float moveStep = 0;       ///< [m]; 0: a round step of about a tenth of an arrow
    float rotateStep = 15;    ///< [degrees]
    float scaleStep = 0.1f;   ///< [1]
    bool blenderKeys = false; ///< R rotates at once instead of choosing the scale gizmo

    bool operator==(const GizmoSettings&) const = default;
};

/// Properties of a light that a handle in the picture changes.
enum class LightPart { None, Direction, OuterCone, InnerCone, Range, Width, Height };

/// A drag of a gizmo, by its handle or after a key.
struct GizmoDrag {
    Tool tool = Tool::Move;
    Handle handle = Handle::None;
    LightPart part = LightPart::None; ///< dragged instead of a gizmo
    GizmoFrame frame;
    glm::vec2 start{0};              ///< where the mouse was [px]
    ObjectsById objects;             ///< as they were at the start
    std::vector<ObjectId> selection; ///< at the start
    glm::vec3 surface{0};            ///< PickedSurface::position at the start
    bool grabbed = false;            ///< began with a key: follows the mouse without a button
    bool duplicates = false;         ///< makes copies as soon as the mouse moves
    float angle = 0;                 ///< of the mouse about the origin, with whole turns [rad]
    float turned = 0;                ///< what that has come to, snapped or typed [rad]
    std::string typed;               ///< number in place of the mouse: metres, degrees or a factor
};

/// Modifier keys held during this frame of a drag.
struct DragKeys {
    bool snap = false;
    bool fine = false; ///< a tenth of the way
};

/// Takes a character typed during a drag: digits, point and minus make a number; x, y and z choose
/// an axis, the same one again frees it; X, Y and Z choose the two others. Returns false for any
/// other character.
bool typeIntoDrag(GizmoDrag& drag, unsigned character);

/// The number typed so far; std::nullopt if there is none.
std::optional<float> typedNumber(const GizmoDrag& drag);

/// What the drag does with the mouse at `mouse` [px]; std::nullopt while that cannot be told. Keeps
/// count of whole turns in `drag`. Scales are never 0.
std::optional<Manipulation> dragManipulation(const Picture& picture, GizmoDrag& drag,
                                             const GizmoSettings& settings, glm::vec2 mouse,
                                             DragKeys keys);

/// What the drag has come to, with its unit: "Move X +1.250 m".
std::string dragText(const GizmoDrag& drag, const Manipulation& manipulation);

} // namespace limn
