// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_extensions.h"

#include "engine/core/read_file.h"
#include "tests/core/source_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace limn::gltf_extensions_test {
namespace {

TEST(GltfExtensions, AreThoseOfTheManual) {
    const Result<std::string> manual = readFile(sourcePath("docs/gltf.md"));
    ASSERT_TRUE(manual) << manual.error().message;
    for (const bool isRead : {true, false}) {
        std::string table = isRead ? "| read | what is left out of it |\n|---|---|\n"
                                   : "| not read | what a picture then lacks |\n|---|---|\n";
        for (const GltfExtension& e : gltfExtensions())
            if (e.isRead == isRead)
                table += fmt::format("| `{}` | {} |\n", e.name,
                                     e.leftOut.empty() ? "nothing" : e.leftOut);
        EXPECT_NE(manual->find(table + "\n"), std::string::npos) << "it should have\n" << table;
    }
}

TEST(GltfExtensions, AreOrderedByWhetherTheyAreReadAndByName) {
    const auto before = [](const GltfExtension& a, const GltfExtension& b) {
        return a.isRead != b.isRead ? a.isRead : a.name < b.name;
    };
    EXPECT_TRUE(std::ranges::is_sorted(gltfExtensions(), before));
}

} // namespace
} // namespace limn::gltf_extensions_test
