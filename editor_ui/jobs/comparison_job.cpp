// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/comparison_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "engine/scene/tone_map.h"

#include <utility>

namespace limn {

ComparisonJob::ComparisonJob(std::function<void()> wake)
    : m_wake(std::move(wake)), m_thread([this] { work(); }) {}

ComparisonJob::~ComparisonJob() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
    }
    m_changed.notify_one();
    m_thread.join();
}

void ComparisonJob::set(std::optional<ComparisonOrder> order) {
    {
        const std::lock_guard lock(m_mutex);
        if (order == m_order)
            return;
        m_order = std::move(order);
        m_fresh = m_order.has_value();
        if (!m_order)
            m_result = {.image = nullptr, .number = m_result.number, .error = {}};
    }
    m_changed.notify_one();
}

ComparedPicture ComparisonJob::result() const {
    const std::lock_guard lock(m_mutex);
    return m_result;
}

bool ComparisonJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_fresh || m_working;
}

static bool fits(const ComparisonOrder& order) {
    const ImageF& part = order.set->parts[0];
    return order.test && order.test->width == part.width && order.test->height == part.height;
}

static std::shared_ptr<const Image> pictureOf(const ComparisonOrder& order) {
    const ImageF mean = meanImage(order.set->first(), order.set->second());
    if (order.shown == Compare::Reference)
        return std::make_shared<const Image>(
            toneMappedImage(mean, order.tonemap, order.exposureEv));
    if (!fits(order))
        return nullptr;
    const auto map = order.shown == Compare::Flip           ? flipHeatmap
                     : order.shown == Compare::SquaredError ? squaredErrorHeatmap
                                                            : errorHeatmap;
    return std::make_shared<const Image>(map(*order.test, mean));
}

static std::optional<Comparison> errorOf(const ComparisonOrder& order) {
    if (!fits(order))
        return std::nullopt;
    const Result<Comparison> compared = compareImages(*order.test, *order.set);
    return compared ? std::optional(*compared) : std::nullopt;
}

void ComparisonJob::work() {
    lowerThreadPriority();
    std::optional<ComparisonOrder> done; // what `error` was measured of
    std::optional<Comparison> error;
    std::unique_lock lock(m_mutex);
    for (;;) {
        m_changed.wait(lock, [&] { return m_stop || m_fresh; });
        if (m_stop)
            return;
        const ComparisonOrder order = *m_order;
        m_fresh = false;
        m_working = true;
        lock.unlock();
        const auto image = pictureOf(order);
        if (!done || done->set != order.set || done->test != order.test)
            error = errorOf(order);
        done = order;
        lock.lock();
        m_working = false;
        if (!m_order)
            continue;
        m_result = {image, m_result.number + 1, error};
        lock.unlock();
        m_wake();
        lock.lock();
    }
}

} // namespace limn
