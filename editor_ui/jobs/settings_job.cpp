// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/settings_job.h"

#include <chrono>
#include <utility>

namespace limn {

SettingsJob::SettingsJob(std::string file, EditorSettings known)
    : m_file(std::move(file)), m_latest(std::move(known)) {
    if (!m_file.empty())
        m_thread = std::thread([this] { run(); });
}

SettingsJob::~SettingsJob() {
    if (!m_thread.joinable())
        return;
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
    }
    m_changed.notify_one();
    m_thread.join();
}

void SettingsJob::keep(EditorSettings now) {
    if (m_file.empty() || now == m_latest)
        return;
    m_latest = std::move(now);
    {
        const std::lock_guard lock(m_mutex);
        m_unwritten = m_latest;
    }
    m_changed.notify_one();
}

void SettingsJob::run() {
    constexpr std::chrono::seconds kQuiet(1); // while something is dragged, settings keep changing
    std::unique_lock lock(m_mutex);
    for (;;) {
        m_changed.wait(lock, [&] { return m_stop || m_unwritten; });
        while (!m_stop && m_changed.wait_for(lock, kQuiet) == std::cv_status::no_timeout) {
        }
        const bool stop = m_stop;
        if (const auto settings = std::exchange(m_unwritten, {})) {
            lock.unlock();
            writeEditorSettings(m_file, *settings);
            lock.lock();
        }
        if (stop)
            return;
    }
}

} // namespace limn
