// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/editor_settings.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace limn {

/// Writes the editor's settings to their file in the background, a second after they last changed
/// or when it is destroyed. No call waits for the disk except the destructor.
class SettingsJob {
public:
    /// `file`: where they are kept; empty: nowhere. `known`: what the file says.
    SettingsJob(std::string file, EditorSettings known);
    ~SettingsJob();
    SettingsJob(const SettingsJob&) = delete;
    SettingsJob& operator=(const SettingsJob&) = delete;

    /// The settings last passed to keep(), at first those of the file.
    const EditorSettings& latest() const { return m_latest; }

    /// Call with the current settings as often as they may have changed.
    void keep(EditorSettings now);

private:
    void run();

    std::string m_file;
    EditorSettings m_latest;
    std::thread m_thread;
    std::mutex m_mutex; ///< guards the members below
    std::condition_variable m_changed;
    std::optional<EditorSettings> m_unwritten;
    bool m_stop = false;
};

} // namespace limn
