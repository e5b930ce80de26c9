// SPDX-License-Identifier: MIT
#pragma once

#include "engine/stages/stage_store.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace limn {

/// Measures the stages of a precomputation one after the other.
class StageClock {
public:
    /// `store` may be null.
    explicit StageClock(const StageStore* store) : m_store(store) {
        if (store)
            m_traffic = store->traffic();
    }
    void finish(const char* stage) {
        const auto now = std::chrono::steady_clock::now();
        seconds.emplace_back(stage, std::chrono::duration<double>(now - m_last).count());
        m_last = now;
        if (!m_store)
            return;
        const StageStore::Traffic before = std::exchange(m_traffic, m_store->traffic());
        if (m_traffic.found > before.found && m_traffic.stored == before.stored)
            keptStages.emplace_back(stage);
    }

    std::vector<std::pair<std::string, double>> seconds; ///< per finished stage, in order
    std::vector<std::string> keptStages; ///< of them: found in the store rather than computed

private:
    const StageStore* m_store;
    StageStore::Traffic m_traffic;
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

} // namespace limn
