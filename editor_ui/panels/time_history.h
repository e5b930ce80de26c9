// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"

#include <array>
#include <cstdint>

namespace limn {

/// Colours of an update's steps, by Okabe and Ito (Color Universal Design, 2008), distinguishable
/// by colour-blind people; bytes R, G, B, A from the lowest.
inline constexpr std::array<std::uint32_t, 7> kStepColors = {
    0xff009fe6, 0xffe9b456, 0xff739e00, 0xffb27200, 0xffa779cc, 0xff42e4f0, 0xff005ed5};

/// Milliseconds of the latest updates that did any work, step by step. Restarts at the first update
/// with other steps.
struct TimeHistory {
    static constexpr std::size_t kLength = 96;
    using Steps = std::array<float, kStepColors.size()>; ///< further steps are added to the last

    std::array<Steps, kLength> ms{}; ///< ring buffer
    std::uint64_t count = 0;         ///< ever added; the latest is number (count - 1) mod kLength
    std::array<const char*, kStepColors.size()> labels{}; ///< of the latest; null: no such step

    void add(const LightingReport& report);
    std::size_t size() const { return count < kLength ? std::size_t(count) : kLength; }
    /// Step times of the update that came `age` updates before the latest; age < size().
    const Steps& at(std::size_t age) const { return ms[std::size_t((count - 1 - age) % kLength)]; }
    float longest() const; ///< longest total of an update's steps [ms]
};

/// Draws the history as one bar per update, as wide as there is room, with a tooltip per bar.
void timeHistory(const TimeHistory& history);

} // namespace limn
