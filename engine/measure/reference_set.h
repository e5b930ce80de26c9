// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/compare.h"
#include "engine/reference/reference.h"

#include <array>
#include <cstdint>
#include <optional>

namespace limn {

/// References of one picture with independent noise, of equally many samples: two for each of the
/// two that compareImages() takes, so that the worst pixels can be chosen by one half and measured
/// by the other.
struct ReferenceSet {
    std::array<ImageF, 4> parts;
    std::uint32_t samplesPerPixel = 0; ///< of each part
    std::uint32_t passes = 0;          ///< each has seeds of its own

    ImageF first() const { return meanImage(parts[0], parts[1]); }
    ImageF second() const { return meanImage(parts[2], parts[3]); }
};

/// A set with `options.samplesPerPixel` samples in each part; its seed is not used. Nothing when
/// cancelled.
std::optional<ReferenceSet> renderReferenceSet(const TraceScene& trace,
                                               const ReferenceOptions& options,
                                               const Progress& progress = {});

/// Doubles the samples of a set that was rendered with these options. False when cancelled, which
/// leaves it as it was.
bool refine(ReferenceSet& set, const TraceScene& trace, const ReferenceOptions& options,
            const Progress& progress = {});

/// compareImages() against the set's two means. nrmseMost is free of noise here: pixels are sorted
/// by the products of two parts, and what is left is measured by those of the other two. As noise
/// chooses too, the pixels left out need not be the very worst. Fails when sizes differ.
Result<Comparison> compareImages(const ImageF& test, const ReferenceSet& set);

/// Whether the figures are sure: standard errors of nRMSE and bias below a quarter of them, or of
/// the error that matters, 0.1 and 2 %, where they are smaller than that.
bool isSure(const Comparison& comparison);

} // namespace limn
