// SPDX-License-Identifier: MIT
#pragma once

#include <oneapi/tbb/task_scheduler_observer.h>

namespace limn {

/// Lets the calling thread run only when the window's has nothing to do. For the rest of the
/// thread's life.
void lowerThreadPriority();

/// While it lives, every thread that oneTBB gives work to is a background thread. The window's
/// thread must not run parallel loops.
class BackgroundWorkers : public tbb::task_scheduler_observer {
public:
    BackgroundWorkers();
    ~BackgroundWorkers() override;
    void on_scheduler_entry(bool isWorker) override;
};

} // namespace limn
