// SPDX-License-Identifier: MIT
#include "engine/scene/light/light_profile.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

/// Two neighbours in a row of evenly spaced samples.
struct Between {
    std::uint32_t first = 0, second = 0;
    float weight = 0; ///< of the second, [0, 1]
};

/// Rows around a vertical angle [degrees], which lies in the profile's range.
static Between rowsAround(const LightProfile& p, float vertical) {
    const float step = (p.lastVertical - p.firstVertical) / float(p.rows - 1);
    const float y = std::clamp((vertical - p.firstVertical) / step, 0.f, float(p.rows - 1));
    const auto row = std::min(std::uint32_t(y), p.rows - 2);
    return {row, row + 1, y - float(row)};
}

/// Columns around a horizontal angle [rad].
static Between columnsAround(const LightProfile& p, float horizontal) {
    const float turns = horizontal / (2 * glm::pi<float>());
    const float x = (turns - std::floor(turns)) * float(p.columns);
    const auto column = std::min(std::uint32_t(x), p.columns - 1);
    return {column, (column + 1) % p.columns, x - float(column)};
}

static float inColumn(const LightProfile& p, std::uint32_t column, const Between& rows) {
    const float* share = p.share.data() + std::size_t(column) * p.rows;
    return share[rows.first] + (share[rows.second] - share[rows.first]) * rows.weight;
}

/// Whether light leaves at a vertical angle [degrees]. The margin covers what rounding takes from
/// the first and the last row.
static bool inRange(const LightProfile& p, float vertical) {
    constexpr float kMargin = 1e-3f;
    return vertical >= p.firstVertical - kMargin && vertical <= p.lastVertical + kMargin;
}

std::string profileDefect(const LightProfile& p) {
    if (!(p.peak > 0) || !std::isfinite(p.peak))
        return "peak: not a positive number";
    if (!(p.firstVertical >= 0) || !(p.firstVertical < p.lastVertical) || !(p.lastVertical <= 180))
        return "lastVertical: not above firstVertical, both 0 to 180 degrees";
    if (p.rows < 2 || p.rows > kMaxProfileRows)
        return fmt::format("rows: not 2 to {}", kMaxProfileRows);
    if (p.columns < 1 || p.columns > kMaxProfileColumns)
        return fmt::format("columns: not 1 to {}", kMaxProfileColumns);
    if (p.share.size() != std::size_t(p.rows) * p.columns)
        return fmt::format("share: {} numbers for {} rows of {} columns", p.share.size(), p.rows,
                           p.columns);
    if (!std::ranges::all_of(p.share, [](float s) { return s >= 0 && s <= 1; }))
        return "share: a number that is not 0 to 1";
    return {};
}

float profileShare(const LightProfile& p, const glm::mat3& axes, glm::vec3 direction) {
    const glm::vec3 local = direction * axes;
    const float vertical =
        glm::degrees(std::atan2(std::hypot(local.x, local.y), local.z)); // exact near the axis
    if (!inRange(p, vertical))
        return 0;
    const Between rows = rowsAround(p, vertical);
    if (p.columns == 1)
        return inColumn(p, 0, rows);
    const Between columns = columnsAround(p, std::atan2(local.y, local.x));
    const float first = inColumn(p, columns.first, rows);
    return first + (inColumn(p, columns.second, rows) - first) * columns.weight;
}

double meanShare(const LightProfile& p, double vertical) {
    const auto degrees = float(glm::degrees(vertical));
    if (!inRange(p, degrees))
        return 0;
    const Between rows = rowsAround(p, degrees);
    double sum = 0;
    for (std::uint32_t column = 0; column < p.columns; ++column)
        sum += double(inColumn(p, column, rows));
    return sum / double(p.columns);
}

double profileSolidAngle(const LightProfile& p) {
    // The mean around the axis is linear between rows, and
    // the integral of (a + b t) sin t is b sin t - (a + b t) cos t.
    const double first = glm::radians(double(p.firstVertical)),
                 step = (glm::radians(double(p.lastVertical)) - first) / double(p.rows - 1);
    std::vector<double> mean(p.rows, 0);
    for (std::uint32_t column = 0; column < p.columns; ++column)
        for (std::uint32_t row = 0; row < p.rows; ++row)
            mean[row] += double(p.share[std::size_t(column) * p.rows + row]) / double(p.columns);
    double sum = 0;
    for (std::uint32_t row = 0; row + 1 < p.rows; ++row) {
        const double t0 = first + step * double(row), t1 = t0 + step,
                     slope = (mean[row + 1] - mean[row]) / step;
        sum += slope * (std::sin(t1) - std::sin(t0)) - mean[row + 1] * std::cos(t1) +
               mean[row] * std::cos(t0);
    }
    return 2 * glm::pi<double>() * sum;
}

} // namespace limn
