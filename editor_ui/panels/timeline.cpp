// SPDX-License-Identifier: MIT
#include "editor_ui/panels/timeline.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace limn {

static double lengthOf(const Flipbook& f) {
    return f.framesPerSecond > 0 ? double(f.columns * f.rows) / double(f.framesPerSecond) : 0;
}

double animationLength(const EditorState& state) {
    if (state.animation)
        return state.animation->duration();
    double longest = 0;
    for (const auto& [id, object] : state.document.objects)
        if (const Material* m = std::get_if<Material>(&object); m && isAnimated(*m))
            longest = std::max(longest, lengthOf(m->emissiveFlipbook));
    return longest;
}

void advanceTime(EditorState& state, double seconds) {
    state.seconds += seconds;
    const double length = animationLength(state);
    if (length > 0 && state.seconds > length)
        state.seconds = std::fmod(state.seconds, length);
}

/// A button that runs an action, whose name and key its tooltip shows.
static void actionButton(EditorState& state, const char* label, const char* action) {
    if (ImGui::Button(label))
        runAction(state, actionById(action));
    wrappedTooltip(actionById(action).label);
}

void timeline(EditorState& state) {
    actionButton(state, state.playing ? "Pause" : "Play", "view.play");
    ImGui::SameLine();
    actionButton(state, "Start", "view.rewind");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    auto shown = float(state.seconds);
    if (ImGui::SliderFloat("##time", &shown, 0, float(animationLength(state)), "%.2f s",
                           ImGuiSliderFlags_AlwaysClamp))
        state.seconds = double(shown);
    wrappedTooltip(state.animation
                       ? "Time of the file's first animation [s]. At 0, objects are at rest. What "
                         "moves is dynamic and needs no new bake; skins and morph targets keep the "
                         "pose in which the file was opened"
                       : "Time of the animated textures [s]");
}

} // namespace limn
