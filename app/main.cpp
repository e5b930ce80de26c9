// SPDX-License-Identifier: MIT
#include "app/commands/command.h"

#include <cstdio>
#include <exception>

namespace limn {

Exit failed(const std::string& message) {
    std::fprintf(stderr, "limn: %s\n", message.c_str());
    return Exit::Failed;
}

static int runLimn(int argc, char** argv) {
    CLI::App app("Limn, an editor for light", "limn");
    app.require_subcommand(1);
    Run run;
    addBakeCommand(app, run);
    addBenchCommand(app, run);
    addCompareCommand(app, run);
#ifdef LIMN_EDITOR
    addEditCommand(app, run);
#endif
    addExplainCommand(app, run);
    addExportCommand(app, run);
    addInfoCommand(app, run);
    addReferenceCommand(app, run);
    addRenderCommand(app, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? int(Exit::Done) : int(Exit::Usage);
    }
    const Exit exit = run();
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
