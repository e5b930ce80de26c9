// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/view/explain_state.h"
#include "engine/core/result.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace limn {

/// What to explain.
struct ExplainOrder {
    std::shared_ptr<const Scene> scene;
    Prepared prepared; ///< by the scene's technique; null members: it needs none
    PixelQuestion question;
    std::vector<ObjectId> lights; ///< of the scene's lights

    /// Whether the order's scene is lit alike.
    bool sameLight(const ExplainOrder& o) const {
        return scene == o.scene && prepared.data == o.prepared.data;
    }
    bool operator==(const ExplainOrder& o) const { return sameLight(o) && question == o.question; }
};

/// Explains pixels in the background, one at a time. It lights the scene itself, so that it waits
/// for no other thread's light, and keeps that light for the next pixel of the same scene. No call
/// waits for it except the destructor, which cancels it.
class ExplainJob {
public:
    using Explained = Result<std::shared_ptr<const ExplainedPixel>>;

    /// `wake` is called from the thread when there is a result to show.
    explicit ExplainJob(std::function<void()> wake);
    ~ExplainJob();
    ExplainJob(const ExplainJob&) = delete;
    ExplainJob& operator=(const ExplainJob&) = delete;

    /// Returns false if an explanation is running.
    bool start(ExplainOrder order);
    /// True while an explanation is running or its result has not been taken.
    bool busy() const;

    /// Returns the result of the last order once.
    std::optional<Explained> takeResult();

private:
    Explained explain(const ExplainOrder& order);

    std::function<void()> m_wake;
    std::thread m_thread;
    std::atomic<bool> m_cancel{false}, m_running{false};
    std::optional<ExplainOrder> m_litFor; ///< of the thread: the order that m_lit was made for
    std::optional<ConvergedLight> m_lit;  ///< the same
    Viewpoint m_litView;                  ///< the same: of that order's picture
    mutable std::mutex m_mutex;           ///< guards m_result
    std::optional<Explained> m_result;
};

} // namespace limn
