// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/bake_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "editor_ui/jobs/selection_bake.h"
#include "editor_ui/panels/field.h"
#include "engine/lighting/fastest_update.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace limn {

using Clock = std::chrono::steady_clock;

BakeJob::BakeJob(std::function<void()> wake, StageStoreOptions store, MemoryBudget memory)
    : m_wake(std::move(wake)), m_store(std::move(store)), m_memory(memory) {}

BakeJob::~BakeJob() {
    m_cancel = true;
    if (m_thread.joinable())
        m_thread.join();
}

bool BakeJob::start(BakeOrder order) {
    if (m_running || m_measuring)
        return false;
    if (m_thread.joinable())
        m_thread.join(); // has finished
    m_cancel = false;
    m_running = true;
    m_start = Clock::now();
    {
        const std::lock_guard lock(m_mutex);
        m_stage.clear();
        m_step.clear();
        m_fitting = order.budget.has_value();
        m_stageFraction = 0;
        m_stageStart = m_start;
        m_result.reset();
        m_update.reset();
    }
    m_thread = std::thread([this, order = std::move(order)]() mutable {
        lowerThreadPriority();
        if (!order.trace)
            order.trace = std::make_shared<const TraceScene>(*order.scene);
        work(order);
    });
    return true;
}

Progress BakeJob::progress() {
    Progress progress;
    progress.cancel = &m_cancel;
    progress.report = [this, shown = Clock::now()](const char* stage, float fraction) mutable {
        const auto now = Clock::now();
        {
            const std::lock_guard lock(m_mutex);
            if (m_stage != stage)
                m_stageStart = now;
            m_stage = stage;
            m_stageFraction = fraction;
        }
        if (now - shown > std::chrono::milliseconds(100)) {
            shown = now;
            m_wake();
        }
    };
    return progress;
}

Result<std::shared_ptr<const Precomputed>> BakeJob::bakeWith(const Precomputation& precomputation,
                                                             const BakeSettings& settings,
                                                             const TechniqueChoice& choice,
                                                             const TraceScene& trace) {
    return precomputation.prepare(
        trace, {.settings = &settings, .choice = &choice, .store = &m_store, .memory = m_memory},
        progress());
}

void BakeJob::setStep(std::string step) {
    const std::lock_guard lock(m_mutex);
    m_step = std::move(step);
}

void BakeJob::keepError(MeasuredError error) {
    const std::lock_guard lock(m_mutex);
    m_errors.push_back(error);
}

std::vector<MeasuredError> BakeJob::takeErrors() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_errors, {});
}

void BakeJob::put(Result<BakedScene> result) {
    const std::lock_guard lock(m_mutex);
    m_result = std::move(result);
}

Result<BakedScene> BakeJob::bakeScene(const BakeOrder& order) {
    const std::shared_ptr<const Scene>& scene = order.scene;
    const Precomputation& precomputation = *precomputingTechnique(scene->technique).precomputation;
    const BakeSettings first = precomputation.preview(scene->bake);
    if (order.preview && first != scene->bake)
        if (const auto rough = bakeWith(precomputation, first, scene->technique, *order.trace)) {
            const PrecomputedCost cost = (*rough)->expectedCost(
                *scene, scene->bake, {.seconds = (*rough)->report().seconds});
            {
                const std::lock_guard lock(m_mutex);
                m_expected = cost.seconds;
            }
            put(BakedScene{.bake = *rough, .scene = scene, .trace = order.trace, .preview = true});
            m_wake();
        }
    const auto baked = bakeWith(precomputation, scene->bake, scene->technique, *order.trace);
    if (!baked)
        return tl::make_unexpected(baked.error());
    return BakedScene{.bake = *baked, .scene = scene, .trace = order.trace};
}

Result<BakedScene> BakeJob::bakeSelection(const BakeOrder& order) {
    const Scene chosen = selectionScene(*order.scene, order.selection);
    const TraceScene trace(chosen, *order.trace);
    const auto baked = bakeWith(*precomputingTechnique(chosen.technique).precomputation,
                                chosen.bake, chosen.technique, trace);
    if (!baked)
        return tl::make_unexpected(baked.error());
    return BakedScene{
        .bake = *baked, .scene = order.scene, .trace = order.trace, .selection = true};
}

static std::string texelsText(const BakeSettings& settings) {
    return groupedNumber(settings.lightmapCaches) + " texels";
}

Result<BakedScene> BakeJob::bakeToGoal(const BakeOrder& order) {
    Scene draft = *order.scene;
    kBakePresets.front().applyTo(draft.bake);
    setStep(texelsText(draft.bake));
    const TraceScene trace(draft, *order.trace);
    const auto next = [&](const MeasuredBake& made) {
        keepError({made.bake->settings(), made.error.nrmse});
        setStep(fmt::format("{}, after an error of {:.2f}",
                            texelsText(finerSettings(made.bake->settings())), made.error.nrmse));
    };
    const auto made = bakeToError(precomputingTechnique(draft.technique), trace, *order.goal,
                                  progress(), &m_store, m_memory, next);
    if (!made)
        return tl::make_unexpected(made.error());
    auto scene = std::make_shared<Scene>(*order.scene);
    scene->bake = made->bake->settings();
    const std::string why = shortfall(*made, order.goal->nrmse);
    return BakedScene{.bake = made->bake,
                      .scene = std::move(scene),
                      .trace = order.trace,
                      .goal = fmt::format("Error {:.3f} with {}{}", made->error.nrmse,
                                          texelsText(made->bake->settings()),
                                          why.empty() ? why : "; " + why)};
}

Result<BakedScene> BakeJob::bakeToBudget(const BakeOrder& order) {
    const TraceScene trace(*order.scene, *order.trace);
    setStep("first bake");
    std::size_t trials = 0;
    double least = std::numeric_limits<double>::infinity();
    const auto tried = [&](const SettingsTrial& trial) {
        const SearchGoal& limits = order.budget->limits;
        if (excess(limits, {trial.nrmse, trial.ms, trial.bytes}) <= 1)
            least = std::min(least, trial.nrmse);
        keepError({trial.settings, trial.nrmse});
        setStep(fmt::format("{} measured, {}", ++trials,
                            std::isfinite(least) ? fmt::format("least error {:.3f}", least)
                                                 : std::string("none keeps the budget yet")));
    };
    const Technique& technique = precomputingTechnique(order.scene->technique);
    const Result<FittedSettings> fitted =
        fitToBudget(technique, trace, usualFitSweep(), *order.budget, progress(), m_memory, tried);
    if (!fitted)
        return tl::make_unexpected(fitted.error());
    if (const std::string why = shortfall(*fitted, order.budget->limits); !why.empty())
        return fail(why);
    auto scene = std::make_shared<Scene>(*order.scene);
    scene->bake = fitted->best.settings;
    setStep("bake of the settings found");
    const auto baked = bakeWith(*technique.precomputation, scene->bake, scene->technique, trace);
    if (!baked)
        return tl::make_unexpected(baked.error());
    const SettingsTrial& best = fitted->best;
    return BakedScene{.bake = *baked,
                      .scene = std::move(scene),
                      .trace = order.trace,
                      .goal = fmt::format("{:.2f} ms, {} and an error of {:.3f}, the least of {} "
                                          "settings that were measured",
                                          best.ms, byteText(std::uint64_t(best.bytes)), best.nrmse,
                                          fitted->trials.size()),
                      .fitted = true};
}

void BakeJob::work(const BakeOrder& order) {
    const Result<BakedScene> baked = order.goal                ? bakeToGoal(order)
                                     : order.budget            ? bakeToBudget(order)
                                     : order.selection.empty() ? bakeScene(order)
                                                               : bakeSelection(order);
    if (baked) {
        const std::lock_guard lock(m_mutex);
        m_expected = baked->bake->report().seconds;
        m_measuring = true;
    }
    put(baked);
    m_running = false;
    m_wake();
    if (!baked)
        return;
    measureUpdate(*baked);
    m_measuring = false;
    m_wake();
}

void BakeJob::measureUpdate(const BakedScene& baked) {
    Progress progress;
    progress.cancel = &m_cancel;
    constexpr int kRuns = 3;
    const auto lighting = baked.bake->technique().light(baked.prepared());
    LightingReport update = fastestUpdate(*lighting, *baked.scene, *baked.trace, kRuns, progress);
    const std::lock_guard lock(m_mutex);
    if (!update.steps.empty())
        m_update = std::move(update);
}

std::optional<LightingReport> BakeJob::takeUpdate() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_update, {});
}

bool BakeJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_running || m_measuring || m_result || m_update;
}

std::optional<Result<BakedScene>> BakeJob::takeResult() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, {});
}

void BakeJob::report(BakeStatus& status) const {
    const bool ranBefore = std::exchange(status.running, m_running);
    if (!status.running)
        return;
    const std::lock_guard lock(m_mutex);
    status.stage = m_stage;
    status.step = m_step;
    status.fitting = m_fitting;
    status.stageFraction = m_stageFraction;
    const auto now = Clock::now();
    status.elapsedSeconds = std::chrono::duration<double>(now - m_start).count();
    status.secondsLeft = secondsLeft(m_expected, m_stage, double(m_stageFraction),
                                     std::chrono::duration<double>(now - m_stageStart).count());
    const double total = status.elapsedSeconds + status.secondsLeft;
    const float fraction = status.secondsLeft < 0 || total <= 0
                               ? 0
                               : std::min(float(status.elapsedSeconds / total), 0.99f); // it runs
    // Estimates get longer, too; what was done stays done.
    status.fraction = ranBefore ? std::max(status.fraction, fraction) : fraction;
}

} // namespace limn
