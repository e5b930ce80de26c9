// SPDX-License-Identifier: MIT
#include "editor_ui/panels/frame_record.h"

#include <utility>

namespace limn {

static void keepLonger(FrameTime& longest, const FrameTime& frame) {
    if (frame.beyondViewport() > longest.beyondViewport())
        longest = frame;
}

void FrameRecord::add(const FrameTime& frame, WorkSet working) {
    last = frame;
    keepLonger(sinceStart, frame);
    if (std::exchange(m_idle, false))
        sinceIdle = {};
    keepLonger(sinceIdle, frame);
    for (std::size_t i = 0; i < during.size(); ++i) {
        if (!working[i])
            continue;
        if (!m_working[i])
            during[i] = {};
        keepLonger(during[i], frame);
    }
    m_working = working;
}

} // namespace limn
