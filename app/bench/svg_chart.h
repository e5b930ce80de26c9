// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

namespace limn {

/// Colours that colour-blind people tell apart (Okabe, Ito. Color Universal Design. 2008), with a
/// mark for each.
struct Ink {
    const char *color, *mark;
};
inline constexpr std::array<Ink, 6> kInks = {{{"#0072b2", "\u25cf"},
                                              {"#d55e00", "\u25a0"},
                                              {"#009e73", "\u25b2"},
                                              {"#cc79a7", "\u25c6"},
                                              {"#000000", "\u2716"},
                                              {"#e69f00", "\u2605"}}};

/// A place on a chart. Coordinates below kLeastShown are drawn there.
struct ChartMark {
    double x = 0, y = 0;
    Ink ink;
    std::string title; ///< shown where the mouse rests
    std::string label; ///< shown beside the mark, which then has a ring; empty: neither
};
inline constexpr double kLeastShown = 0.01;

/// A chart with logarithmic axes.
struct Chart {
    std::string xTitle, yTitle;
    std::vector<ChartMark> marks;
    std::vector<std::size_t> line; ///< marks that a line joins, in order
};

/// The chart as an SVG element of HTML. Precondition: there are marks.
std::string svgOf(const Chart& chart);

/// Text for HTML, also within quoted attributes.
std::string escapedHtml(const std::string& text);

} // namespace limn
