// SPDX-License-Identifier: MIT
#include "editor_ui/panels/time_history.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <imgui.h>

namespace limn {

namespace {

float sumOf(const TimeHistory::Steps& steps) {
    return std::accumulate(steps.begin(), steps.end(), 0.f);
}

void barTooltip(const TimeHistory& history, std::size_t age) {
    const TimeHistory::Steps& steps = history.at(age);
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(age == 0 ? "The last update"
                                    : fmt::format("{} updates ago", age).c_str());
    for (std::size_t i = 0; i < steps.size() && history.labels[i]; ++i)
        ImGui::TextUnformatted(fmt::format("{}: {:.2f} ms", history.labels[i], steps[i]).c_str());
    ImGui::EndTooltip();
}

} // namespace

void TimeHistory::add(const LightingReport& report) {
    if (report.skipped)
        return;
    Steps steps{};
    decltype(labels) named{};
    for (std::size_t i = 0; i < report.steps.size(); ++i) {
        const std::size_t index = std::min(i, steps.size() - 1);
        steps[index] += float(report.steps[i].ms);
        named[index] = report.steps[i].label;
    }
    if (named != labels)
        count = 0; // another technique
    labels = named;
    ms[std::size_t(count % kLength)] = steps;
    ++count;
}

float TimeHistory::longest() const {
    float maximum = 0;
    for (std::size_t age = 0; age < size(); ++age)
        maximum = std::max(maximum, sumOf(at(age)));
    return maximum;
}

void timeHistory(const TimeHistory& history) {
    const float maxMs = history.longest(), height = ImGui::GetTextLineHeightWithSpacing() * 6;
    ImGui::TextUnformatted(
        history.size() == 0 ? "Updates" : fmt::format("Updates, up to {:.1f} ms", maxMs).c_str());
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::InvisibleButton("history", {std::max(width, 1.f), height});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(from, {from.x + width, from.y + height}, IM_COL32(255, 255, 255, 12));
    const float bar = width / float(TimeHistory::kLength);
    for (std::size_t age = 0; age < history.size(); ++age) {
        const float right = from.x + width - bar * float(age);
        float y = from.y + height;
        for (std::size_t i = 0; i < kStepColors.size() && maxMs > 0; ++i) {
            const float top = y - height * history.at(age)[i] / maxMs;
            draw.AddRectFilled({right - bar, top}, {right, y}, kStepColors[i]);
            y = top;
        }
        if (ImGui::IsItemHovered() && ImGui::GetMousePos().x < right &&
            ImGui::GetMousePos().x >= right - bar)
            barTooltip(history, age);
    }
}

} // namespace limn
