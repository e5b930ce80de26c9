// SPDX-License-Identifier: MIT
#include "editor_ui/panels/error_history.h"

namespace limn {

void ErrorHistory::restart(Clock::time_point now) {
    points.clear();
    m_edited = now;
}

void ErrorHistory::add(Clock::time_point now, std::uint64_t number, const Comparison& error) {
    if (number == m_number)
        return;
    m_number = number;
    points.push_back(
        {std::chrono::duration<double>(now - m_edited).count(), error.nrmse, error.nrmseNoise});
    if (points.size() <= kMaxPoints)
        return;
    for (std::size_t i = 1; 2 * i < points.size(); ++i) // the first and the last stay
        points[i] = points[2 * i];
    points.resize(kMaxPoints / 2 + 1);
}

} // namespace limn
