// SPDX-License-Identifier: MIT
#include "editor_ui/panels/no_light_hint.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

void noLightHint(EditorState& state) {
    const ViewState& view = state.view;
    const bool showsLight = view.view != View::Albedo && view.view != View::Normals;
    if (!state.unlit || !showsLight || !state.loading.empty())
        return;
    const char* text = "Nothing lights this scene.";
    const float margin = ImGui::GetFontSize() * 0.7f;
    ImGui::SetNextWindowPos({view.origin.x + view.size.x / 2, view.origin.y + view.size.y - margin},
                            ImGuiCond_Always, {0.5f, 1});
    ImGui::SetNextWindowSizeConstraints(
        {1, 1}, {std::max(view.size.x - 2 * margin, 1.f), std::max(view.size.y - 2 * margin, 1.f)});
    ImGui::Begin("no light", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(text);
    const bool add = ImGui::Button("Add sun and sky");
    wrappedTooltip("A sun of 4 lx and an even sky of 0.5 nits, as one edit. The exposure then "
                   "follows the picture, so that the inside of a building is seen, too");
    ImGui::End();
    if (!add)
        return;
    runAction(state, actionById("add.sun_and_sky"));
    state.view.autoExposure = true;
}

} // namespace limn
