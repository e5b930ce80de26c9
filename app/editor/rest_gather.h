// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/final_gather.h"

#include <atomic>
#include <chrono>
#include <memory>

namespace limn {

/// What the light of a picture is gathered from, on the CPU. No member is null.
struct GatheredFrom {
    std::shared_ptr<const TraceScene> trace;
    std::shared_ptr<const LightmapLayout> layout;
    std::shared_ptr<const IndirectField> field;   ///< all of it is lit
    std::shared_ptr<const IndirectField> emitted; ///< Lighting::emittedField()
};

/// Final gathering of a picture that stands still, some rows at a time, so that those that are done
/// can be shown meanwhile.
class RestGather {
public:
    /// For a picture that is drawn with `options`; their `emitted` is replaced by that of `from`.
    RestGather(GatheredFrom from, FieldRenderOptions options);

    /// FinalGather::any(). If not, no other function may be called.
    bool any() const { return m_gather.any(); }

    /// Takes the picture as it was drawn, and the `rest` of it without diffuse light
    /// (ViewportOptions::diffuse).
    void begin(ImageF drawn, ImageF rest);

    bool done() const { return m_rows == m_gather.tileRows(); }
    /// Share of the rows of tiles that are gathered.
    float share() const { return float(m_rows) / float(m_gather.tileRows()); }

    /// Gathers rows of tiles for about this time, one at least. The last row gathered is shown once
    /// the next one is, because pixels take means across both. False if `hurry` was set before that
    /// was done; then the object is of no more use. Precondition: it has begun, and is not done().
    bool addRows(std::chrono::milliseconds time, const std::atomic<bool>& hurry);

    /// Rows that are done, and the others as they were drawn.
    const ImageF& picture() const { return m_picture; }

private:
    GatheredFrom m_from;
    FieldRenderOptions m_options;
    ImageF m_picture, m_rest;
    FinalGather m_gather;
    GatheredLight m_light;
    std::uint32_t m_rows = 0; ///< of tiles, that are gathered
};

} // namespace limn
