// SPDX-License-Identifier: MIT
#include "editor_ui/view/input_queue.h"

#include <imgui.h>

#include <utility>

namespace limn {

namespace {

/// What one frame has already shown.
struct FrameSoFar {
    bool buttonOrKey = false;
    bool moved = false;
};

} // namespace

static bool fitsThisFrame(const InputEvent& event, const FrameSoFar& sofar) {
    switch (event.kind) {
    case InputEvent::Kind::MouseMove: // a move after a click would shift the click
    case InputEvent::Kind::Character:
    case InputEvent::Kind::Key:
        return !sofar.buttonOrKey;
    case InputEvent::Kind::MouseButton: // ImGui must have seen what is hovered before it is clicked
        return !sofar.buttonOrKey && !sofar.moved;
    case InputEvent::Kind::Scroll:
    case InputEvent::Kind::Focus:
        return true;
    }
    return true;
}

static void keyEvent(ImGuiIO& io, const InputEvent& event, std::vector<Shortcut>& pressed) {
    if (event.code > 0 && event.code < int(IM_ARRAYSIZE(io.KeysDown)))
        io.KeysDown[event.code] = event.down;
    io.KeyCtrl = event.mods & kCtrl;
    io.KeyShift = event.mods & kShift;
    io.KeyAlt = event.mods & kAlt;
    if (event.down && (event.code < key::kLeftShift || event.code > key::kRightSuper))
        pressed.push_back({event.code, event.mods});
}

static void feed(ImGuiIO& io, const InputEvent& event, FrameSoFar& sofar,
                 std::vector<Shortcut>& pressed) {
    switch (event.kind) {
    case InputEvent::Kind::MouseMove:
        io.MousePos = {event.position.x, event.position.y};
        sofar.moved = true;
        break;
    case InputEvent::Kind::MouseButton:
        if (event.code >= 0 && event.code < int(IM_ARRAYSIZE(io.MouseDown)))
            io.MouseDown[event.code] = event.down;
        sofar.buttonOrKey = true;
        break;
    case InputEvent::Kind::Scroll:
        io.MouseWheelH += event.position.x;
        io.MouseWheel += event.position.y;
        break;
    case InputEvent::Kind::Key:
        keyEvent(io, event, pressed);
        sofar.buttonOrKey = true;
        break;
    case InputEvent::Kind::Character:
        io.AddInputCharacter(unsigned(event.code));
        break;
    case InputEvent::Kind::Focus:
        io.AddFocusEvent(event.down);
        break;
    }
}

std::vector<Shortcut> feedInput(InputQueue& queue) {
    ImGuiIO& io = ImGui::GetIO();
    std::vector<Shortcut> pressed;
    FrameSoFar sofar;
    while (!queue.events.empty() && fitsThisFrame(queue.events.front(), sofar)) {
        const InputEvent event = queue.events.front();
        queue.events.pop_front();
        feed(io, event, sofar, pressed);
    }
    return pressed;
}

void mapKeys() {
    const std::pair<int, int> keys[] = {
        {ImGuiKey_Tab, key::kTab},           {ImGuiKey_LeftArrow, key::kLeft},
        {ImGuiKey_RightArrow, key::kRight},  {ImGuiKey_UpArrow, key::kUp},
        {ImGuiKey_DownArrow, key::kDown},    {ImGuiKey_PageUp, key::kPageUp},
        {ImGuiKey_PageDown, key::kPageDown}, {ImGuiKey_Home, key::kHome},
        {ImGuiKey_End, key::kEnd},           {ImGuiKey_Insert, key::kInsert},
        {ImGuiKey_Delete, key::kDelete},     {ImGuiKey_Backspace, key::kBackspace},
        {ImGuiKey_Space, key::kSpace},       {ImGuiKey_Enter, key::kEnter},
        {ImGuiKey_Escape, key::kEscape},     {ImGuiKey_KeyPadEnter, key::kPadEnter},
        {ImGuiKey_A, key::of('A')},          {ImGuiKey_C, key::of('C')},
        {ImGuiKey_V, key::of('V')},          {ImGuiKey_X, key::of('X')},
        {ImGuiKey_Y, key::of('Y')},          {ImGuiKey_Z, key::of('Z')}};
    for (const auto& [imgui, code] : keys)
        ImGui::GetIO().KeyMap[imgui] = code;
}

} // namespace limn
