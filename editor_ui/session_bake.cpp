// SPDX-License-Identifier: MIT
// The part of the session that bakes.
#include "editor_ui/session.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/jobs/fitted_layout.h"
#include "editor_ui/jobs/scene_changes.h"
#include "editor_ui/panels/overlay_panel.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>

namespace limn {

/// Sets the cost of m_baked. `before`: the bake whose cost is known.
void Session::measureCost(const BakedScene& before) {
    const PrecomputedReport report = m_baked.bake->report();
    PrecomputedCost known;
    if (before.bake && before.scene->assets == m_baked.scene->assets &&
        &before.bake->technique() == &m_baked.bake->technique())
        known = before.bake->expectedCost(*before.scene, m_baked.bake->settings(), m_cost);
    m_cost = {report.seconds, totalOf(report.bytes), known.update, known.updateMs};
    for (auto& [stage, seconds] : m_cost.seconds) {
        if (std::ranges::find(report.keptStages, stage) == report.keptStages.end())
            continue;
        const auto found = std::ranges::find(known.seconds, stage, [](auto& s) { return s.first; });
        seconds = found == known.seconds.end() ? 0 : found->second;
    }
}

void Session::expectCost() {
    state.bake.measured = m_cost;
    state.bake.expected = m_baked.bake
                              ? m_baked.bake->expectedCost(*m_baked.scene, m_scene->bake, m_cost)
                              : PrecomputedCost{};
}

void Session::useBake(BakedScene baked) {
    const BakedScene previous = std::exchange(m_baked, std::move(baked));
    state.relightPlace.refusal.clear(); // of the bake before
    const BakeStatus before = std::exchange(state.bake, {});
    state.bake.running = before.running; // after the preview, the bar goes on where it is
    state.bake.fraction = before.fraction;
    m_compared = nullptr;
    if (m_baked.bake) {
        state.bake.last = m_baked.bake->report();
        state.bake.preview = m_baked.preview;
        state.bake.selection = m_baked.selection;
        measureCost(previous);
    } else {
        m_cost = {};
    }
    expectCost();
    followOverlay();
    fitLayout();
    m_relightJob.setBake(m_baked);
}

/// Sets what the overlay is made of: the snapshot of the light for those of a technique that
/// precomputes nothing, else the bake.
void Session::followOverlay() {
    const OverlayKind* kind = state.overlay.options.kind;
    const bool live = kind && !techniqueOf(*kind).precomputation;
    if (live && viewportRelights() && &techniqueOf(*kind) == lightingTechnique() &&
        isMadeOf(*kind, state.overlay.source.get()))
        return; // it is the viewport's
    std::shared_ptr<const OverlaySource> source = m_baked.bake;
    std::shared_ptr<const Scene> scene = m_baked.scene;
    if (live)
        source = m_relit.lit, scene = m_relit.hashedScene;
    if (kind && !isMadeOf(*kind, source.get()))
        source = nullptr, scene = nullptr;
    if (source != state.overlay.source)
        setOverlaySource(state.overlay, std::move(source), std::move(scene));
    const std::shared_ptr<const OverlaySource>& shown = state.overlay.source;
    const bool fits = shown && m_relit.lit && &shown->technique() == &m_relit.lit->technique();
    state.overlay.light = fits && !viewportRelights() ? m_relit.lit : nullptr;
}

const Technique* Session::lightingTechnique() const {
    const Technique* technique = findTechnique(m_scene->technique.technique);
    const bool needsOther = technique && technique->precomputation &&
                            !(m_baked.bake && &m_baked.bake->technique() == technique);
    return needsOther ? nullptr : technique;
}

bool Session::viewportRelights() const {
    return lightingTechnique() && state.relightPlace.used() == RelightOn::Gpu;
}

bool Session::lightsBake() const {
    const Technique* technique = findTechnique(m_scene->technique.technique);
    return technique && technique->precomputation;
}

void Session::fitLayout() {
    m_layout = layoutOf(*m_scene, m_baked);
}

void Session::takeBaked() {
    auto result = m_bakeJob.takeResult();
    if (!result) {
        if (std::optional<LightingReport> update = m_bakeJob.takeUpdate()) {
            m_cost.update = std::move(update->steps);
            m_cost.updateMs = update->totalMs;
            expectCost();
        }
        return;
    }
    const bool preview = *result && (*result)->preview;
    if (!preview)
        m_bakeSecondsDone += std::exchange(m_bakeSecondsRunning, 0);
    if (!*result && m_superseded)
        return; // a newer one follows
    if (!*result) {
        m_notBaked = m_bakingHash;
        state.bake.error = result->error().message;
        log(LogLine::Level::Warning, "Bake: " + state.bake.error);
    } else if ((*result)->scene->assets == state.assets) {
        const std::string goal = (*result)->goal;
        useBake(std::move(**result));
        if (!goal.empty())
            showGoal(goal);
        if (!preview)
            for (const std::string& note : state.bake.last.notes)
                log(LogLine::Level::Info, "Baked. " + note);
    }
}

/// Shows the result of a bake to an error or to a budget and makes its settings the document's.
void Session::showGoal(const std::string& goal) {
    setBakeSettings(state, m_baked.bake->settings(),
                    m_baked.fitted ? "Fit to budget" : "Bake until the error holds");
    state.bake.goal = goal;
    log(LogLine::Level::Info, goal);
}

static BakeFreshness freshness(const BakedScene& baked, const Relit& relit, const Scene& scene) {
    if (!baked.bake)
        return BakeFreshness::None;
    if (!relit.hashedScene || !sameBakeInputs(*relit.hashedScene, scene))
        return BakeFreshness::Checking;
    return relit.inputHash == baked.bake->inputHash() ? BakeFreshness::UpToDate
                                                      : BakeFreshness::Needed;
}

void Session::showStatus() {
    m_relit = m_relightJob.result();
    followOverlay();
    state.trace = m_relit.trace;
    m_relightJob.setLighting(!viewportRelights());
    const glm::vec2 size = glm::max(state.view.size, glm::vec2(1));
    m_relightJob.setView(viewpointOf(state.view.camera, glm::uvec2(size)));
    const OverlayKind* overlay = state.overlay.options.kind;
    m_relightJob.keepLit(overlay && overlay->showsLight && !viewportRelights());
    if (!viewportRelights())
        state.relight = m_relit.status;
    m_bakeJob.report(state.bake);
    for (const MeasuredError& error : m_bakeJob.takeErrors())
        state.goals.errors.push_back(error);
    if (state.bake.running)
        m_bakeSecondsRunning = state.bake.elapsedSeconds;
    state.bake.freshness =
        lightsBake() ? freshness(m_baked, m_relit, *m_scene) : BakeFreshness::NotUsed;
    state.bake.lightEdited = m_lightEdited;
    state.bake.secondsSinceLightEdit = m_lightEdited ? bakeSeconds() - m_bakeSecondsAtLightEdit : 0;
    showChanges();
}

void Session::showChanges() {
    if (state.bake.freshness != BakeFreshness::Needed) {
        state.bake.changes.clear();
        m_compared = nullptr;
    } else if (m_compared != m_scene) {
        m_compared = m_scene;
        state.bake.changes = bakeInputChanges(*m_baked.scene, *m_scene, state.document);
    }
}

/// Starts the bake that the user has asked for, or that the document needs. The latter waits until
/// no drag changes the document any more, and takes the place of a bake of an older document.
void Session::bakeIfWanted() {
    if (!m_relit.hashedScene || !sameBakeInputs(*m_relit.hashedScene, *m_scene))
        return; // the hash is being computed
    const bool automatic = state.autoBake && !state.gesture && m_notBaked != m_relit.inputHash;
    if (m_bakeJob.busy()) {
        m_superseded |= automatic && m_bakeJob.running() && m_relit.inputHash != m_bakingHash;
        if (m_superseded) {
            m_bakeSoon = state.bake.freshness != BakeFreshness::UpToDate;
            m_bakeJob.cancel();
        }
        return;
    }
    if (!m_bakeSoon && !(automatic && state.bake.freshness == BakeFreshness::Needed))
        return;
    m_bakeSoon = m_superseded = false;
    m_bakingHash = m_relit.inputHash;
    m_notBaked.reset();
    if (!m_bakeWish.selection.empty())
        m_notBaked = m_bakingHash; // the rest waits until it is asked for
    state.bake.error.clear();
    // The baker reads the settings of the scene that the rays meet.
    const bool current = m_relit.trace && sameBakeInputs(m_relit.trace->scene(), *m_scene);
    BakeOrder order = std::exchange(m_bakeWish, {});
    order.scene = m_scene;
    order.trace = current ? m_relit.trace : nullptr;
    order.preview = m_baked.bake == nullptr;
    m_bakeJob.start(std::move(order));
    m_bakeJob.report(state.bake);
}

} // namespace limn
