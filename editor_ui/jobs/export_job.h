// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/export_dialog.h"
#include "engine/core/result.h"
#include "engine/export/export_table.h"
#include "engine/lighting/precomputed.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace limn {

/// What to export, as it was when the user asked for it.
struct ExportOrder {
    Document document;
    std::shared_ptr<const Scene> scene; ///< flattened from the document
    Prepared prepared;                  ///< by the scene's technique; null members: it needs none
    ExportSettings settings;
    ExportFolders folders;
    std::string path;
};

/// Lights a scene to convergence and exports it in the background, one export at a time. No call
/// waits for it except the destructor, which cancels it.
class ExportJob {
public:
    /// `wake` is called from the thread when there is progress or a result to show.
    explicit ExportJob(std::function<void()> wake);
    ~ExportJob();
    ExportJob(const ExportJob&) = delete;
    ExportJob& operator=(const ExportJob&) = delete;

    /// Returns false if an export is running.
    bool start(ExportOrder order);
    void cancel() { m_cancel = true; }
    /// True while an export is running or its result has not been taken.
    bool busy() const;

    /// Returns the result of the last export once: the files, or the error ("cancelled").
    std::optional<Result<std::vector<ExportedFile>>> takeResult();

    /// Fills in whether an export is running, its stage and its fraction.
    void report(ExportStatus& status) const;

private:
    void work(const ExportOrder& order);

    std::function<void()> m_wake;
    std::thread m_thread;
    std::atomic<bool> m_cancel{false}, m_running{false};
    mutable std::mutex m_mutex; ///< guards the members below
    std::string m_stage;
    float m_fraction = 0;
    std::optional<Result<std::vector<ExportedFile>>> m_result;
};

} // namespace limn
