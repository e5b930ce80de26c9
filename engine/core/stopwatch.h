// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <utility>

namespace limn {

/// Measures the steps of a computation one after the other.
class Stopwatch {
public:
    /// Milliseconds since the last call, or since construction.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double, std::milli>(now - std::exchange(m_last, now)).count();
    }

private:
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

} // namespace limn
