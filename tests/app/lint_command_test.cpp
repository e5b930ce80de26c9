// SPDX-License-Identifier: MIT
// limn lint: exit codes, reports, and that the importer's repairs become findings of their rules.
#include "tests/app/command_line.h"

#include <cmath>
#include <set>

namespace limn::lint_command_test {

/// A triangle whose texture has no coordinates, and one whose corner is not a number.
const std::string kFaulty =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0, "name": "Sheet"}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
  "materials": [{"name": "Paper", "doubleSided": true, "pbrMetallicRoughness": {
    "baseColorFactor": [0.5, 0.5, 0.5, 1], "baseColorTexture": {"index": 0}}}],
  "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)"
    R"(iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3",
    "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 72}],
  "buffers": [{"byteLength": 72, "uri": "faulty.bin"}]})";

class LintCommand : public CommandLine {
protected:
    std::string faulty() const {
        const float nan = std::nanf("");
        const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, nan, 1, 1};
        write(path("faulty.bin"),
              std::string(reinterpret_cast<const char*>(corners), sizeof corners));
        write(path("faulty.gltf"), kFaulty);
        return path("faulty.gltf");
    }
};

TEST_F(LintCommand, ReturnsThreeForFindingsAsSevereAsAsked) {
    const std::string scene = faulty();
    EXPECT_EQ(limn("lint --no-seconds cornell").exit, 0);
    EXPECT_EQ(limn("lint --no-seconds " + scene).exit, 3);
    EXPECT_EQ(limn("lint --no-seconds --fail-on error " + scene).exit, 0);
    EXPECT_EQ(limn("lint --no-seconds --fail-on never " + scene).exit, 2);
    EXPECT_EQ(limn("lint").exit, 2);
    EXPECT_EQ(limn("lint --rules").exit, 0);
    expectRefusal("lint nowhere.gltf", "nowhere.gltf");
}

TEST_F(LintCommand, FindsWhatTheImporterRepaired) {
    const Outcome run = limn("lint --json --no-seconds " + faulty());
    EXPECT_EQ(run.exit, 3) << run.err;
    const auto json = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << run.out;
    expectKeys(json, {"scene", "findings", "counts", "bake"});
    std::set<std::string> rules;
    for (const auto& finding : json["findings"]) {
        expectKeys(finding, {"rule", "severity", "object", "path", "problem", "advice", "place"});
        rules.insert(finding["rule"].get<std::string>());
    }
    for (const char* rule : {"missing-uv", "non-finite-values", "dark-scene"})
        EXPECT_TRUE(rules.contains(rule)) << rule << "\n" << run.out;
    EXPECT_TRUE(json["bake"]["seconds"].is_null());
    EXPECT_GT(json["bake"]["file_bytes"].get<double>(), 0);
}

TEST_F(LintCommand, SaysWhatABakeTakes) {
    const auto bake = json("lint --json " + std::string("cornell"))["bake"];
    EXPECT_GT(bake["seconds"].get<double>(), 0);
}

TEST_F(LintCommand, WritesSarifAndNothingOverTheScene) {
    const std::string scene = faulty(), log = path("faulty.sarif");
    EXPECT_EQ(limn("lint --no-seconds --sarif " + log + " " + scene).exit, 3);
    const auto sarif = nlohmann::json::parse(contents(log), nullptr, false);
    ASSERT_TRUE(sarif.is_object());
    EXPECT_EQ(sarif["version"], "2.1.0");
    EXPECT_FALSE(sarif["runs"][0]["results"].empty());
    expectRefusal("lint --sarif " + scene + " " + scene, "must end in");
}

} // namespace limn::lint_command_test
