// SPDX-License-Identifier: MIT
#include "tests/editor_ui/drawn_items.h"

#include <algorithm>

#include <fmt/format.h>

// The library's function, and what its callers get instead, by the names that the linker gives
// them.
bool itemAddOfImGui(const ImRect&, ImGuiID, const ImRect*,
                    ImGuiItemFlags) asm("__real__ZN5ImGui7ItemAddERK6ImRectjPS1_i");
bool itemAddForWidgets(const ImRect&, ImGuiID, const ImRect*,
                       ImGuiItemFlags) asm("__wrap__ZN5ImGui7ItemAddERK6ImRectjPS1_i");

bool itemAddForWidgets(const ImRect& box, ImGuiID id, const ImRect* navigation,
                       ImGuiItemFlags flags) {
    auto* items = static_cast<limn::DrawnItems*>(ImGui::GetIO().UserData);
    if (items && id != 0)
        items->add({id, ImGui::GetCurrentWindowRead(), box});
    return itemAddOfImGui(box, id, navigation, flags);
}

namespace limn {

static std::string described(const DrawnItem& item) {
    return fmt::format("({:.0f}, {:.0f})-({:.0f}, {:.0f}) of \"{}\"", item.box.Min.x,
                       item.box.Min.y, item.box.Max.x, item.box.Max.y, item.window->Name);
}

const DrawnItem* DrawnItems::find(ImGuiID id) const {
    const auto found = m_indices.find(id);
    return found == m_indices.end() ? nullptr : &m_items[found->second];
}

void DrawnItems::add(const DrawnItem& item) {
    if (const int frame = ImGui::GetFrameCount(); frame != m_frame) {
        m_frame = frame;
        m_items.clear();
        m_indices.clear();
    }
    const auto [first, added] = m_indices.try_emplace(item.id, m_items.size());
    m_items.push_back(item);
    if (added)
        return;
    std::string text = fmt::format("{:#010x} is the id of {} and of {}", item.id,
                                   described(m_items[first->second]), described(item));
    if (std::ranges::find(m_collisions, text) == m_collisions.end())
        m_collisions.push_back(std::move(text));
}

} // namespace limn
