// SPDX-License-Identifier: MIT
#include "editor_ui/panels/theme.h"

#include <filesystem>

namespace limn {

static bool isLight() {
    return ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x > 0.5f;
}

// On the light theme's panels each has a contrast of at least 4.5 to 1, as text needs.
namespace color {
ImU32 accent() {
    return isLight() ? IM_COL32(28, 96, 176, 255) : kAccent;
}
ImU32 warning() {
    return isLight() ? IM_COL32(140, 78, 0, 255) : IM_COL32(240, 170, 70, 255);
}
ImU32 error() {
    return isLight() ? IM_COL32(176, 32, 20, 255) : IM_COL32(255, 128, 112, 255);
}
ImU32 good() {
    return isLight() ? IM_COL32(0, 92, 145, 255) : IM_COL32(110, 190, 230, 255);
}
ImU32 dim() {
    return isLight() ? IM_COL32(92, 95, 102, 255) : kDim;
}
} // namespace color

static ImVec4 grey(float v, float alpha = 1) {
    return {v, v, v * 1.04f, alpha};
}

/// A colour of one hue: the accent, which marks what is selected, pressed or held.
static ImVec4 blue(bool light, float alpha = 1) {
    return light ? ImVec4(0.5f, 0.7f, 0.95f, alpha) : ImVec4(0.25f, 0.47f, 0.76f, alpha);
}

void setThemeColors(bool light) {
    ImVec4* c = ImGui::GetStyle().Colors;
    const ImVec4 grab = light ? ImVec4(0.16f, 0.42f, 0.75f, 1) : ImVec4(0.31f, 0.55f, 0.86f, 1);
    const auto tone = [&](ImGuiCol which, float dark, float bright, float alpha = 1) {
        c[which] = grey(light ? bright : dark, alpha);
    };
    tone(ImGuiCol_Text, 0.88f, 0.08f);
    tone(ImGuiCol_TextDisabled, 0.57f, 0.38f);
    tone(ImGuiCol_WindowBg, 0.125f, 0.92f);
    tone(ImGuiCol_ChildBg, 0, 0, 0);
    tone(ImGuiCol_PopupBg, 0.15f, 0.95f);
    tone(ImGuiCol_Border, 0.24f, 0.73f);
    tone(ImGuiCol_FrameBg, 0.19f, 0.84f);
    tone(ImGuiCol_FrameBgHovered, 0.24f, 0.79f);
    tone(ImGuiCol_FrameBgActive, 0.28f, 0.75f);
    tone(ImGuiCol_TitleBg, 0.17f, 0.84f);
    c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBg];
    tone(ImGuiCol_MenuBarBg, 0.15f, 0.88f);
    tone(ImGuiCol_ScrollbarBg, 0.1f, 0.85f, 0.5f);
    tone(ImGuiCol_ScrollbarGrab, 0.3f, 0.66f);
    c[ImGuiCol_CheckMark] = grab;
    tone(ImGuiCol_SliderGrab, 0.45f, 0.55f);
    c[ImGuiCol_SliderGrabActive] = grab;
    tone(ImGuiCol_Button, 0.24f, 0.8f);
    tone(ImGuiCol_ButtonHovered, 0.31f, 0.73f);
    c[ImGuiCol_ButtonActive] = blue(light);
    c[ImGuiCol_Header] = blue(light, 0.55f);
    c[ImGuiCol_HeaderHovered] = blue(light, 0.35f);
    c[ImGuiCol_HeaderActive] = blue(light);
    c[ImGuiCol_Separator] = c[ImGuiCol_Border];
    c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = grab;
    tone(ImGuiCol_Tab, 0.16f, 0.84f);
    c[ImGuiCol_TabUnfocused] = c[ImGuiCol_Tab];
    tone(ImGuiCol_TabHovered, 0.3f, 0.75f);
    tone(ImGuiCol_TabActive, 0.26f, 0.97f);
    c[ImGuiCol_TabUnfocusedActive] = c[ImGuiCol_TabActive];
    c[ImGuiCol_PlotHistogram] = blue(light);
    tone(ImGuiCol_TableHeaderBg, 0.17f, 0.84f);
    tone(ImGuiCol_TableRowBgAlt, 1, 0, 0.025f);
    c[ImGuiCol_TextSelectedBg] = blue(light, 0.6f);
    c[ImGuiCol_NavHighlight] = grab;
    c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.5f);
}

void applyTheme() {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowPadding = {10, 8};
    style.FramePadding = {7, 4};
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 16;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 10;
    style.WindowBorderSize = style.PopupBorderSize = 1;
    style.WindowRounding = 0;
    style.PopupRounding = style.FrameRounding = style.GrabRounding = style.TabRounding = 3;
    setThemeColors(false);
}

std::string addFont(float pixels, const std::string& fonts) {
    const std::string files[] = {
        fonts + "/DejaVuSans.ttf",
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",          // fonts-dejavu-core
        "/usr/share/fonts/truetype/open-sans/OpenSans-Regular.ttf", // fonts-open-sans
    };
    // Latin, Greek (n_S, sigma), punctuation (ellipsis, dashes, bullets), super- and subscripts,
    // arrows.
    static const ImWchar kRanges[] = {0x20,   0x17F,  0x370,  0x3FF,  0x2010, 0x2044,
                                      0x2070, 0x209C, 0x2190, 0x21FF, 0};
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    for (const std::string& file : files)
        if (std::error_code error; std::filesystem::exists(file, error))
            if (atlas.AddFontFromFileTTF(file.c_str(), pixels, nullptr, kRanges))
                return file;
    atlas.AddFontDefault();
    return "";
}

} // namespace limn
