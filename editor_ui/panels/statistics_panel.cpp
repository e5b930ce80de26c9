// SPDX-License-Identifier: MIT
#include "editor_ui/panels/statistics_panel.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include <fmt/format.h>

namespace limn {

/// `square`: colour of a square before the label, as the plot has it; 0: none.
static void row(const char* label, const std::string& value, const char* tooltip,
                std::uint32_t square = 0) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (square != 0) {
        const float side = ImGui::GetFontSize() * 0.6f;
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float y = corner.y + ImGui::GetFontSize() * 0.25f;
        ImGui::GetWindowDrawList()->AddRectFilled({corner.x, y}, {corner.x + side, y + side},
                                                  square);
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetFontSize() * 0.85f);
    }
    ImGui::PushStyleColor(ImGuiCol_Text, color::dim());
    elidedText(label, ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
    wrappedTooltip(tooltip);
    ImGui::TableNextColumn();
    const float indent = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(value.c_str()).x;
    if (indent > 0)
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
    ImGui::TextUnformatted(value.c_str());
}

static bool beginTable(const char* id, const char* heading) {
    ImGui::TextUnformatted(heading);
    if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_RowBg))
        return false;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.53f);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.47f);
    return true;
}

static std::string ms(double milliseconds) {
    return fmt::format("{:.2f} ms", milliseconds);
}

static void timeTable(EditorState& state) {
    const FrameStatus& f = state.frame;
    if (!beginTable("time", "Time per step"))
        return;
    const std::vector<LightingStep>& steps = state.relight.last.steps;
    for (std::size_t i = 0; i < steps.size(); ++i)
        row(steps[i].label, ms(steps[i].ms), steps[i].tooltip,
            kStepColors[std::min(i, kStepColors.size() - 1)]);
    row("Upload", ms(f.uploadMs), "Bounced light to the graphics device");
    row("Shadow maps", ms(f.shadowMs), "0 maps are drawn while no light or object moves");
    row("Surfaces", ms(f.surfacesMs),
        "Triangles that the camera sees; kept while camera, objects and materials are unchanged");
    row("Shade", ms(f.shadeMs), "The picture from caches and direct light");
    ImGui::EndTable();
}

static void historyPlot(EditorState& state) {
    timeHistory(state.relight.history);
}

static std::string measuredMs(const RelightPlace& place, RelightOn device) {
    if (!place.times)
        return "–";
    return ms(device == RelightOn::Gpu ? place.times->gpuMs : place.times->cpuMs);
}

static const char* placeTooltip(RelightOn device) {
    switch (device) {
    case RelightOn::Auto:
        return "Whichever is faster here: measured once per device and size of bake, when all "
               "other work is done, and remembered. The CPU where dynamic objects occlude bounced "
               "light";
    case RelightOn::Cpu:
        return "On this machine's processor, with traced shadows";
    case RelightOn::Gpu:
        return "On the device that draws the picture, with the picture's shadow maps; nothing is "
               "uploaded";
    }
    return "";
}

/// Shows which device relights and the time that each takes.
static void placeRow(RelightPlace& place) {
    constexpr const char* kLabels[] = {"Auto", "CPU", "GPU"};
    const bool onGpu = place.used() == RelightOn::Gpu;
    const std::string shown = place.wanted == RelightOn::Auto
                                  ? fmt::format("Auto: {}", onGpu ? "GPU" : "CPU")
                              : onGpu ? "GPU"
                                      : "CPU";
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, color::dim());
    elidedText("Relight on", ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
    wrappedTooltip("Where bounced light is computed");
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
    const bool open =
        ImGui::BeginCombo("##relight on", shown.c_str(), ImGuiComboFlags_NoArrowButton);
    ImGui::PopStyleVar();
    if (!open)
        wrappedTooltip(placeTooltip(place.wanted));
    for (const RelightOn on : {RelightOn::Auto, RelightOn::Cpu, RelightOn::Gpu}) {
        if (!open)
            break;
        std::string label = kLabels[std::size_t(on)];
        if (on != RelightOn::Auto)
            label += "  " + measuredMs(place, on);
        const bool possible = on != RelightOn::Gpu || place.gpuCan;
        if (ImGui::Selectable(label.c_str(), place.wanted == on,
                              possible ? 0 : ImGuiSelectableFlags_Disabled))
            place.wanted = on;
        wrappedTooltip(possible || place.refusal.empty() ? placeTooltip(on)
                                                         : place.refusal.c_str());
    }
    if (open)
        ImGui::EndCombo();
}

static std::string counterText(const LightingCounter& counter) {
    switch (counter.unit) {
    case CounterUnit::Count:
        return groupedNumber(static_cast<unsigned long long>(counter.value));
    case CounterUnit::Milliseconds:
        return ms(counter.value);
    case CounterUnit::Share:
        return counter.value > 0 ? fmt::format("{:.3f}", counter.value) : "\u2013";
    case CounterUnit::Bytes:
        return byteText(std::uint64_t(counter.value));
    }
    return {};
}

static void counterRows(const std::vector<LightingCounter>& counters) {
    for (const LightingCounter& counter : counters)
        row(counter.label, counterText(counter), counter.tooltip);
}

static void relightTable(EditorState& state) {
    const LightingStatus& r = state.relight;
    if (!beginTable("relight", "Bounced light"))
        return;
    row("State",
        r.last.diverges ? "stopped"
        : r.converged   ? "converged"
        : r.running     ? "bouncing"
                        : "idle",
        r.last.diverges ? "Every bounce brought more light than the one before: bake again"
                        : "Converged: more bounces would change next to nothing");
    placeRow(state.relightPlace);
    for (const RelightOn on : {RelightOn::Cpu, RelightOn::Gpu})
        row(on == RelightOn::Cpu ? "  CPU" : "  GPU", measuredMs(state.relightPlace, on),
            "One update of one bounce with every light moved: what Auto compares");
    row("Bounces", std::to_string(r.bounces), "Since the last edit");
    row("Last update", ms(r.last.totalMs), "One call: a few bounces");
    counterRows(r.last.counters);
    row("Updates", groupedNumber(r.calls), "Calls since the scene was opened");
    row("Since edit",
        state.bake.lightEdited ? durationText(state.bake.secondsSinceLightEdit) : "no edit yet",
        "Bake seconds since a light, a material or the sky was last edited: 0, editing light "
        "never bakes");
    ImGui::EndTable();
}

struct WorkLabel {
    Work work;
    const char *label, *tooltip;
};

static constexpr WorkLabel kWorkLabels[] = {
    {Work::Open, "  opening", "The longest frame while the latest file was opened"},
    {Work::Bake, "  baking", "The longest frame of the latest bake"},
    {Work::Relight, "  relighting", "The longest frame while light bounced last"},
    {Work::Reference, "  reference", "The longest frame while the reference was path-traced last"},
    {Work::Save, "  saving", "The longest frame while a file was written last"},
    {Work::Explain, "  explaining", "The longest frame while a pixel was explained last"},
    {Work::Lint, "  checking", "The longest frame while the scene was checked last"},
    {Work::Export, "  exporting", "The longest frame while light was exported last"},
};
static_assert(std::size(kWorkLabels) == kWorkNames.size());

/// A frame without what the viewport's picture took of it; the tooltip has all parts.
static void frameRow(const char* label, const FrameTime& frame, const char* what) {
    row(label, ms(frame.beyondViewport()),
        fmt::format("{}, without {:.1f} ms of the viewport: panels {:.1f} ms, jobs {:.1f} ms, "
                    "window {:.1f} ms",
                    what, frame.viewport, frame.panels, frame.jobs, frame.window)
            .c_str());
}

static void frameTable(EditorState& state) {
    const FrameStatus& f = state.frame;
    if (!beginTable("frames", "Frames of the window"))
        return;
    frameRow("Last", f.frames.last, "The last frame of the window");
    frameRow("Longest", f.frames.sinceStart, "The longest frame since the start");
    frameRow("  since idle", f.frames.sinceIdle, "The longest frame since all work was done");
    for (const WorkLabel& work : kWorkLabels)
        if (const FrameTime& frame = f.frames.of(work.work); frame.total() > 0)
            frameRow(work.label, frame, work.tooltip);
    row("Frames", groupedNumber(f.uiFrames), "Counts up only while something happens");
    ImGui::EndTable();
}

static void pictureTable(EditorState& state) {
    const FrameStatus& f = state.frame;
    if (!beginTable("picture", "Picture"))
        return;
    row("Pictures", groupedNumber(f.pictures),
        "Drawn by the viewport; counts up only while something changes");
    row("  redrawn", groupedNumber(f.surfacesDrawn),
        "Pictures for which triangles were drawn; light that changes needs none");
    row("Size", fmt::format("{} \u00d7 {}", f.width, f.height),
        "Pixels of the picture; fewer while things move on a slow device");
    ImGui::EndTable();
}

static void countTable(EditorState& state) {
    if (!beginTable("counts", "Counts"))
        return;
    counterRows(state.bake.last.counts);
    ImGui::EndTable();
}

static void byteTable(EditorState& state) {
    const std::vector<LightingCounter>& bytes = state.bake.last.bytes;
    if (!beginTable("bytes", "Memory"))
        return;
    counterRows(bytes);
    row("Bake, total", byteText(std::uint64_t(totalOf(bytes))), "");
    row("Graphics", byteText(state.frame.gpuBytes), "Buffers and images of the viewport");
    ImGui::EndTable();
}

static void bakeTable(EditorState& state) {
    if (!beginTable("bake", "Last bake"))
        return;
    const StageSeconds& all = state.bake.last.seconds;
    for (const auto& [stage, seconds] : all)
        row(stage.c_str(), durationText(seconds), "");
    row("total", durationText(totalOf(all)), "");
    ImGui::EndTable();
}

using Table = void (*)(EditorState&);

/// Tables side by side, which scroll where the panel is narrower than they need.
static void tablesInRow(EditorState& state, std::initializer_list<Table> tables, float ems) {
    const auto count = int(tables.size());
    const float minimum = ImGui::GetFontSize() * ems * float(count);
    const float inner = ImGui::GetContentRegionAvail().x >= minimum ? 0 : minimum;
    if (!ImGui::BeginTable("columns", count,
                           ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_ScrollX |
                               ImGuiTableFlags_ScrollY,
                           {0, 0}, inner))
        return;
    ImGui::TableNextRow();
    for (const Table table : tables) {
        ImGui::TableNextColumn();
        table(state);
    }
    ImGui::EndTable();
}

void profilePanel(EditorState& state) {
    tablesInRow(state, {timeTable, historyPlot, relightTable, frameTable, pictureTable}, 12.5f);
}

void memoryPanel(EditorState& state) {
    tablesInRow(state, {byteTable, countTable, bakeTable}, 12.5f);
}

void logPanel(const EditorState& state) {
    if (state.log.empty()) {
        ImGui::TextDisabled("Nothing was repaired and nothing went wrong");
        return;
    }
    if (ImGui::BeginChild("lines")) {
        ImGui::PushTextWrapPos(0);
        for (const LogLine& line : state.log) {
            switch (line.level) {
            case LogLine::Level::Info:
                ImGui::TextUnformatted(line.text.c_str());
                break;
            case LogLine::Level::Warning:
                ImGui::TextColored(ImColor(color::warning()), "Warning: %s", line.text.c_str());
                break;
            case LogLine::Level::Error:
                ImGui::TextColored(ImColor(color::error()), "Error: %s", line.text.c_str());
                break;
            }
        }
        ImGui::PopTextWrapPos();
    }
    ImGui::EndChild();
}

} // namespace limn
