// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bitset>
#include <cstddef>

namespace limn {

/// Work beside the window, of which FrameRecord tells frames apart.
enum class Work { Open, Bake, Relight, Reference, Save, Explain, Lint, Export };

/// As statistics and --stats-json name them.
inline constexpr std::array kWorkNames{"open", "bake",    "relight", "reference",
                                       "save", "explain", "lint",    "export"};

using WorkSet = std::bitset<kWorkNames.size()>; ///< bit number Work: that work is going on

/// What a frame of the window took, without waiting for events [ms].
struct FrameTime {
    double panels = 0;   ///< drawing the panels and answering mouse and keys
    double jobs = 0;     ///< following the document, taking in what jobs finished
    double viewport = 0; ///< requesting the viewport's picture, taking it in and copying it
    double window = 0;   ///< recording and presenting the window's own picture

    double total() const { return panels + jobs + viewport + window; }
    double beyondViewport() const { return total() - viewport; }
};

/// Longest frames of the window, by FrameTime::beyondViewport().
struct FrameRecord {
    FrameTime last, sinceStart;
    FrameTime sinceIdle;                               ///< since idle() was last called
    std::array<FrameTime, kWorkNames.size()> during{}; ///< the latest run of each Work; 0: none yet

    /// Takes in a frame. `working`: what was going on before or after it, so that the frames in
    /// which a job is ordered and in which its result is taken count as that work's.
    void add(const FrameTime& frame, WorkSet working);
    /// Call when all work is done: sinceIdle begins anew with the next frame.
    void idle() { m_idle = true; }

    const FrameTime& of(Work work) const { return during[std::size_t(work)]; }

private:
    WorkSet m_working; ///< of the latest frame
    bool m_idle = false;
};

} // namespace limn
