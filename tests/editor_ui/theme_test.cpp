// SPDX-License-Identifier: MIT
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <filesystem>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace limn {

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

} // namespace limn
