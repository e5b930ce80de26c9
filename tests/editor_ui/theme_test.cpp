// SPDX-License-Identifier: MIT
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace limn::theme_test {

/// Whether the font that addFont() adds has a capital sigma. `used` becomes its file.
static bool hasGreek(const std::string& fonts, std::string& used) {
    ImGui::CreateContext();
    used = addFont(15, fonts);
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Build();
    const bool greek = atlas.Fonts[0]->FindGlyphNoFallback(0x3A3) != nullptr;
    ImGui::DestroyContext();
    return greek;
}

TEST(Theme, AFontThatComesWithTheProgramGoesBeforeThatOfTheSystem) {
    namespace fs = std::filesystem;
    std::string system, own;
    ASSERT_TRUE(hasGreek("", system)) << "packages.txt names a font";
    const fs::path folder =
        fs::temp_directory_path() / ("limn_theme_test_" + std::to_string(getpid()));
    fs::create_directory(folder);
    fs::copy_file(system, folder / "DejaVuSans.ttf");
    EXPECT_TRUE(hasGreek(folder.string(), own));
    EXPECT_EQ(own, (folder / "DejaVuSans.ttf").string());
    fs::remove_all(folder);
}

/// Contrast of two opaque sRGB colours, as WCAG 2.1 defines it; 1 to 21.
static float contrast(ImVec4 a, ImVec4 b) {
    const auto luminance = [](ImVec4 c) {
        const auto linear = [](float v) {
            return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
        };
        return 0.2126f * linear(c.x) + 0.7152f * linear(c.y) + 0.0722f * linear(c.z);
    };
    const float brighter = std::max(luminance(a), luminance(b)),
                darker = std::min(luminance(a), luminance(b));
    return (brighter + 0.05f) / (darker + 0.05f);
}

TEST(Theme, TextOfEveryColourIsReadableOnPanelsOfBothThemes) {
    ImGui::CreateContext();
    applyTheme();
    for (const bool light : {false, true}) {
        setThemeColors(light);
        const ImVec4* c = ImGui::GetStyle().Colors;
        const auto of = [](ImU32 color) { return ImGui::ColorConvertU32ToFloat4(color); };
        for (const ImGuiCol ground : {ImGuiCol_WindowBg, ImGuiCol_PopupBg}) {
            for (const ImVec4 ink :
                 {c[ImGuiCol_Text], c[ImGuiCol_TextDisabled], of(color::warning()),
                  of(color::error()), of(color::good()), of(color::dim()), of(color::accent())})
                EXPECT_GE(contrast(ink, c[ground]), 4.5f) << light << ground;
        }
        for (const ImGuiCol ground : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_MenuBarBg,
                                      ImGuiCol_TitleBg, ImGuiCol_TabActive, ImGuiCol_ButtonHovered})
            EXPECT_GE(contrast(c[ImGuiCol_Text], c[ground]), 4.5f) << light << ground;
    }
    ImGui::DestroyContext();
}

} // namespace limn::theme_test
