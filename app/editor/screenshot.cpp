// SPDX-License-Identifier: MIT
#include "app/editor/screenshot.h"

#include "engine/core/log.h"
#include "engine/files/image_file.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace limn {

ScreenshotWriter::~ScreenshotWriter() {
    if (m_thread.joinable())
        m_thread.join();
}

std::string ScreenshotWriter::write(Image image) {
    if (m_thread.joinable())
        m_thread.join();
    std::string path;
    for (int i = 1;; ++i) {
        path = fmt::format("limn-{}.png", i);
        if (std::error_code error; !std::filesystem::exists(path, error))
            break;
    }
    m_thread = std::thread([image = std::move(image), path] {
        if (const Result<void> written = writePng(path, image); !written)
            logError(written.error().message);
    });
    return path;
}

} // namespace limn
