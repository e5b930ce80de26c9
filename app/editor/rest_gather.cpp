// SPDX-License-Identifier: MIT
#include "app/editor/rest_gather.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace limn {

using Clock = std::chrono::steady_clock;

static FieldRenderOptions withEmittedField(FieldRenderOptions options, const GatheredFrom& from) {
    options.emitted = from.emitted;
    return options;
}

RestGather::RestGather(GatheredFrom from, FieldRenderOptions options)
    : m_from(std::move(from)), m_options(withEmittedField(std::move(options), m_from)),
      m_gather(*m_from.trace, *m_from.field, *m_from.layout, m_options),
      m_light(any() ? m_gather.picture() : PixelRect{}) {}

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
        if (!m_gather.gatherRows(m_light, m_rows, m_rows + 1, progress))
            return false;
        ++m_rows;
        const std::uint32_t first = (std::max(m_rows, 2U) - 2) * kGatherTile, width = m_rest.width,
                            last = done() ? m_rest.height : (m_rows - 1) * kGatherTile;
        addGathered(m_rest, m_light, {{0, first}, {width, last}});
        std::copy(m_rest.rgb.begin() + std::ptrdiff_t(first) * width,
                  m_rest.rgb.begin() + std::ptrdiff_t(last) * width,
                  m_picture.rgb.begin() + std::ptrdiff_t(first) * width);
    } while (!done() && Clock::now() - start < time);
    return true;
}

} // namespace limn
