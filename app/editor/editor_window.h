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

/// A GLFW window whose events go into a queue. One at a time; the main thread's.
class EditorWindow {
public:
    EditorWindow(const EditorWindow&) = delete;
    EditorWindow& operator=(const EditorWindow&) = delete;
    ~EditorWindow();

    InputQueue input;
    std::vector<std::string> dropped; ///< files dropped on the window, not yet taken
    bool closed = false;              ///< the user asked to close it; whoever takes that resets it
    bool damaged = true;              ///< must be drawn again; whoever draws resets it

    /// Waits for an event, at most `seconds` (< 0: without end; 0: not at all).
    void wait(double seconds);
    /// Ends wait() from any thread.
    void wake();
    /// True once after wake().
    bool takeWake() { return m_woken.exchange(false); }
    /// Something came that no frame has shown yet.
    bool pending() const {
        return !input.events.empty() || !dropped.empty() || closed || damaged || m_woken;
    }

    glm::uvec2 size() const; ///< of the framebuffer [px]
    float scale() const;     ///< of the interface, 1 on usual screens

    /// What a gpu::Device needs to present here.
    gpu::DeviceDesc deviceDesc() const;
    /// Fails where the driver cannot draw into the window.
    Result<VkSurfaceKHR> createSurface(VkInstance instance) const;

    /// Connects ImGui's clipboard; call with its context made.
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

/// Fails without a display.
Result<std::unique_ptr<EditorWindow>> createEditorWindow(std::uint32_t width, std::uint32_t height);

} // namespace limn
