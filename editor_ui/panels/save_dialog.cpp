// SPDX-License-Identifier: MIT
#include "editor_ui/panels/save_dialog.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/dialog.h"
#include "editor_ui/panels/field.h"

#include <imgui.h>

#include <utility>

namespace limn {

void saveDialog(EditorState& state) {
    if (!state.confirm || !beginDialog("Save changes?"))
        return;
    const std::string path = documentPath(state);
    elidedText(path.empty() ? "The document" : path, ImGui::GetContentRegionAvail().x);
    ImGui::TextUnformatted("has changes that are not saved.");
    ImGui::Spacing();
    const bool save =
        dialogButton(state.projectPath.empty() ? "Save as\u2026" : "Save", key::kEnter);
    const bool discard = dialogButton("Don't save");
    const bool cancel = dialogButton("Cancel", key::kEscape);
    if (!save && !discard && !cancel) {
        ImGui::EndPopup();
        return;
    }
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    Request request = *std::exchange(state.confirm, {});
    if (save) {
        state.afterSave = std::move(request);
        runAction(state, actionById("file.save"));
    } else if (discard) {
        request.discardsChanges = true;
        state.requests.push_back(std::move(request));
    }
}

} // namespace limn
