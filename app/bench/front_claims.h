// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"

#include <string>
#include <vector>

namespace limn {

/// A sentence of Jendersie, Kuri, Grosch. Real-Time Global Illumination Using Precomputed
/// Illuminance Composition with Chrominance Compression. 2016, and what rows say about it.
struct PaperClaim {
    enum class Verdict { Holds, Fails, Unknown } verdict = Verdict::Unknown;
    const char* sentence; ///< as the paper has it
    std::string reason;   ///< the figures, or what rows would be needed
};

/// "In general, reducing n_S is more stable than reducing n_L" (5.3.2). Rows that differ in one of
/// the two alone give the factor by which a halving of it multiplies the error; the medians of both
/// factors, each less 1, are compared. Equal within a hundredth counts as unknown.
PaperClaim surfelsAreSaferToReduce(const std::vector<Json>& rows);

/// "The visual gain above six bands is small" (6). Holds where more than six bands take less than a
/// twentieth off the error of six. Rows of surfaces that read no more than six say nothing.
PaperClaim littleGainAboveSixBands(const std::vector<Json>& rows);

/// "Using the compression should only be considered for higher number of bands (6+)" (5.3.3).
/// Compression pays where it saves a larger share of the time than it adds to the error. Holds
/// where it does with six bands and more, and does not with fewer, in the median.
PaperClaim chrominancePaysFromSixBands(const std::vector<Json>& rows);

std::vector<PaperClaim> paperClaims(const std::vector<Json>& rows);

} // namespace limn
