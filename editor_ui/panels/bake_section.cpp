// SPDX-License-Identifier: MIT
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/inspector_panel.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

static void countRow(FieldEdit& edit, const char* label, const char* tooltip, std::uint32_t& value,
                     std::uint32_t lo, std::uint32_t hi, const char* edited) {
    fieldLabel(label, tooltip);
    ImGui::PushID(label);
    ImGui::SliderScalar("##count", ImGuiDataType_U32, &value, &lo, &hi, "%u",
                        ImGuiSliderFlags_AlwaysClamp |
                            (hi > 16 ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None));
    ImGui::PopID();
    fieldEdited(edit, edited);
}

static void lightmapRows(FieldEdit& edit, BakeSettings& s) {
    int byDensity = s.texelsPerMetre > 0;
    fieldLabel("Lightmap size by",
               "Total: about this many texels over the scene. Density: the same everywhere");
    if (ImGui::Combo("##by", &byDensity, "Total texels\0Density\0")) {
        s.texelsPerMetre = byDensity ? 4.f : 0.f;
        s.lightmapCaches = byDensity ? 0 : BakeSettings{}.lightmapCaches;
    }
    fieldEdited(edit, "Lightmap size");
    if (s.texelsPerMetre > 0) {
        fieldLabel("Density (texels/m)", "Lightmap texels per metre of surface [1/m]");
        ImGui::SliderFloat("##density", &s.texelsPerMetre, 0.1f, 100, "%.2f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        fieldEdited(edit, "Texel density");
    } else {
        countRow(edit, "Lightmap texels", "About how many texels gather light", s.lightmapCaches,
                 256, 4u << 20, "Lightmap texels");
    }
}

static void gridRow(FieldEdit& edit, BakeSettings& s) {
    int cells[3] = {int(s.grid.x), int(s.grid.y), int(s.grid.z)};
    fieldLabel(
        "Grid (cells)",
        "Cells along X, Y, Z that light what has no lightmap; 0 0 0: chosen from the scene's size");
    if (ImGui::DragInt3("##grid", cells, 0.1f, 0, 128, "%d", ImGuiSliderFlags_AlwaysClamp))
        s.grid = {unsigned(cells[0]), unsigned(cells[1]), unsigned(cells[2])};
    fieldEdited(edit, "Grid");
}

static void placementRow(FieldEdit& edit, BakeSettings& s) {
    int where = int(s.placement);
    fieldLabel("Placement", "Where surfels lie. Relaxed: Halton points, then spread evenly. Halton "
                            "and random are there to compare");
    if (ImGui::Combo("##placement", &where, "Relaxed\0Halton\0Random\0"))
        s.placement = SurfelPlacement(where);
    fieldEdited(edit, "Placement");
}

static void linkerRow(FieldEdit& edit, BakeSettings& s) {
    int which = int(s.linker);
    fieldLabel("Linker",
               "How a cache finds what it sees. Gather: rays that leave it. Form factor: a "
               "ray towards every surfel, many times slower; there to compare");
    if (ImGui::Combo("##linker", &which, "Gather\0Form factor\0"))
        s.linker = Linker(which);
    fieldEdited(edit, "Linker");
}

static void cutRow(FieldEdit& edit, BakeSettings& s) {
    int which = int(s.cut);
    fieldLabel("Cut", "Which clusters a cache links. Detail: those whose differences inside would "
                      "change its light most; hard caches get more links, easy ones fewer. Solid "
                      "angle: those that look largest, the same number for every cache");
    if (ImGui::Combo("##cut", &which, "Detail\0Solid angle\0"))
        s.cut = CutCriterion(which);
    fieldEdited(edit, "Cut");
}

static void storageRow(FieldEdit& edit, BakeSettings& s) {
    int how = int(s.storage);
    fieldLabel("Link storage",
               "How links are kept. Cones (RTP): 12 bytes each, turned into SH whenever light "
               "changes. SH: turned once by the bake, 4 + 2 l\u00b2 bytes each. Both give the same "
               "light");
    if (ImGui::Combo("##storage", &how, "Cones (RTP)\0SH\0"))
        s.storage = LinkStorage(how);
    fieldEdited(edit, "Link storage");
}

static void clusterRows(FieldEdit& edit, BakeSettings& s) {
    int how = int(s.clustering);
    fieldLabel("Clustering",
               "How surfels are joined into clusters. Agglomerative: the closest two, again and "
               "again; slower. Kd-tree: halved at medians");
    if (ImGui::Combo("##clustering", &how, "Agglomerative\0Kd-tree\0"))
        s.clustering = Clustering(how);
    fieldEdited(edit, "Clustering");
    const auto weightRow = [&](const char* label, const char* tooltip, float& weight) {
        fieldLabel(label, tooltip);
        ImGui::PushID(label);
        ImGui::SliderFloat("##weight", &weight, 0, 100, "%.3f",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        ImGui::PopID();
        fieldEdited(edit, label);
    };
    weightRow("Normal weight (C_n)",
              "How much clusters keep to surfels that face the same way. More: flatter clusters",
              s.clusterNormalWeight);
    if (s.clustering == Clustering::Agglomerative)
        weightRow("Balance weight (C_b)",
                  "How much clusters of like area are joined first. More: a tree of less depth",
                  s.clusterBalanceWeight);
}

static void memoryLine(const EditorState& state) {
    const BakePrediction& p = state.prediction;
    const BakeBytes& b = p.bytes;
    ImGui::Spacing();
    ImGui::TextDisabled("About %s, %s while baking", byteText(b.total()).c_str(),
                        byteText(p.working).c_str());
    wrappedTooltip(
        ("What a bake with these settings takes in memory, and the most that baking takes "
         "besides the scene; about " +
         byteText(p.file) + " as a file. Links " + byteText(b.links) + ", surfels " +
         byteText(b.surfels) + ", clusters " + byteText(b.clusters) + ", caches " +
         byteText(b.caches) + ", of which there will be about " + groupedNumber(p.caches))
            .c_str());
    if (p.leastTexels > 0) {
        ImGui::PushTextWrapPos(0);
        ImGui::TextDisabled("The objects need at least about %s texels: one for each way that an "
                            "object faces.",
                            groupedNumber(p.leastTexels).c_str());
        ImGui::PopTextWrapPos();
    }
}

static void bakeStateLine(EditorState& state) {
    const BakeStatus& bake = state.bake;
    ImGui::Spacing();
    ImGui::PushTextWrapPos(0);
    const bool refining = bake.preview && bake.running;
    if (refining)
        ImGui::TextDisabled("A first look of few rays; the full bake is being made.");
    else
        switch (bake.freshness) {
        case BakeFreshness::None:
            ImGui::TextColored(ImColor(color::kWarning),
                               "Bake needed: nothing is baked yet, so there is no bounced light.");
            break;
        case BakeFreshness::Checking:
            ImGui::TextDisabled("Comparing with the last bake...");
            break;
        case BakeFreshness::UpToDate:
            ImGui::TextColored(ImColor(color::kGood), "The bake is up to date.");
            break;
        case BakeFreshness::Needed:
            ImGui::TextColored(ImColor(color::kWarning),
                               "Bake needed: objects or settings changed since the last one.");
            break;
        }
    for (const std::string& note : bake.notes)
        ImGui::TextDisabled("%s", note.c_str());
    if (!bake.error.empty())
        ImGui::TextColored(ImColor(color::kError), "Last bake: %s", bake.error.c_str());
    ImGui::PopTextWrapPos();
    const Action& action = actionById(bake.running ? "bake.cancel" : "bake.start");
    ImGui::BeginDisabled(!action.enabled(state));
    if (ImGui::Button(action.label, {-FLT_MIN, 0}))
        runAction(state, action);
    ImGui::EndDisabled();
}

static void presetRow(FieldEdit& edit, BakeSettings& s) {
    constexpr const char* kLabels[] = {"Draft", "Medium", "High"};
    static_assert(std::size(kLabels) == kBakePresets.size());
    const auto* preset =
        std::ranges::find_if(kBakePresets, [&](const BakePreset& p) { return p.describes(s); });
    const auto current = std::size_t(preset - kBakePresets.begin());
    fieldLabel("Quality", "Surfels, links, rays and lightmap texels that go together. Each step "
                          "takes three to five times as long to bake as the one before; Medium is "
                          "the default. Custom: counts of your own");
    if (ImGui::BeginCombo("##preset", preset == kBakePresets.end() ? "Custom" : kLabels[current])) {
        for (std::size_t i = 0; i < kBakePresets.size(); ++i)
            if (ImGui::Selectable(kLabels[i], i == current))
                kBakePresets[i].applyTo(s);
        ImGui::EndCombo();
    }
    fieldEdited(edit, "Quality");
}

void bakeSection(FieldEdit& edit, BakeSettings& s) {
    presetRow(edit, s);
    countRow(edit, "Surfels (n_S)",
             "Sample points of the surfaces that stand for all bounced light, over the whole "
             "scene. More: finer light, longer bake, more memory",
             s.surfels, 64, 1u << 20, "Surfels");
    placementRow(edit, s);
    countRow(edit, "Links (n_L)",
             "Clusters of surfels that each cache listens to. More: more accurate, "
             "slower to relight",
             s.links, 1, 4096, "Links");
    countRow(edit, "SH bands",
             "Bands of spherical harmonics per cache, l\u00b2 numbers each. 3 for diffuse light",
             s.bands, 2, 8, "SH bands");
    countRow(edit, "Chroma bands",
             "Bands that keep their colour; what lies above is grey. Fewer: quicker to relight. "
             "0: all of them",
             s.chromaBands, 0, s.bands, "Chroma bands");
    countRow(edit, "Rays per cache",
             "Rays traced from each cache while baking. More: less noise, longer bake", s.rays, 16,
             65536, "Rays");
    ImGui::Separator();
    linkerRow(edit, s);
    cutRow(edit, s);
    storageRow(edit, s);
    clusterRows(edit, s);
    ImGui::Separator();
    lightmapRows(edit, s);
    gridRow(edit, s);
    ImGui::Separator();
    countRow(
        edit, "Most bounces",
        "Relighting stops as soon as nothing to speak of is missing. 1: light that is reflected "
        "once; up to 8 begin anew with every change",
        s.maxBounces, 1, 10000, "Bounces");
    fieldLabel("Dimming",
               "Dynamic objects keep bounced light off what is behind them. Needs no bake");
    ImGui::Checkbox("##dimming", &s.dimming);
    fieldEdited(edit, "Dimming");
    memoryLine(edit.state);
    bakeStateLine(edit.state);
}

} // namespace limn
