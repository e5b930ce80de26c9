// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/compare.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace limn {

/// The picture's error against the reference, measured again and again since the last edit.
struct ErrorHistory {
    using Clock = std::chrono::steady_clock;

    /// One measurement.
    struct Point {
        double seconds = 0; ///< since the edit
        double nrmse = 0;   ///< Comparison::nrmse
        double noise = 0;   ///< Comparison::nrmseNoise
    };
    static constexpr std::size_t kMaxPoints = 512; ///< every other one is dropped beyond

    std::vector<Point> points; ///< oldest first

    /// An edit: forgets all points and counts seconds from `now`.
    void restart(Clock::time_point now);
    /// Adds a measurement whose number was not added before (ComparedPicture::number).
    void add(Clock::time_point now, std::uint64_t number, const Comparison& error);

private:
    Clock::time_point m_edited = Clock::now();
    std::uint64_t m_number = 0; ///< of the newest point
};

} // namespace limn
