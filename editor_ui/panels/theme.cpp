// SPDX-License-Identifier: MIT
#include "editor_ui/panels/theme.h"

#include <filesystem>

namespace limn {

static ImVec4 grey(float v, float alpha = 1) {
    return {v, v, v * 1.04f, alpha};
}

static void setColors(ImVec4* c) {
    const ImVec4 accent(0.25f, 0.47f, 0.76f, 1), accentHover(0.31f, 0.55f, 0.86f, 1);
    c[ImGuiCol_Text] = grey(0.88f);
    c[ImGuiCol_TextDisabled] = grey(0.57f);
    c[ImGuiCol_WindowBg] = grey(0.125f);
    c[ImGuiCol_ChildBg] = grey(0, 0);
    c[ImGuiCol_PopupBg] = grey(0.15f);
    c[ImGuiCol_Border] = grey(0.24f);
    c[ImGuiCol_FrameBg] = grey(0.19f);
    c[ImGuiCol_FrameBgHovered] = grey(0.24f);
    c[ImGuiCol_FrameBgActive] = grey(0.28f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = grey(0.17f);
    c[ImGuiCol_MenuBarBg] = grey(0.15f);
    c[ImGuiCol_ScrollbarBg] = grey(0.1f, 0.5f);
    c[ImGuiCol_ScrollbarGrab] = grey(0.3f);
    c[ImGuiCol_CheckMark] = accentHover;
    c[ImGuiCol_SliderGrab] = grey(0.45f);
    c[ImGuiCol_SliderGrabActive] = accentHover;
    c[ImGuiCol_Button] = grey(0.24f);
    c[ImGuiCol_ButtonHovered] = grey(0.31f);
    c[ImGuiCol_ButtonActive] = accent;
    c[ImGuiCol_Header] = ImVec4(0.25f, 0.47f, 0.76f, 0.55f);
    c[ImGuiCol_HeaderHovered] = ImVec4(0.25f, 0.47f, 0.76f, 0.35f);
    c[ImGuiCol_HeaderActive] = accent;
    c[ImGuiCol_Separator] = grey(0.24f);
    c[ImGuiCol_SeparatorHovered] = accentHover;
    c[ImGuiCol_SeparatorActive] = accentHover;
    c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = grey(0.16f);
    c[ImGuiCol_TabHovered] = grey(0.3f);
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = grey(0.26f);
    c[ImGuiCol_PlotHistogram] = accent;
    c[ImGuiCol_TableHeaderBg] = grey(0.17f);
    c[ImGuiCol_TableRowBgAlt] = grey(1, 0.025f);
    c[ImGuiCol_TextSelectedBg] = ImVec4(0.25f, 0.47f, 0.76f, 0.6f);
    c[ImGuiCol_NavHighlight] = accentHover;
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
    setColors(style.Colors);
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
