// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/reference_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "editor_ui/jobs/scene_changes.h"

#include <chrono>
#include <utility>

namespace limn {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kRest = std::chrono::milliseconds(250);
constexpr auto kShowEvery = std::chrono::milliseconds(250);
constexpr std::uint32_t kMaxSamples = 1 << 16; ///< of each part

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

ReferenceOptions optionsOf(const ReferenceOrder& order) {
    return {.view = order.view,
            .camera = order.camera,
            .width = order.width,
            .height = order.height,
            .samplesPerPixel = 1};
}

} // namespace

bool samePicture(const ReferenceOrder& a, const ReferenceOrder& b) {
    const bool sameView =
        a.view == b.view && a.camera == b.camera && a.width == b.width && a.height == b.height;
    return sameView && (a.scene == b.scene ||
                        (sameGeometry(*a.scene, *b.scene) && sameLight(*a.scene, *b.scene)));
}

ReferenceJob::ReferenceJob(std::function<void()> wake)
    : m_wake(std::move(wake)), m_thread([this] { work(); }) {}

ReferenceJob::~ReferenceJob() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
        m_cancel = true;
    }
    m_changed.notify_one();
    m_thread.join();
}

void ReferenceJob::set(std::optional<ReferenceOrder> order) {
    {
        const std::lock_guard lock(m_mutex);
        if (!order && !m_order)
            return;
        const bool same = order && m_order && samePicture(*order, *m_order);
        if (same && order->noise == m_order->noise) {
            m_order->scene = order->scene; // the next comparison is by pointer
            return;
        }
        m_order = std::move(order);
        m_fresh = m_order.has_value();
        m_cancel = true;
        if (!same)
            m_progress = {};
        m_progress.running = m_fresh;
    }
    m_changed.notify_one();
}

ReferenceProgress ReferenceJob::progress() const {
    const std::lock_guard lock(m_mutex);
    return m_progress;
}

std::optional<ReferenceOrder> ReferenceJob::nextOrder() {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [&] { return m_stop || m_fresh; });
    while (!m_stop && m_fresh) {
        m_fresh = false;
        if (!m_changed.wait_for(lock, kRest, [&] { return m_stop || m_fresh || !m_order; }))
            break;
    }
    if (m_stop || !m_order)
        return std::nullopt;
    m_cancel = false;
    return m_order;
}

void ReferenceJob::trace(const ReferenceOrder& order) {
    if (!m_tracedScene || !sameGeometry(*m_tracedScene, *order.scene) ||
        !sameLight(*m_tracedScene, *order.scene)) {
        const bool sameFixed = m_tracedScene && sameStaticGeometry(*m_tracedScene, *order.scene);
        m_trace = sameFixed ? std::make_unique<TraceScene>(*order.scene, *m_trace)
                            : std::make_unique<TraceScene>(*order.scene);
        m_tracedScene = order.scene;
    }
    ReferenceProgress now = progress();
    auto shown = Clock::now(), start = shown;
    const double before = now.seconds;
    Progress progress;
    progress.cancel = &m_cancel;
    progress.report = [&](const char*, float fraction) {
        if (Clock::now() - shown < kShowEvery)
            return;
        shown = Clock::now();
        {
            const std::lock_guard lock(m_mutex);
            if (m_cancel)
                return;
            m_progress.fraction = fraction;
            m_progress.seconds = before + secondsSince(start);
        }
        m_wake();
    };
    std::optional<ReferenceSet> set;
    if (now.set)
        set = *now.set;
    while (!set || (now.noise > order.noise && set->samplesPerPixel < kMaxSamples)) {
        if (!set)
            set = renderReferenceSet(*m_trace, optionsOf(order), progress);
        else if (!refine(*set, *m_trace, optionsOf(order), progress))
            return;
        if (!set)
            return;
        now = {std::make_shared<const ReferenceSet>(*set), noiseOf(*set), 0,
               before + secondsSince(start), true};
        {
            const std::lock_guard lock(m_mutex);
            if (m_cancel)
                return;
            m_progress = now;
        }
        m_wake();
    }
    const std::lock_guard lock(m_mutex);
    if (!m_cancel)
        m_progress.running = false;
}

void ReferenceJob::work() {
    lowerThreadPriority();
    for (;;) {
        const auto order = nextOrder();
        {
            const std::lock_guard lock(m_mutex);
            if (m_stop)
                return;
        }
        if (!order)
            continue;
        trace(*order);
        m_wake();
    }
}

} // namespace limn
