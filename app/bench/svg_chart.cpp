// SPDX-License-Identifier: MIT
#include "app/bench/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

/// A logarithmic axis from `lower` to `upper`, both > 0, over pixels [from, to].
struct Axis {
    double lower, upper, from, to;

    double at(double value) const {
        const double share =
            std::log(std::max(value, kLeastShown) / lower) / std::log(upper / lower);
        return from + share * (to - from);
    }
};

/// 1, 2 or 5 times a power of ten.
double step(int k) {
    constexpr std::array kSteps = {1., 2., 5.};
    const int decade = k >= 0 ? k / 3 : -((2 - k) / 3);
    return kSteps[std::size_t(k - 3 * decade)] * std::pow(10, decade);
}

/// The axis of the values, and the first and the last step on it.
std::pair<Axis, std::pair<int, int>> axisOf(const std::vector<ChartMark>& marks,
                                            double ChartMark::*value, double from, double to) {
    double lower = 1e30, upper = kLeastShown;
    for (const ChartMark& mark : marks) {
        lower = std::min(lower, std::max(mark.*value, kLeastShown));
        upper = std::max(upper, mark.*value);
    }
    int first = int(std::floor(3 * std::log10(lower))) + 1, last = first;
    while (step(first) > lower)
        --first;
    while (step(last) < upper || last <= first)
        ++last;
    return {{step(first), step(last), from, to}, {first, last}};
}

constexpr double kWidth = 520, kHeight = 330, kLeft = 50, kBottom = 290, kTop = 26, kRight = 490;

void addLine(std::string& svg, double x0, double y0, double x1, double y1) {
    svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                       "stroke=\"#ddd\"/>\n",
                       x0, y0, x1, y1);
}

void addText(std::string& svg, double x, double y, const char* anchor, const std::string& text) {
    svg +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"#444\">{}</text>\n",
                    x, y, anchor, text);
}

} // namespace

std::string escapedHtml(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '<'   ? "&lt;"
                  : c == '>' ? "&gt;"
                  : c == '&' ? "&amp;"
                  : c == '"' ? "&quot;"
                             : std::string(1, c);
    return result;
}

std::string svgOf(const Chart& chart) {
    const auto [x, xSteps] = axisOf(chart.marks, &ChartMark::x, kLeft, kRight);
    const auto [y, ySteps] = axisOf(chart.marks, &ChartMark::y, kBottom, kTop);
    std::string svg =
        fmt::format("<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
                    "aria-label=\"{2}\">\n",
                    kWidth, kHeight, escapedHtml(chart.xTitle));
    for (int k = xSteps.first; k <= xSteps.second; ++k) {
        addLine(svg, x.at(step(k)), kTop, x.at(step(k)), kBottom);
        addText(svg, x.at(step(k)), kBottom + 16, "middle", fmt::format("{:g}", step(k)));
    }
    for (int k = ySteps.first; k <= ySteps.second; ++k) {
        addLine(svg, kLeft, y.at(step(k)), kRight, y.at(step(k)));
        addText(svg, kLeft - 6, y.at(step(k)) + 4, "end", fmt::format("{:g}", step(k)));
    }
    if (!chart.line.empty()) {
        svg += "<polyline fill=\"none\" stroke=\"#888\" stroke-width=\"1.5\" points=\"";
        for (const std::size_t i : chart.line)
            svg += fmt::format("{:.1f},{:.1f} ", x.at(chart.marks[i].x), y.at(chart.marks[i].y));
        svg += "\"/>\n";
    }
    for (const ChartMark& mark : chart.marks) {
        const double px = x.at(mark.x), py = y.at(mark.y);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" "
                           "fill=\"{}\">{}<title>{}</title></text>\n",
                           px, py + 5, mark.ink.color, mark.ink.mark, escapedHtml(mark.title));
        if (mark.label.empty())
            continue;
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\" fill=\"none\" "
                           "stroke=\"#444\"/>\n",
                           px, py);
        const bool right = px > kRight - 60; // no room beside it
        addText(svg, right ? px - 12 : px + 12, py - 7, right ? "end" : "start",
                escapedHtml(mark.label));
    }
    addText(svg, (kLeft + kRight) / 2, kHeight - 4, "middle", escapedHtml(chart.xTitle));
    addText(svg, 4, 11, "start", escapedHtml(chart.yTitle));
    return svg + "</svg>\n";
}

} // namespace limn
