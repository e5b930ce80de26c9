// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/view/input_queue.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;
struct GLFWcursor;

namespace limn {

/// A GLFW window whose events go into a queue. There is only one at a time, used by the main
/// thread.
class EditorWindow {
public:
    EditorWindow(const EditorWindow&) = delete;
    EditorWindow& operator=(const EditorWindow&) = delete;
    ~EditorWindow();

    InputQueue input;
    std::vector<std::string> dropped; ///< files dropped on the window, not yet taken
    bool closed = false;              ///< the user asked to close it; reset by whoever handles that
    bool damaged = true;              ///< must be redrawn; reset by whoever draws

    /// Waits for an event, at most `seconds` (< 0: indefinitely; 0: not at all).
    void wait(double seconds);
    /// Ends wait() from any thread.
    void wake();
    /// Returns true once after wake().
    bool takeWake() { return m_woken.exchange(false); }
    /// True if something happened that no frame has shown yet.
    bool pending() const {
        return !input.events.empty() || !dropped.empty() || closed || damaged || m_woken;
    }

    glm::uvec2 size() const; ///< of the framebuffer [px]
    float scale() const;     ///< of the interface, 1 on usual screens

    /// Description of a gpu::Device that can present to this window.
    gpu::DeviceDesc deviceDesc() const;
    /// Fails if the driver cannot draw into the window.
    Result<VkSurfaceKHR> createSurface(VkInstance instance) const;

    /// Connects ImGui's clipboard; call after its context was created.
    void connectImGui();
    /// Shows ImGui's cursor.
    void showCursor(int imguiCursor);
    void setTitle(const std::string& title);

private:
    friend Result<std::unique_ptr<EditorWindow>> createEditorWindow(std::uint32_t, std::uint32_t);
    EditorWindow() = default;

    GLFWwindow* m_window = nullptr;
    std::vector<GLFWcursor*> m_cursors;
    std::string m_title;
    int m_cursor = 0;
    std::atomic<bool> m_woken{false};
};

/// Creates the window. Fails without a display.
Result<std::unique_ptr<EditorWindow>> createEditorWindow(std::uint32_t width, std::uint32_t height);

} // namespace limn
