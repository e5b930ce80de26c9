// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <string>
#include <unordered_map>
#include <vector>

namespace limn {

/// A widget that reacts to the mouse or the keyboard.
struct DrawnItem {
    ImGuiID id = 0;
    const ImGuiWindow* window = nullptr; ///< valid as long as the context
    ImRect box;                          ///< on the screen, also where it is scrolled away [px]
};

/// Lists the widgets of each frame of the current ImGui context, and those of them that share an
/// id, while it lives. ImGui finds the widget that a click is meant for by its id alone: of two
/// with the same id, one takes the click of the other, or neither works.
///
/// Debian's ImGui lacks the hooks of its test engine. The linker therefore redirects the library's
/// calls of ImGui::ItemAdd(), which each widget makes once, to a function that calls add() first
/// (the option --wrap in CMakeLists.txt). IO::UserData says whose.
class DrawnItems {
public:
    DrawnItems() { ImGui::GetIO().UserData = this; }
    ~DrawnItems() { ImGui::GetIO().UserData = nullptr; }
    DrawnItems(const DrawnItems&) = delete;
    DrawnItems& operator=(const DrawnItems&) = delete;

    /// The widgets of the last frame in the order of drawing.
    const std::vector<DrawnItem>& lastFrame() const { return m_items; }

    /// The last frame's widget of that id; null: there is none.
    const DrawnItem* find(ImGuiID id) const;

    /// A sentence for each widget so far whose id another one had in the same frame.
    const std::vector<std::string>& collisions() const { return m_collisions; }

    void add(const DrawnItem& item);

private:
    int m_frame = -1;
    std::vector<DrawnItem> m_items;
    std::unordered_map<ImGuiID, std::size_t> m_indices; ///< into m_items, by id
    std::vector<std::string> m_collisions;
};

} // namespace limn
