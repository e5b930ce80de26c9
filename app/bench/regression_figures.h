// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace limn {

/// A figure of a scene that must not become worse: an error, nearer to 0 is better.
struct RegressionFigure {
    std::string scene, name, unit;
    double value = 0;
    double noise = 0; ///< standard error of `value`, >= 0

    bool operator==(const RegressionFigure&) const = default;
};

/// How far a figure may lie from `committed`: four times its noise. The noise counts once for
/// either of the two, and is itself estimated from few trials. At least half a per cent of the
/// value, as processors with other vector units round otherwise.
double toleranceOf(const RegressionFigure& committed);

enum class FigureChange : std::uint8_t {
    Same,       ///< within the tolerance
    Better,     ///< nearer to 0 by more
    Worse,      ///< farther from 0 by more, or not a number
    Unmeasured, ///< committed, but not measured
    Uncommitted ///< measured, but not committed
};

struct FigureVerdict {
    FigureChange change = FigureChange::Same;
    RegressionFigure committed, measured; ///< one of them is empty where it does not exist
    bool fails() const { return change != FigureChange::Same && change != FigureChange::Better; }
};

/// Judges figures, which go by scene and name, in the order of `committed`, and after them those
/// that were measured alone.
std::vector<FigureVerdict> judgeFigures(std::span<const RegressionFigure> committed,
                                        std::span<const RegressionFigure> measured);

/// A sentence that names the scene, the figure, and both values.
std::string describe(const FigureVerdict& verdict);

/// Reads what writeFigures() wrote. Errors name the file and the field.
Result<std::vector<RegressionFigure>> readFigures(const std::string& path);

/// Values keep four digits, which is far below their tolerance. Fails on a figure that is not
/// finite, and where the file cannot be written.
Result<void> writeFigures(const std::string& path, std::span<const RegressionFigure> figures);

} // namespace limn
