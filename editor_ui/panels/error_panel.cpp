// SPDX-License-Identifier: MIT
#include "editor_ui/panels/error_panel.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace limn {

namespace {

/// Of the plot: from 0 to `seconds` and from 0 to `maxError`.
struct Plot {
    ImVec2 from, to; ///< [px]
    double seconds = 1, maxError = 1;

    ImVec2 at(double x, double y) const {
        return {from.x + float(x / seconds) * (to.x - from.x),
                to.y - float(std::min(y / maxError, 1.0)) * (to.y - from.y)};
    }
};

} // namespace

/// The next of 1, 2, 5, 10, ... that is no less; 1e-3 for 0.
static double roundUp(double value) {
    const double step = std::pow(10, std::floor(std::log10(std::max(value, 1e-3))));
    for (const double factor : {1., 2., 5.})
        if (factor * step >= value)
            return factor * step;
    return 10 * step;
}

static void pointTooltip(const ErrorHistory::Point& p) {
    wrappedTooltip(fmt::format("{} after the edit: nRMSE {:.3f} \u00b1 {:.3f}",
                               durationText(p.seconds), p.nrmse, p.noise)
                       .c_str());
}

static void drawCurve(const Plot& plot, const std::vector<ErrorHistory::Point>& points) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float width = 2 * uiScale();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ErrorHistory::Point& p = points[i];
        const ImVec2 point = plot.at(p.seconds, p.nrmse);
        list.AddLine(plot.at(p.seconds, p.nrmse - std::min(p.noise, p.nrmse)),
                     plot.at(p.seconds, p.nrmse + p.noise), color::dim(), width / 2);
        if (i > 0)
            list.AddLine(plot.at(points[i - 1].seconds, points[i - 1].nrmse), point,
                         color::accent(), width);
        list.AddCircleFilled(point, 1.5f * width, color::accent());
    }
}

static void drawAxes(const Plot& plot) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float gap = 4 * uiScale(), line = ImGui::GetTextLineHeight();
    list.AddRectFilled(plot.from, plot.to, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f));
    const auto text = [&](ImVec2 position, float alignment, const std::string& words) {
        position.x -= alignment * ImGui::CalcTextSize(words.c_str()).x;
        list.AddText(position, color::dim(), words.c_str());
    };
    text({plot.from.x - gap, plot.from.y}, 1, fmt::format("{:g}", plot.maxError));
    text({plot.from.x - gap, plot.to.y - line}, 1, "0");
    text({plot.from.x, plot.to.y + gap}, 0, "0 s");
    text({plot.to.x, plot.to.y + gap}, 1, durationText(plot.seconds));
}

static void drawPlot(const std::vector<ErrorHistory::Point>& points) {
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 origin = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    const float left = ImGui::CalcTextSize("0.0005").x + 8 * uiScale();
    const ImVec2 size(std::max(room.x - left, 1.f), std::max(room.y - line, 2 * line));
    double maxError = 0;
    for (const ErrorHistory::Point& p : points)
        maxError = std::max(maxError, p.nrmse + p.noise);
    const ImVec2 from(origin.x + left, origin.y);
    const Plot plot{from,
                    {from.x + size.x, from.y + size.y},
                    std::max(points.back().seconds, 1.0),
                    roundUp(maxError)};
    drawAxes(plot);
    drawCurve(plot, points);
    ImGui::SetCursorScreenPos(from);
    ImGui::InvisibleButton("plot", size);
    if (ImGui::IsItemHovered()) {
        const float mouse = ImGui::GetMousePos().x;
        pointTooltip(*std::ranges::min_element(points, {}, [&](const ErrorHistory::Point& p) {
            return std::abs(plot.at(p.seconds, 0).x - mouse);
        }));
    }
    ImGui::SetCursorScreenPos({origin.x, plot.to.y});
    ImGui::Dummy({1, line});
}

void errorPanel(EditorState& state) {
    const std::vector<ErrorHistory::Point>& points = state.errors.points;
    if (points.empty()) {
        ImGui::PushTextWrapPos(0);
        if (!needsReference(state.compare.mode))
            ImGui::TextDisabled("The error is measured while the picture is compared with the "
                                "path-traced reference.");
        else if (!state.compare.reference.running)
            ImGui::TextDisabled("There is no reference of this view.");
        else
            ImGui::TextDisabled("The first samples of the reference are being traced.");
        ImGui::PopTextWrapPos();
        const Action& compare = actionById("compare.reference");
        if (!needsReference(state.compare.mode) && ImGui::Button("Compare"))
            runAction(state, compare);
        return;
    }
    ImGui::Text("nRMSE %.3f \u00b1 %.3f, %s after the last edit", points.back().nrmse,
                points.back().noise, durationText(points.back().seconds).c_str());
    wrappedTooltip("Root mean square of the difference to the path-traced reference, relative to "
                   "the reference's mean; the thin lines are the noise of the reference");
    drawPlot(points);
}

} // namespace limn
