// SPDX-License-Identifier: MIT
#include "app/editor/render_job.h"

#include "app/editor/render_worker.h"
#include "editor_ui/jobs/background_priority.h"

#include <exception>
#include <utility>

namespace limn {

RenderJob::RenderJob(bool validate, std::function<void()> wake)
    : m_wake(std::move(wake)), m_thread([this, validate] { run(validate); }) {}

RenderJob::~RenderJob() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = m_hurry = true;
    }
    m_changed.notify_one();
    m_thread.join();
}

void RenderJob::draw(PictureRequest request) {
    {
        const std::lock_guard lock(m_mutex);
        const bool newLight =
            request.relight && (request.scene != m_lastScene || request.litBy() != m_result.lit);
        if (newLight) {
            m_result.relight.running = true;
            m_result.relight.converged = false;
        }
        m_lastScene = request.scene;
        m_next = std::move(request);
        m_result.running = m_hurry = true;
    }
    m_changed.notify_one();
}

DrawnPicture RenderJob::result() const {
    const std::lock_guard lock(m_mutex);
    return m_result;
}

std::vector<std::string> RenderJob::validationMessages() const {
    const std::lock_guard lock(m_mutex);
    return m_messages;
}

void RenderJob::publish(RenderWorker& worker, DrawnImages images) {
    const std::lock_guard lock(m_mutex);
    m_result.image = std::move(images.shown);
    m_result.linear = std::move(images.linear);
    m_result.metered = images.metered;
    ++m_result.number;
    m_result.legend = worker.overlay ? worker.overlay->legend : OverlayLegend{};
    m_result.stats = worker.viewport.stats();
    m_result.nearLight = worker.showsNearLight();
    m_result.gathers = worker.gathers();
    m_result.gathered = 0;
    m_result.running = m_next.has_value() || worker.bouncing();
    m_result.lit = worker.shown.litBy();
    m_result.relight = worker.relight;
    m_result.snapshot = worker.snapshot;
    m_result.snapshotScene = worker.snapshotScene;
    m_result.refusal = worker.refusal;
    m_result.times = worker.times;
    m_messages = worker.device->validationMessages();
}

// What the picture was metered and timed by stays that of its first sample: times of a refined one
// would be for triangles that nothing made necessary.
void RenderJob::publishRefined(const RenderWorker& worker, DrawnImages images) {
    const std::lock_guard lock(m_mutex);
    m_result.image = std::move(images.shown);
    m_result.linear = std::move(images.linear);
    m_result.gathered = worker.gathered();
    ++m_result.number;
}

void RenderJob::run(bool validate) {
    lowerThreadPriority(); // a software rasteriser's threads inherit it
    try {
        RenderWorker worker(validate);
        for (;;) {
            std::unique_lock lock(m_mutex);
            m_changed.wait(lock, [&] {
                return m_stop || m_next || worker.bouncing() || worker.refining() ||
                       worker.gathering();
            });
            if (m_stop)
                return;
            std::optional<PictureRequest> request = std::exchange(m_next, {});
            m_hurry = false;
            lock.unlock();
            if (request || worker.bouncing())
                publish(worker, worker.draw(request ? std::move(*request) : worker.shown, m_hurry));
            else if (std::optional<DrawnImages> images =
                         worker.refining() ? worker.refine(m_hurry) : worker.gather(m_hurry))
                publishRefined(worker, std::move(*images));
            else
                continue;
            m_wake();
        }
    } catch (
        const std::exception& e) { // device lost, out of memory: the document can still be saved
        const std::lock_guard lock(m_mutex);
        m_result.error = e.what();
        m_result.running = false;
    }
    m_wake();
}

} // namespace limn
