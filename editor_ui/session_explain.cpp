// SPDX-License-Identifier: MIT
#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/light_refusal.h"
#include "editor_ui/session.h"
#include "engine/scene/find_object.h"

#include <algorithm>

namespace limn {

void Session::showExplanation() {
    ExplainState& explain = state.explain;
    auto result = m_explainJob.takeResult();
    if (result && m_explainJob.order()->scene->assets == state.assets) { // else of another file
        explain.error = *result ? "" : result->error().message;
        explain.result = *result ? **result : nullptr;
    }
    explain.running = m_explainJob.busy();
    explain.refusal = lightRefusal(state.bake);
    // While something is being dragged, each frame would light the scene anew.
    if (!explain.shown || !explain.pick || !explain.refusal.empty() || explain.running ||
        explain.goals.start || state.gesture)
        return;
    ExplainOrder order{.scene = m_whole,
                       .prepared = lightsBake() ? m_baked.prepared() : Prepared{},
                       .question = explain.pick->question};
    if (m_explainJob.order() == order)
        return;
    order.lights = idsOf<Light>(state.document);
    explain.running = m_explainJob.start(std::move(order));
}

/// Makes what was found the document's, as one step to undo, and shows it beside the goals.
static void takeStrengths(EditorState& state, const SolvedLights& found) {
    GoalsState& goals = state.explain.goals;
    goals.error = found.strengths ? "" : found.strengths.error().message;
    if (!found.strengths)
        return;
    Edit edit{"Solve for strengths", {}};
    for (std::size_t l = 0; l < found.lights.size(); ++l) {
        const Object* object = findObject(state, found.lights[l]);
        const Light* light = object ? std::get_if<Light>(object) : nullptr;
        const double factor = found.strengths->factor[l];
        if (!light || factor == 1)
            continue;
        Light solved = *light;
        solved.strength = float(double(found.scene->lights[l].strength) * factor);
        edit.changes.push_back({found.lights[l], *object, solved});
    }
    applyEdit(state, std::move(edit));
    for (std::size_t g = 0; g < std::min(goals.goals.size(), found.strengths->goals.size()); ++g) {
        goals.goals[g].now = found.strengths->goals[g].before;
        goals.goals[g].solved = found.strengths->goals[g].after;
    }
}

/// Takes strengths that were found, and starts to look for some when the panel asks for them.
void Session::solveGoals() {
    GoalsState& goals = state.explain.goals;
    if (const auto found = m_explainJob.takeSolved();
        found && found->scene->assets == state.assets) { // else of another file
        commitGesture(state);
        takeStrengths(state, *found);
    }
    goals.running = m_explainJob.busy() && !m_explainJob.order()->goals.empty();
    m_explainJob.report(goals.stage, goals.fraction);
    if (!goals.start || m_explainJob.busy() || state.gesture)
        return;
    goals.start = false;
    goals.error = lightRefusal(state.bake);
    if (!goals.error.empty() || goals.goals.empty())
        return;
    ExplainOrder order{.scene = m_whole,
                       .prepared = lightsBake() ? m_baked.prepared() : Prepared{},
                       .lights = idsOf<Light>(state.document)};
    for (const GoalsState::Goal& goal : goals.goals)
        order.goals.push_back({goal.pick.question, goal.wanted});
    for (std::uint32_t l = 0; l < order.lights.size(); ++l)
        if (!goals.selectedOnly || std::ranges::count(state.selection, order.lights[l]) > 0)
            order.free.push_back(l);
    goals.running = m_explainJob.start(std::move(order));
}

} // namespace limn
