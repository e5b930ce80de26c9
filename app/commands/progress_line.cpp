// SPDX-License-Identifier: MIT
#include "app/commands/progress_line.h"

#include <cstdio>
#include <memory>
#include <string>

#include <unistd.h>

namespace limn {

Progress progressOnStderr() {
    struct Shown {
        std::string stage;
        int percent = -1;
    };
    Progress progress;
    progress.report = [shown = std::make_shared<Shown>(),
                       terminal = isatty(STDERR_FILENO) != 0](const char* stage, float fraction) {
        const int percent = int(100 * fraction);
        if (shown->stage == stage && (!terminal || percent <= shown->percent))
            return;
        *shown = {stage, percent};
        if (terminal)
            std::fprintf(stderr, "\r%-24s %3d %%", stage, percent);
        else
            std::fprintf(stderr, "%s\n", stage);
    };
    return progress;
}

void endProgressLine() {
    if (isatty(STDERR_FILENO))
        std::fputc('\n', stderr);
}

} // namespace limn
