// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/explain_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "engine/techniques/technique_table.h"

#include <chrono>
#include <utility>

namespace limn {

ExplainJob::ExplainJob(std::function<void()> wake) : m_wake(std::move(wake)) {}

ExplainJob::~ExplainJob() {
    m_cancel = true;
    if (m_thread.joinable())
        m_thread.join();
}

bool ExplainJob::start(ExplainOrder order) {
    if (m_running)
        return false;
    if (m_thread.joinable())
        m_thread.join(); // has finished
    m_order = order;
    m_running = true;
    m_thread = std::thread([this, order = std::move(order)] {
        lowerThreadPriority();
        carryOut(order);
        m_running = false;
        m_wake();
    });
    return true;
}

Progress ExplainJob::progress() {
    const auto report = [this](const char* stage, float fraction) {
        {
            const std::lock_guard lock(m_mutex);
            m_stage = stage;
            m_fraction = fraction;
        }
        m_wake();
    };
    return {.report = report, .cancel = &m_cancel};
}

/// Lights the order's scene, unless that was lit last.
Result<void> ExplainJob::light(const ExplainOrder& order) {
    const PixelQuestion& q = order.goals.empty() ? order.question : order.goals.front().question;
    const Viewpoint view = viewpointOf(q.camera, {q.width, q.height});
    if (m_litFor && m_litFor->sameLight(order) &&
        (!m_lit->lighting->isOfView() || m_litView == view))
        return {};
    m_litFor.reset();
    m_lit.reset();
    const Technique* technique = findTechnique(order.scene->technique.technique);
    if (!technique)
        return fail("the technique is unknown");
    auto lit = convergeLight(order.scene, std::make_shared<const TraceScene>(*order.scene),
                             *technique, order.prepared, LitFor::Pictures, progress(), &view);
    if (!lit)
        return tl::make_unexpected(lit.error());
    m_lit = std::move(*lit);
    m_litFor = order;
    m_litView = view;
    return {};
}

ExplainJob::Explained ExplainJob::explain(const ExplainOrder& order) const {
    const auto start = std::chrono::steady_clock::now();
    auto explained = std::make_shared<ExplainedPixel>();
    explained->explanation = explainPixel(*m_lit, order.question);
    explained->light = order.question.light;
    explained->lights = order.lights;
    for (const Instance& instance : order.scene->instances)
        explained->nodes.push_back(instance.node);
    explained->ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return explained;
}

void ExplainJob::carryOut(const ExplainOrder& order) {
    const Result<void> lit = light(order);
    if (order.goals.empty()) {
        Explained explained = lit ? explain(order) : tl::make_unexpected(lit.error());
        const std::lock_guard lock(m_mutex);
        m_result = std::move(explained);
        return;
    }
    Result<SolvedStrengths> strengths =
        lit ? solveStrengths(*m_lit, *findTechnique(order.scene->technique.technique), order.goals,
                             order.free, progress())
            : tl::make_unexpected(lit.error());
    const std::lock_guard lock(m_mutex);
    m_solved = {order.scene, order.lights, std::move(strengths)};
}

void ExplainJob::report(std::string& stage, float& fraction) const {
    const std::lock_guard lock(m_mutex);
    stage = m_stage;
    fraction = m_fraction;
}

bool ExplainJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_running || m_result || m_solved;
}

std::optional<ExplainJob::Explained> ExplainJob::takeResult() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, {});
}

std::optional<SolvedLights> ExplainJob::takeSolved() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_solved, {});
}

} // namespace limn
