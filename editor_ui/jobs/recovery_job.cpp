// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/recovery_job.h"

#include "editor_ui/jobs/background_priority.h"

#include <utility>

namespace limn {

using Clock = std::chrono::steady_clock;

RecoveryJob::RecoveryJob(std::string root)
    : m_root(std::move(root)), m_thread([this] {
          lowerThreadPriority();
          run();
      }) {}

RecoveryJob::~RecoveryJob() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
    }
    m_changed.notify_all();
    m_thread.join();
}

void RecoveryJob::set(Copy copy) {
    {
        const std::lock_guard lock(m_mutex);
        if (m_root.empty() || copy == m_wanted)
            return;
        if (!m_pending)
            m_due = Clock::now() + kRecoveryDelay;
        m_pending = true;
        m_wanted = std::move(copy);
    }
    m_changed.notify_all();
}

void RecoveryJob::keep(std::shared_ptr<const Document> document, const std::string& originalPath) {
    set({std::move(document), originalPath});
}

void RecoveryJob::adopt(Recovery recovery, std::shared_ptr<const Document> document) {
    {
        const std::lock_guard lock(m_mutex);
        m_adopted = std::move(recovery.folder);
    }
    set({std::move(document), std::move(recovery.originalPath)});
}

void RecoveryJob::clear() {
    set({});
}

std::string RecoveryJob::takeProblem() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_problem, {});
}

Result<void> RecoveryJob::write(RecoveryFolder& folder, const Copy& copy) const {
    if (!copy.document) {
        removeRecovery(folder);
        return {};
    }
    if (folder.path.empty()) {
        Result<RecoveryFolder> created = createRecoveryFolder(m_root);
        if (!created)
            return tl::make_unexpected(created.error());
        folder = std::move(*created);
    }
    return writeRecovery(folder, copy.originalPath, *copy.document);
}

void RecoveryJob::run() {
    RecoveryFolder folder;
    std::unique_lock lock(m_mutex);
    for (;;) {
        m_changed.wait(lock, [&] { return m_stop || m_pending; });
        if (!m_pending)
            return;
        m_changed.wait_until(lock, m_due, [&] { return m_stop || !m_wanted.document; });
        const Copy copy = m_wanted;
        RecoveryFolder adopted = std::exchange(m_adopted, {});
        m_pending = false;
        lock.unlock();
        if (!adopted.path.empty()) {
            removeRecovery(folder);
            folder = std::move(adopted);
        }
        const Result<void> written = write(folder, copy);
        lock.lock();
        if (!written)
            m_problem = written.error().message;
    }
}

} // namespace limn
