// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/keys.h"

#include <deque>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// One thing the user did to the window, in the order it happened.
struct InputEvent {
    enum class Kind {
        MouseMove,
        MouseButton,
        Scroll,
        Key,
        Character,
        Focus
    } kind = Kind::MouseMove;
    glm::vec2 position{0}; ///< MouseMove [px]; Scroll: amount
    int code = 0; ///< MouseButton: 0 left, 1 right, 2 middle. Key: keys.h. Character: code point
    bool down = false;     ///< MouseButton, Key; Focus: gained
    std::uint8_t mods = 0; ///< Key: Mods held
};

/// Events that no frame has shown yet. ImGui 1.86 reads states, not events, so a click or key tap
/// shorter than a frame would be lost; the queue hands out at most one transition of a button or
/// key per frame.
struct InputQueue {
    std::deque<InputEvent> events;
};

/// Moves the events of the next frame into ImGui's io. Returns the keys that went down, for
/// shortcuts. Call before ImGui::NewFrame(). What stays in the queue needs another frame.
std::vector<Shortcut> feedInput(InputQueue& queue);

/// Tells ImGui which codes are its Tab, arrows, Enter, ... Call once per context.
void mapKeys();

} // namespace limn
