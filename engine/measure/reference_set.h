// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/compare.h"
#include "engine/reference/reference.h"

#include <array>
#include <cstdint>
#include <optional>

namespace limn {

/// References of one picture with independent noise and equal numbers of samples. There are two for
/// each of the two that compareImages() takes, so that one half can select the worst pixels and the
/// other measure them.
struct ReferenceSet {
    std::array<ImageF, 4> parts;
    std::uint32_t samplesPerPixel = 0; ///< number of samples of each part
    std::uint32_t passes = 0;          ///< number of passes, each with its own seeds

    ImageF first() const { return meanImage(parts[0], parts[1]); }
    ImageF second() const { return meanImage(parts[2], parts[3]); }
};

/// Renders a set with `options.samplesPerPixel` samples in each part; the options' seed is not
/// used. Returns std::nullopt when cancelled.
std::optional<ReferenceSet> renderReferenceSet(const TraceScene& trace,
                                               const ReferenceOptions& options,
                                               const Progress& progress = {});

/// Doubles the samples of a set that was rendered with these options. Returns false when cancelled;
/// the set is then unchanged.
bool refine(ReferenceSet& set, const TraceScene& trace, const ReferenceOptions& options,
            const Progress& progress = {});

/// Standard error of a pixel of the set's mean, rms over pixels and channels relative to the mean
/// of the picture; 0 for a black picture. Pixels that are NaN or Inf are left out.
double noiseOf(const ReferenceSet& set);

/// Compares with the set's two means. Here nrmseTrimmed is free of bias by noise: pixels are sorted
/// by the products of two parts, and the remaining ones are measured by those of the other two.
/// Because noise affects the sorting too, the pixels left out need not be exactly the worst. Fails
/// if sizes differ.
Result<Comparison> compareImages(const ImageF& test, const ReferenceSet& set);

/// Whether the figures are precise enough: the standard errors of nRMSE and bias are below a
/// quarter of the figures, or, for smaller figures, of the errors that matter, 0.1 and 2 %.
bool isSure(const Comparison& comparison);

} // namespace limn
