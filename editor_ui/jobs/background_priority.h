// SPDX-License-Identifier: MIT
#pragma once

#include <oneapi/tbb/task_scheduler_observer.h>

namespace limn {

/// Lowers the priority of the calling thread below that of the window's thread, for the rest of its
/// life.
void lowerThreadPriority();

/// While it exists, every thread that runs oneTBB work is a background thread. The window's thread
/// must not run parallel loops.
class BackgroundWorkers : public tbb::task_scheduler_observer {
public:
    BackgroundWorkers();
    ~BackgroundWorkers() override;
    void on_scheduler_entry(bool isWorker) override;
};

} // namespace limn
