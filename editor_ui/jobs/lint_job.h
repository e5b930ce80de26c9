// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/lint/finding.h"
#include "engine/scene/scene.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace limn {

/// What to check.
struct LintOrder {
    std::shared_ptr<const Document> document;
    std::shared_ptr<const Assets> assets;
    std::vector<std::string> repairs; ///< ImportedScene::repairs
    MemoryBudget memory;              ///< of a bake
};

/// Checks scenes in the background, one at a time. No call waits for it except the destructor,
/// which cancels it.
class LintJob {
public:
    using Checked = Result<std::shared_ptr<const std::vector<Finding>>>;

    /// `wake` is called from the thread when there is progress or a result to show.
    explicit LintJob(std::function<void()> wake);
    ~LintJob();
    LintJob(const LintJob&) = delete;
    LintJob& operator=(const LintJob&) = delete;

    /// Returns false if a check is running or its result has not been taken.
    bool start(LintOrder order);
    void cancel();
    /// True while a check is running or its result has not been taken.
    bool busy() const;
    /// That of the last order; null: there was none.
    const std::shared_ptr<const Document>& document() const { return m_document; }
    /// Stage of the running check and the fraction of it that is done.
    void report(std::string& stage, float& fraction) const;

    /// Returns the result of the last order once; it failed where it was cancelled.
    std::optional<Checked> takeResult();

private:
    Checked check(const LintOrder& order);

    std::function<void()> m_wake;
    std::shared_ptr<const Document> m_document;
    std::thread m_thread;
    std::atomic<bool> m_cancel{false}, m_running{false};
    mutable std::mutex m_mutex; ///< guards what follows
    std::string m_stage;
    float m_fraction = 0;
    std::optional<Checked> m_result;
};

} // namespace limn
