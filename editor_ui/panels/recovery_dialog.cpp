// SPDX-License-Identifier: MIT
#include "editor_ui/panels/recovery_dialog.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/dialog.h"
#include "editor_ui/panels/field.h"

#include <imgui.h>

#include <filesystem>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace limn {

void recoveryDialog(EditorState& state) {
    if (!state.recovery || state.fileBrowser || state.confirm)
        return;
    if (!beginDialog("Recover unsaved changes?"))
        return;
    const RecoveryOffer& offer = *state.recovery;
    ImGui::TextUnformatted("An editor ended before these changes were saved:");
    ImGui::Spacing();
    const float width = ImGui::GetContentRegionAvail().x;
    elidedText(std::filesystem::path(offer.originalPath).filename().string(), width);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    elidedText(offer.originalPath, width);
    ImGui::PopStyleColor();
    std::tm local{};
    localtime_r(&offer.written, &local);
    ImGui::TextUnformatted(fmt::format("Last change kept at {:%H:%M:%S on %F}", local).c_str());
    ImGui::Spacing();
    std::optional<Request::Kind> answer;
    if (dialogButton("Recover", key::kEnter))
        answer = Request::Kind::Recover;
    wrappedTooltip("Opens the document with these changes; its file stays as it is until you save");
    if (dialogButton("Discard"))
        answer = Request::Kind::DiscardRecovery;
    wrappedTooltip("Deletes these changes; the file stays as it was last saved");
    if (dialogButton("Not now", key::kEscape))
        answer = Request::Kind::PostponeRecovery;
    wrappedTooltip("Keeps these changes and asks again when the document is opened next");
    if (answer) {
        state.requests.push_back({*answer, {}});
        state.recovery.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace limn
