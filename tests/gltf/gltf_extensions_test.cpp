// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_extensions.h"

#include "engine/core/read_file.h"
#include "tests/core/source_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
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

/// The sentences that a source hands to repairs.add(), without their counts.
std::set<std::string> repairsIn(const std::string& source) {
    std::set<std::string> found;
    for (std::size_t call = source.find("repairs.add("); call != std::string::npos;
         call = source.find("repairs.add(", call + 1)) {
        std::string sentence; // of literals that follow each other
        std::size_t next = source.find_first_not_of(" \n", source.find('(', call) + 1);
        while (next != std::string::npos && source[next] == '"') {
            const std::size_t end = source.find('"', next + 1);
            sentence += source.substr(next + 1, end - next - 1);
            next = source.find_first_not_of(" \n", end + 1);
        }
        if (!sentence.empty())
            found.insert(sentence);
    }
    return found;
}

TEST(GltfRepairs, AreThoseOfTheManual) {
    std::set<std::string> repairs;
    for (const auto& entry : std::filesystem::directory_iterator(sourcePath("engine/gltf")))
        if (entry.path().extension() == ".cpp")
            repairs.merge(repairsIn(readFile(entry.path().string()).value()));
    EXPECT_GT(repairs.size(), 30U);
    std::string list;
    for (const std::string& repair : repairs)
        list += fmt::format("- {}\n", repair);
    EXPECT_NE(readFile(sourcePath("docs/gltf.md"))->find("\n\n" + list + "\n"), std::string::npos)
        << "it should have\n"
        << list;
}

TEST(GltfExtensions, AreOrderedByWhetherTheyAreReadAndByName) {
    const auto before = [](const GltfExtension& a, const GltfExtension& b) {
        return a.isRead != b.isRead ? a.isRead : a.name < b.name;
    };
    EXPECT_TRUE(std::ranges::is_sorted(gltfExtensions(), before));
}

} // namespace
} // namespace limn::gltf_extensions_test
