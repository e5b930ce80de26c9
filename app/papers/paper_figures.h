// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace limn {

/// A number of an experiment, as measured here and as a paper prints it.
struct PaperFigure {
    std::string column; ///< quantity and unit, as in "caches [ms]"
    std::optional<double> measured;
    /// Standard error of an error; of a time, its 95th percentile over its median. 0: none.
    double noise = 0;
    std::optional<double> printed;
};

/// A line of an experiment's table.
struct PaperLine {
    std::string name; ///< settings, mode and device
    std::vector<PaperFigure> figures;
    std::string picture; ///< file in the folder of the report; empty: none
};

} // namespace limn
