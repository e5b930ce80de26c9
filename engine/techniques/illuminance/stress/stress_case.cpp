// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/stress_case.h"

#include "engine/gallery/hostile_scene.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace limn {

namespace {

using Clock = std::chrono::steady_clock;

/// Cancels a case when its time is up.
class Deadline {
public:
    explicit Deadline(double seconds)
        : m_thread([this, seconds](const std::stop_token& stop) {
              std::unique_lock lock(m_mutex);
              m_wake.wait_for(lock, stop, std::chrono::duration<double>(seconds),
                              [] { return false; });
              m_past = !stop.stop_requested();
          }) {}
    bool past() const { return m_past; }
    Progress progress() const { return {.report = nullptr, .cancel = &m_past}; }

private:
    std::atomic<bool> m_past = false;
    std::mutex m_mutex;
    std::condition_variable_any m_wake;
    std::jthread m_thread; ///< declared last, so that it ends first
};

} // namespace

StressCase generatedCase(std::uint64_t seed) {
    HostileScene scene = hostileScene(seed);
    return {seed, std::move(scene.document), std::move(scene.assets), std::move(scene.description)};
}

CaseResult runCase(const StressCase& c, const std::vector<Oracle>& oracles,
                   const CaseLimits& limits) {
    const Clock::time_point start = Clock::now();
    const Deadline deadline(limits.seconds);
    CaseResult result{.seed = c.seed,
                      .judgements = std::vector<Judgement>(oracles.size()),
                      .note = c.description};
    Result<LitScene> base = bakeAndLight(flatten(c.document, c.assets), deadline.progress());
    if (!base && !deadline.past()) {
        result.end = CaseEnd::Refused;
        result.note = base.error().message;
    }
    if (base) {
        const Subject subject{c.seed, std::move(*base), limits.folder, deadline.progress(),
                              &c.document};
        for (std::size_t i = 0; i < oracles.size() && !deadline.past(); ++i) {
            const Judgement judgement = oracles[i].judge(subject);
            if (!deadline.past()) // a cancelled judgement is meaningless
                result.judgements[i] = judgement;
        }
    }
    if (deadline.past())
        result.end = CaseEnd::Slow;
    result.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return result;
}

} // namespace limn
