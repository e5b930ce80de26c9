// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/background_priority.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace limn {

void lowerThreadPriority() {
#ifdef __linux__
    // On Linux the nice value belongs to the thread. Failing only makes the window less smooth.
    (void)setpriority(PRIO_PROCESS, id_t(gettid()), 15);
#endif
}

BackgroundWorkers::BackgroundWorkers() {
    observe(true);
}

BackgroundWorkers::~BackgroundWorkers() {
    observe(false);
}

void BackgroundWorkers::on_scheduler_entry(bool isWorker) {
    if (isWorker)
        lowerThreadPriority();
}

} // namespace limn
