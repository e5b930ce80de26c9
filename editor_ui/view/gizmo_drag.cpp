// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo_drag.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

namespace {

constexpr float kFine = 0.1f;
constexpr float kMinFactor = 0.01f; ///< of a drag of scale
constexpr std::size_t kMaxTyped = 12;

/// Whether the handle takes the frame's axis `i`.
bool takesAxis(Handle handle, int i) {
    switch (handle) {
    case Handle::X:
    case Handle::Y:
    case Handle::Z:
        return i == int(handle) - int(Handle::X);
    case Handle::YZ:
    case Handle::ZX:
    case Handle::XY:
        return i != int(handle) - int(Handle::YZ);
    case Handle::All:
        return true;
    case Handle::None:
        break;
    }
    return false;
}

/// The axis along which a typed number moves: the first one that the handle takes.
int typedAxis(Handle handle) {
    for (int i = 0; i < 3; ++i)
        if (takesAxis(handle, i))
            return i;
    return 0;
}

void chooseHandle(Handle& handle, Handle wanted) {
    handle = handle == wanted ? Handle::All : wanted;
}

} // namespace

bool typeIntoDrag(GizmoDrag& drag, unsigned c) {
    std::string& typed = drag.typed;
    if (c >= 'x' && c <= 'z') {
        chooseHandle(drag.handle, Handle(int(Handle::X) + int(c - 'x')));
    } else if (c >= 'X' && c <= 'Z') {
        chooseHandle(drag.handle, Handle(int(Handle::YZ) + int(c - 'X')));
    } else if (c == '-') {
        if (typed.starts_with('-'))
            typed.erase(0, 1);
        else
            typed.insert(0, 1, '-');
    } else if ((c >= '0' && c <= '9') ||
               ((c == '.' || c == ',') && typed.find('.') == std::string::npos)) {
        if (typed.size() < kMaxTyped)
            typed += c == ',' ? '.' : char(c);
    } else {
        return false;
    }
    return true;
}

std::optional<float> typedNumber(const GizmoDrag& drag) {
    float number = 0;
    const std::string& typed = drag.typed;
    const auto [end, error] = std::from_chars(typed.data(), typed.data() + typed.size(), number);
    return error == std::errc() && end == typed.data() + typed.size() ? std::optional(number)
                                                                      : std::nullopt;
}

/// A round step of about a tenth of the arrow [m].
static float roundStep(const Picture& picture, glm::vec3 origin) {
    return std::pow(10.f, std::floor(std::log10(arrowLength(picture, origin))));
}

static std::optional<Manipulation> dragMove(const Picture& picture, const GizmoDrag& drag,
                                            const GizmoSettings& settings, glm::vec2 mouse,
                                            DragKeys keys) {
    Manipulation manipulation{.pivot = drag.frame.origin, .axes = drag.frame.axes};
    if (const auto number = typedNumber(drag)) {
        manipulation.move = drag.frame.axes[typedAxis(drag.handle)] * *number;
        return manipulation;
    }
    const auto d = dragDisplacement(picture, drag.handle, drag.frame, drag.start, mouse);
    if (!d)
        return {};
    manipulation.move = *d * (keys.fine ? kFine : 1);
    if (keys.snap) {
        const float step =
            settings.moveStep > 0 ? settings.moveStep : roundStep(picture, drag.frame.origin);
        manipulation.move =
            drag.frame.axes * snapped(glm::transpose(drag.frame.axes) * manipulation.move, step);
    }
    return manipulation;
}

static glm::vec3 turnAxis(const Picture& picture, const GizmoDrag& drag) {
    const glm::vec3 axis = drag.frame.axes * handleAxis(drag.handle);
    return drag.handle == Handle::All ? towardsEye(picture, drag.frame.origin) : axis;
}

static std::optional<Manipulation> dragRotate(const Picture& picture, GizmoDrag& drag,
                                              const GizmoSettings& settings, glm::vec2 mouse,
                                              DragKeys keys) {
    Manipulation manipulation{.pivot = drag.frame.origin, .axes = drag.frame.axes};
    if (const auto number = typedNumber(drag)) {
        drag.turned = glm::radians(*number);
    } else {
        const auto angle = dragAngle(picture, drag.handle, drag.frame, drag.start, mouse);
        if (!angle)
            return {};
        constexpr float kTurn = glm::two_pi<float>();
        drag.angle = *angle + kTurn * std::round((drag.angle - *angle) / kTurn);
        drag.turned = drag.angle * (keys.fine ? kFine : 1);
        const float step = glm::radians(settings.rotateStep);
        if (keys.snap && step > 0)
            drag.turned = std::round(drag.turned / step) * step;
    }
    if (drag.turned != 0)
        manipulation.turn = glm::angleAxis(drag.turned, glm::normalize(turnAxis(picture, drag)));
    return manipulation;
}

static float usableFactor(float factor) {
    return std::abs(factor) < kMinFactor ? std::copysign(kMinFactor, factor) : factor;
}

static std::optional<Manipulation> dragScale(const Picture& picture, const GizmoDrag& drag,
                                             const GizmoSettings& settings, glm::vec2 mouse,
                                             DragKeys keys) {
    float factor = 1;
    if (const auto number = typedNumber(drag)) {
        if (*number == 0) // not typed to its end, as in "0.5"
            return {};
        factor = *number;
    } else {
        const auto dragged = dragFactor(picture, drag.handle, drag.frame, drag.start, mouse);
        if (!dragged)
            return {};
        factor = keys.fine ? 1 + (*dragged - 1) * kFine : *dragged;
        if (keys.snap && settings.scaleStep > 0)
            factor = std::copysign(std::max(std::abs(std::round(factor / settings.scaleStep)), 1.f),
                                   factor) *
                     settings.scaleStep;
        factor = usableFactor(factor);
    }
    Manipulation manipulation{.pivot = drag.frame.origin, .axes = drag.frame.axes};
    manipulation.alongOwnAxes = settings.space == GizmoSpace::Local;
    for (int i = 0; i < 3; ++i)
        if (takesAxis(drag.handle, i))
            manipulation.scale[i] = factor;
    return manipulation;
}

static bool finite(const Manipulation& manipulation) {
    const auto sum = glm::dot(manipulation.move, glm::vec3(1)) +
                     glm::dot(manipulation.scale, glm::vec3(1)) + manipulation.turn.w +
                     manipulation.turn.x + manipulation.turn.y + manipulation.turn.z;
    return std::isfinite(sum);
}

std::optional<Manipulation> dragManipulation(const Picture& picture, GizmoDrag& drag,
                                             const GizmoSettings& settings, glm::vec2 mouse,
                                             DragKeys keys) {
    std::optional<Manipulation> manipulation;
    switch (drag.tool) {
    case Tool::Select:
        break;
    case Tool::Move:
        manipulation = dragMove(picture, drag, settings, mouse, keys);
        break;
    case Tool::Rotate:
        manipulation = dragRotate(picture, drag, settings, mouse, keys);
        break;
    case Tool::Scale:
        manipulation = dragScale(picture, drag, settings, mouse, keys);
        break;
    }
    return manipulation && finite(*manipulation) ? manipulation : std::nullopt;
}

static std::string axisNames(Handle handle) {
    std::string names;
    for (int i = 0; i < 3 && handle != Handle::All; ++i)
        if (takesAxis(handle, i))
            names += "XYZ"[i];
    return names.empty() ? names : names + " ";
}

std::string dragText(const GizmoDrag& drag, const Manipulation& manipulation) {
    const std::string axes = axisNames(drag.handle);
    const glm::vec3 moved = glm::transpose(drag.frame.axes) * manipulation.move;
    const int axis = typedAxis(drag.handle);
    switch (drag.tool) {
    case Tool::Move:
        if (!drag.typed.empty())
            return fmt::format("Move {} {}_ m", "XYZ"[axis], drag.typed);
        if (axes.size() == 2)
            return fmt::format("Move {}{:+.3f} m", axes, moved[axis]);
        return fmt::format("Move {:+.3f}  {:+.3f}  {:+.3f} m", moved.x, moved.y, moved.z);
    case Tool::Rotate:
        if (!drag.typed.empty())
            return fmt::format("Rotate {}{}_\u00b0", axes, drag.typed);
        return fmt::format("Rotate {}{:+.1f}\u00b0", axes, glm::degrees(drag.turned));
    case Tool::Scale:
        if (!drag.typed.empty())
            return fmt::format("Scale {}\u00d7 {}_", axes, drag.typed);
        return fmt::format("Scale {}\u00d7 {:.3f}", axes, manipulation.scale[axis]);
    case Tool::Select:
        break;
    }
    return {};
}

} // namespace limn
