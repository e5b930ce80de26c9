// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/recovery_folder.h"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace limn {

/// Time between an edit and its copy on disk, without the time that writing takes. A drag that goes
/// on for long is copied as often.
inline constexpr std::chrono::milliseconds kRecoveryDelay{2000};

/// Keeps a copy of the unsaved document in a recovery folder, on its own thread. No call waits for
/// the disk except the destructor, which writes what has not been written yet.
class RecoveryJob {
public:
    /// The folder is created in `root` when there is something to keep; if `root` is empty, nothing
    /// is kept.
    explicit RecoveryJob(std::string root);
    ~RecoveryJob();
    RecoveryJob(const RecoveryJob&) = delete;
    RecoveryJob& operator=(const RecoveryJob&) = delete;

    /// Keeps a copy of `document`, which is a changed version of the project or scene at
    /// `originalPath`. Documents are compared by their address.
    void keep(std::shared_ptr<const Document> document, const std::string& originalPath);
    /// Goes on with the folder of a recovered document, which is `document` now.
    void adopt(Recovery recovery, std::shared_ptr<const Document> document);
    /// Deletes the copy: the document is as in its file, or nobody wants it.
    void clear();

    /// Why the last copy could not be written, once.
    std::string takeProblem();

private:
    struct Copy {
        std::shared_ptr<const Document> document; ///< null: none
        std::string originalPath;

        bool operator==(const Copy&) const = default;
    };
    void set(Copy copy);
    void run();
    Result<void> write(RecoveryFolder& folder, const Copy& copy) const;

    std::string m_root;
    std::mutex m_mutex; ///< guards the members below
    std::condition_variable m_changed;
    Copy m_wanted;
    bool m_pending = false;                      ///< m_wanted has not been written
    std::chrono::steady_clock::time_point m_due; ///< when to write it
    RecoveryFolder m_adopted;                    ///< not yet taken
    std::string m_problem;
    bool m_stop = false;
    std::thread m_thread; ///< declared last, so that it starts after all other members exist
};

} // namespace limn
