// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"

#include <string>
#include <thread>

namespace limn {

/// Writes pictures as limn-1.png, limn-2.png, ... in the working directory, on a thread.
class ScreenshotWriter {
public:
    ScreenshotWriter() = default;
    ~ScreenshotWriter();
    ScreenshotWriter(const ScreenshotWriter&) = delete;
    ScreenshotWriter& operator=(const ScreenshotWriter&) = delete;

    /// Starts writing `image` and returns its path. Waits for the previous picture if that is still
    /// being written.
    std::string write(Image image);

private:
    std::thread m_thread;
};

} // namespace limn
