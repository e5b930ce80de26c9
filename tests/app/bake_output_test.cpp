// SPDX-License-Identifier: MIT
#include "engine/techniques/technique_table.h"
#include "tests/app/command_line.h"

namespace limn::bake_output_test {
namespace {

using BakeOutput = CommandLine;

TEST_F(BakeOutput, ReplacesTheBakeOfAnyTechniqueAndNothingElse) {
    const std::string to = path("room.limnbake");
    const std::string bake =
        "bake cornell --surfels 200 --links 8 --rays 16 --lightmap 200 -o " + to;
    int techniquesWithFiles = 0;
    for (const Technique* technique : techniques()) {
        if (!technique->precomputation)
            continue;
        ++techniquesWithFiles;
        write(to, std::string(technique->precomputation->fileMark) + " of long ago");
        EXPECT_EQ(limn(bake).exit, 0) << technique->name;
        EXPECT_GT(contents(to).size(), 1000U) << technique->name;
    }
    EXPECT_GE(techniquesWithFiles, 2);
    write(to, "LIMNnote: my notes");
    expectRefusal(bake, "holds something else");
    EXPECT_EQ(contents(to), "LIMNnote: my notes");
}

} // namespace
} // namespace limn::bake_output_test
