// SPDX-License-Identifier: MIT
#include "editor_ui/panels/time_history.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <imgui.h>

namespace limn {

namespace {

float sumOf(const std::array<float, kRelightSteps.size()>& steps) {
    return std::accumulate(steps.begin(), steps.end(), 0.f);
}

void barTooltip(const std::array<float, kRelightSteps.size()>& steps, std::size_t age) {
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(age == 0 ? "The last update"
                                    : fmt::format("{} updates ago", age).c_str());
    for (std::size_t i = 0; i < steps.size(); ++i)
        ImGui::TextUnformatted(
            fmt::format("{}: {:.2f} ms", kRelightSteps[i].label, steps[i]).c_str());
    ImGui::EndTooltip();
}

} // namespace

void TimeHistory::add(const RelightStats& stats) {
    if (stats.skipped)
        return;
    for (std::size_t i = 0; i < kRelightSteps.size(); ++i)
        ms[std::size_t(count % kLength)][i] = float(kRelightSteps[i].ms(stats));
    ++count;
}

float TimeHistory::longest() const {
    float most = 0;
    for (std::size_t age = 0; age < size(); ++age)
        most = std::max(most, sumOf(at(age)));
    return most;
}

void timeHistory(const TimeHistory& history) {
    const float most = history.longest(), height = ImGui::GetTextLineHeightWithSpacing() * 6;
    ImGui::TextUnformatted(
        history.size() == 0 ? "Updates" : fmt::format("Updates, up to {:.1f} ms", most).c_str());
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::InvisibleButton("history", {std::max(width, 1.f), height});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(from, {from.x + width, from.y + height}, IM_COL32(255, 255, 255, 12));
    const float bar = width / float(TimeHistory::kLength);
    for (std::size_t age = 0; age < history.size(); ++age) {
        const float right = from.x + width - bar * float(age);
        float y = from.y + height;
        for (std::size_t i = 0; i < kRelightSteps.size() && most > 0; ++i) {
            const float top = y - height * history.at(age)[i] / most;
            draw.AddRectFilled({right - bar, top}, {right, y}, kRelightSteps[i].color);
            y = top;
        }
        if (ImGui::IsItemHovered() && ImGui::GetMousePos().x < right &&
            ImGui::GetMousePos().x >= right - bar)
            barTooltip(history.at(age), age);
    }
}

} // namespace limn
