// SPDX-License-Identifier: MIT
#include "app/editor/rest_gather.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace limn {

using Clock = std::chrono::steady_clock;

static FieldRenderOptions withStraight(FieldRenderOptions options, const GatheredFrom& from) {
    options.straight = from.straight;
    return options;
}

RestGather::RestGather(GatheredFrom from, FieldRenderOptions options)
    : m_from(std::move(from)), m_options(withStraight(std::move(options), m_from)),
      m_gather(*m_from.trace, *m_from.field, *m_from.layout, m_options) {}

void RestGather::begin(ImageF drawn, ImageF rest) {
    assert(any() && drawn.rgb.size() == rest.rgb.size());
    m_picture = std::move(drawn);
    m_rest = std::move(rest);
}

bool RestGather::addRows(std::chrono::milliseconds time, const std::atomic<bool>& hurry) {
    const Clock::time_point start = Clock::now();
    Progress progress;
    progress.cancel = &hurry;
    do {
        if (!m_gather.addRows(m_rest, m_rows, m_rows + 1, progress))
            return false;
        const std::size_t row = std::size_t(kGatherTile) * m_rest.width,
                          begin = std::min(m_rows * row, m_rest.rgb.size()),
                          end = std::min(begin + row, m_rest.rgb.size());
        std::copy(m_rest.rgb.begin() + std::ptrdiff_t(begin),
                  m_rest.rgb.begin() + std::ptrdiff_t(end),
                  m_picture.rgb.begin() + std::ptrdiff_t(begin));
        ++m_rows;
    } while (!done() && Clock::now() - start < time);
    return true;
}

} // namespace limn
