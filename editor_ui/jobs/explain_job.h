// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/view/explain_state.h"
#include "engine/core/result.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace limn {

/// What to explain, or, where there are goals, to solve.
struct ExplainOrder {
    std::shared_ptr<const Scene> scene;
    Prepared prepared; ///< by the scene's technique; null members: it needs none
    PixelQuestion question;
    std::vector<ObjectId> lights; ///< of the scene's lights
    std::vector<StrengthGoal> goals;
    std::vector<std::uint32_t> free; ///< the lights that may change for them

    /// Whether the order's scene is lit alike.
    bool sameLight(const ExplainOrder& o) const {
        return scene == o.scene && prepared.data == o.prepared.data;
    }
    bool operator==(const ExplainOrder& o) const {
        return sameLight(o) && question == o.question && goals == o.goals && free == o.free;
    }
};

/// Strengths that were found for goals.
struct SolvedLights {
    std::shared_ptr<const Scene> scene; ///< of the order
    std::vector<ObjectId> lights;       ///< of the order
    Result<SolvedStrengths> strengths;
};

/// Explains pixels and solves for strengths in the background, one at a time. It lights the scene
/// itself, so that it waits for no other thread's light, and keeps that light for the next pixel of
/// the same scene. No call waits for it except the destructor, which cancels it.
class ExplainJob {
public:
    using Explained = Result<std::shared_ptr<const ExplainedPixel>>;

    /// `wake` is called from the thread when there is a result to show.
    explicit ExplainJob(std::function<void()> wake);
    ~ExplainJob();
    ExplainJob(const ExplainJob&) = delete;
    ExplainJob& operator=(const ExplainJob&) = delete;

    /// Returns false if an order is being carried out.
    bool start(ExplainOrder order);
    /// True while an order is being carried out or its result has not been taken.
    bool busy() const;

    /// The newest order; std::nullopt: there was none.
    const std::optional<ExplainOrder>& order() const { return m_order; }

    /// Stage of the order that is being carried out and the fraction of it that is done.
    void report(std::string& stage, float& fraction) const;

    /// Each returns the result of the last order of its kind once.
    std::optional<Explained> takeResult();
    std::optional<SolvedLights> takeSolved();

private:
    Progress progress();
    Result<void> light(const ExplainOrder& order);
    Explained explain(const ExplainOrder& order) const;
    void carryOut(const ExplainOrder& order);

    std::function<void()> m_wake;
    std::optional<ExplainOrder> m_order;
    std::thread m_thread;
    std::atomic<bool> m_cancel{false}, m_running{false};
    std::optional<ExplainOrder> m_litFor; ///< of the thread: the order that m_lit was made for
    std::optional<ConvergedLight> m_lit;  ///< the same
    Viewpoint m_litView;                  ///< the same: of that order's picture
    mutable std::mutex m_mutex;           ///< guards what follows
    std::optional<Explained> m_result;
    std::optional<SolvedLights> m_solved;
    std::string m_stage;
    float m_fraction = 0;
};

} // namespace limn
