// SPDX-License-Identifier: MIT
#include "tests/app/virtual_screen.h"

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

namespace limn {

namespace fs = std::filesystem;

int processId() {
    return int(getpid());
}

static void pause(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           const std::vector<std::string>& environment, const std::string& folder,
                           int output) {
    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    m_pid = fork();
    if (m_pid != 0)
        return;
    for (const std::string& variable : environment)
        putenv(const_cast<char*>(variable.c_str()));
    if (output >= 0)
        dup2(output, 3);
    if (chdir(folder.c_str()) == 0)
        execvp(arguments[0], arguments.data());
    _exit(127);
}

ChildProcess::~ChildProcess() {
    if (!running())
        return;
    ::kill(m_pid, SIGTERM);
    for (int i = 0; i < 100 && running(); ++i)
        pause(50);
    kill();
}

bool ChildProcess::running() {
    int status = 0;
    if (m_pid <= 0 || waitpid(m_pid, &status, WNOHANG) == 0)
        return m_pid > 0;
    m_status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    m_pid = -1;
    return false;
}

int ChildProcess::wait() {
    for (int i = 0; i < 600 && running(); ++i)
        pause(100);
    if (running())
        kill();
    return m_status;
}

void ChildProcess::kill() {
    if (!running())
        return;
    ::kill(m_pid, SIGKILL);
    while (running())
        pause(10);
}

static bool installed(const char* program) {
    const char* path = std::getenv("PATH");
    for (std::string rest = path ? path : ""; !rest.empty();) {
        const std::string folder = rest.substr(0, rest.find(':'));
        rest = folder.size() < rest.size() ? rest.substr(folder.size() + 1) : "";
        if (access((folder + "/" + program).c_str(), X_OK) == 0)
            return true;
    }
    return false;
}

/// The number that the server writes once it is ready; empty when it ends before.
static std::string readLine(int descriptor) {
    std::string line;
    for (char c = 0; read(descriptor, &c, 1) == 1 && c != '\n';)
        line += c;
    return line;
}

std::optional<VirtualScreen> startVirtualScreen(int width, int height, const std::string& folder) {
    if (!installed("Xvfb") || !installed("xdotool"))
        return {};
    fs::create_directories(folder);
    int ends[2];
    if (pipe(ends) != 0)
        return {};
    VirtualScreen screen(ChildProcess({"Xvfb", "-displayfd", "3", "-screen", "0",
                                       fmt::format("{}x{}x24", width, height), "-fbdir", folder,
                                       "-nolisten", "tcp", "-noreset"},
                                      {}, folder, ends[1]));
    close(ends[1]);
    screen.m_display = readLine(ends[0]);
    close(ends[0]);
    screen.m_folder = folder;
    if (screen.m_display.empty())
        return {};
    return screen;
}

std::vector<std::string> VirtualScreen::environment() const {
    return {"DISPLAY=:" + m_display, "XDG_CONFIG_HOME=" + m_folder, "XDG_CACHE_HOME=" + m_folder,
            "XDG_STATE_HOME=" + m_folder};
}

void VirtualScreen::xdotool(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "xdotool");
    ChildProcess(arguments, environment(), m_folder).wait();
    pause(150);
}

void VirtualScreen::focusWindow() {
    xdotool({"search", "--sync", "--onlyvisible", "--name", "Limn", "windowfocus"});
}

void VirtualScreen::move(glm::vec2 p) {
    xdotool({"mousemove", std::to_string(int(p.x + 0.5f)), std::to_string(int(p.y + 0.5f))});
}

void VirtualScreen::click(glm::vec2 p) {
    move(p);
    xdotool({"click", "1"});
}

void VirtualScreen::clickWith(const std::string& modifier, glm::vec2 p) {
    move(p);
    xdotool({"keydown", modifier});
    xdotool({"click", "1"});
    xdotool({"keyup", modifier});
}

void VirtualScreen::drag(glm::vec2 from, glm::vec2 to) {
    move(from);
    xdotool({"mousedown", "1"});
    constexpr int kSteps = 6;
    for (int i = 1; i <= kSteps; ++i)
        move(from + (to - from) * (float(i) / kSteps));
    xdotool({"mouseup", "1"});
}

void VirtualScreen::key(const std::string& name) {
    xdotool({"key", name});
}

void VirtualScreen::type(const std::string& text) {
    xdotool({"type", "--delay", "30", text});
}

/// XWD: a header of big-endian words, a table of colours, rows of pixels (blue, green, red,
/// unused).
Image VirtualScreen::picture() const {
    std::ifstream in(fs::path(m_folder) / "Xvfb_screen0", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8 | std::uint8_t(bytes.at(at + i));
        return value;
    };
    const std::size_t header = word(0), bytesPerLine = word(48), tableEntries = word(76);
    const std::size_t pixels = header + 12 * tableEntries;
    Image image{.name = "screen", .width = word(16), .height = word(20), .rgba = {}};
    image.rgba.reserve(std::size_t(image.width) * image.height * 4);
    for (std::size_t y = 0; y < image.height; ++y)
        for (std::size_t x = 0; x < image.width; ++x) {
            const std::size_t at = pixels + y * bytesPerLine + x * 4;
            for (const std::size_t channel : {2, 1, 0})
                image.rgba.push_back(std::uint8_t(bytes.at(at + channel)));
            image.rgba.push_back(255);
        }
    return image;
}

std::size_t VirtualScreen::colorsIn(glm::vec2 origin, glm::vec2 size) const {
    const Image image = picture();
    std::set<std::string> colors;
    for (std::size_t y = std::size_t(origin.y); y < std::size_t(origin.y + size.y); ++y)
        for (std::size_t x = std::size_t(origin.x); x < std::size_t(origin.x + size.x); ++x) {
            const std::uint8_t* pixel = image.rgba.data() + (y * image.width + x) * 4;
            colors.emplace(pixel, pixel + 3);
        }
    return colors.size();
}

} // namespace limn
