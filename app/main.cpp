// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/program_version.h"

#include <cstdio>
#include <exception>

namespace limn {

static int runLimn(int argc, char** argv) {
    Command program("limn", "Limn, an editor for light", programVersion());
    program.requireCommand();
    addBakeCommand(program);
    addBenchCommand(program);
    addCompareCommand(program);
    addEditCommand(program);
    addExplainCommand(program);
    addExportCommand(program);
    addInfoCommand(program);
    addLintCommand(program);
    addReferenceCommand(program);
    addRenderCommand(program);
    addSolveCommand(program);
    addTuneCommand(program);
    const Command::Chosen chosen = program.parse(argc, argv);
    if (!chosen.action)
        return int(chosen.status);
    const Exit exit = chosen.action();
    // A full disk shows only now, where stdout is a file.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        return int(failed("cannot write to standard output"));
    return int(exit);
}

} // namespace limn

int main(int argc, char** argv) {
    try {
        return limn::runLimn(argc, argv);
    } catch (const std::exception& e) { // device lost, out of memory
        return int(limn::failed(e.what()));
    }
}
