// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include <glm/vec2.hpp>

namespace limn {

/// A program that runs beside the test; ended with it.
class ChildProcess {
public:
    /// `environment`: NAME=VALUE that are added. `output` >= 0: becomes its descriptor 3.
    ChildProcess(const std::vector<std::string>& command,
                 const std::vector<std::string>& environment, const std::string& folder,
                 int output = -1);
    ~ChildProcess();
    ChildProcess(ChildProcess&& other) noexcept : m_pid(other.m_pid), m_status(other.m_status) {
        other.m_pid = -1;
    }
    ChildProcess& operator=(ChildProcess&&) = delete;

    bool running();
    /// Its exit status; 128 + signal when it was killed. Ends it after a minute.
    int wait();
    /// Ends it at once, as the kernel does when memory is short.
    void kill();
    pid_t id() const { return m_pid; } ///< -1 once it has ended

private:
    pid_t m_pid = -1;
    int m_status = -1;
};

/// An X server without a monitor, and xdotool to use what it shows.
class VirtualScreen {
public:
    std::vector<std::string> environment() const;

    void focusWindow();
    void move(glm::vec2 pixel);
    void click(glm::vec2 pixel);
    /// Clicks while a modifier is held: "ctrl".
    void clickWith(const std::string& modifier, glm::vec2 pixel);
    void drag(glm::vec2 from, glm::vec2 to);
    /// A key by its X name, with modifiers before it: "ctrl+s".
    void key(const std::string& name);
    void type(const std::string& text);

    /// What the screen shows.
    Image picture() const;

    /// Number of different colours in a rectangle of the screen.
    std::size_t colorsIn(glm::vec2 origin, glm::vec2 size) const;

private:
    friend std::optional<VirtualScreen> startVirtualScreen(int, int, const std::string&);
    explicit VirtualScreen(ChildProcess server) : m_server(std::move(server)) {}
    void xdotool(std::vector<std::string> arguments);

    ChildProcess m_server;
    std::string m_display, m_folder;
};

/// Makes `folder` and starts a server on a free display. Nothing where Xvfb or xdotool is not
/// installed.
std::optional<VirtualScreen> startVirtualScreen(int width, int height, const std::string& folder);

int processId();

} // namespace limn
