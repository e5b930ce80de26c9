// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/relight/relight.h"

#include <array>
#include <cstdint>

namespace limn {

/// A step of relighting as the statistics show it.
struct RelightStep {
    const char *label, *tooltip;
    std::uint32_t color; ///< bytes R, G, B, A from the lowest
    double (*ms)(const RelightStats&);
};

/// In the order they run. Colours by Okabe and Ito (Color Universal Design, 2008), so that the
/// colour-blind tell them apart.
inline constexpr std::array<RelightStep, 5> kRelightSteps = {
    {{"Direct light", "Lights onto the surfels, with shadow rays", 0xff009fe6,
      [](const RelightStats& r) { return r.directMs; }},
     {"Surfel light", "Bounced light at the surfels, and what they send on", 0xffe9b456,
      [](const RelightStats& r) { return r.surfelLightMs + r.surfelReadMs; }},
     {"Pull", "Sums flux up the cluster tree", 0xff739e00,
      [](const RelightStats& r) { return r.pullMs; }},
     {"Cache light", "Gathers linked clusters into the caches; finds what moved objects hide",
      0xffb27200, [](const RelightStats& r) { return r.cacheLightMs + r.dimMs; }},
     {"Field", "What the viewport samples, from the caches", 0xffa779cc,
      [](const RelightStats& r) { return r.fieldMs; }}}};

/// Milliseconds of the latest updates that did any work, step by step.
struct TimeHistory {
    static constexpr std::size_t kLength = 96;
    std::array<std::array<float, kRelightSteps.size()>, kLength> ms{}; ///< a ring
    std::uint64_t count = 0; ///< ever added; the latest is number (count - 1) mod kLength

    void add(const RelightStats& stats);
    std::size_t size() const { return count < kLength ? std::size_t(count) : kLength; }
    /// Of the update that came `age` updates before the latest; age < size().
    const std::array<float, kRelightSteps.size()>& at(std::size_t age) const {
        return ms[std::size_t((count - 1 - age) % kLength)];
    }
    float longest() const; ///< [ms] of all steps of one update together
};

/// Draws the history as one bar per update, as wide as there is room, with a tooltip per bar.
void timeHistory(const TimeHistory& history);

} // namespace limn
