// SPDX-License-Identifier: MIT
#include "app/bench/time_limit.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace limn {

TimeLimit::TimeLimit(std::optional<double> seconds) {
    if (!seconds)
        return;
    m_watch = std::jthread(
        [this, length = std::chrono::duration<double>(*seconds)](const std::stop_token& stop) {
            std::mutex mutex;
            std::unique_lock lock(mutex);
            std::condition_variable_any ended;
            ended.wait_for(lock, stop, length, [] { return false; });
            m_over = !stop.stop_requested();
        });
}

Progress TimeLimit::progress(Progress shown) const {
    shown.cancel = &m_over;
    return shown;
}

} // namespace limn
