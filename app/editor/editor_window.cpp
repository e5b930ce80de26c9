// SPDX-License-Identifier: MIT
#include "app/editor/editor_window.h"

#include "app/resources.h"
#include "engine/core/log.h"
#include "engine/core/read_file.h"
#include "engine/gpu/vulkan_error.h"
#include "engine/scene/decode_image.h"

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

#include <fmt/format.h>

namespace limn {

static_assert(key::kEscape == GLFW_KEY_ESCAPE && key::kDelete == GLFW_KEY_DELETE &&
              key::kEnd == GLFW_KEY_END);
static_assert(key::kF12 == GLFW_KEY_F12 && key::kPad0 == GLFW_KEY_KP_0 &&
              key::kPadDecimal == GLFW_KEY_KP_DECIMAL);
static_assert(key::kRightSuper == GLFW_KEY_RIGHT_SUPER && key::of('Z') == GLFW_KEY_Z &&
              key::kPadEnter == GLFW_KEY_KP_ENTER);

static EditorWindow& windowOf(GLFWwindow* window) {
    return *static_cast<EditorWindow*>(glfwGetWindowUserPointer(window));
}

/// GLFW's `mods` of a modifier's own press lack it, and of its release still have it.
static std::uint8_t modsOf(int code, bool down, int glfwMods) {
    int mods = (glfwMods & GLFW_MOD_CONTROL ? kCtrl : 0) |
               (glfwMods & GLFW_MOD_SHIFT ? kShift : 0) | (glfwMods & GLFW_MOD_ALT ? kAlt : 0);
    const auto updateModifier = [&](int left, int right, int bit) {
        if (code == left || code == right)
            mods = down ? mods | bit : mods & ~bit;
    };
    updateModifier(key::kLeftControl, key::kRightControl, kCtrl);
    updateModifier(key::kLeftShift, key::kRightShift, kShift);
    updateModifier(key::kLeftAlt, key::kRightAlt, kAlt);
    return std::uint8_t(mods);
}

static void onKey(GLFWwindow* window, int code, int, int action, int mods) {
    const bool down = action != GLFW_RELEASE;
    windowOf(window).input.events.push_back({.kind = InputEvent::Kind::Key,
                                             .code = code,
                                             .down = down,
                                             .mods = modsOf(code, down, mods)});
}

static void onCharacter(GLFWwindow* window, unsigned codePoint) {
    windowOf(window).input.events.push_back(
        {.kind = InputEvent::Kind::Character, .code = int(codePoint)});
}

static void onButton(GLFWwindow* window, int button, int action, int) {
    windowOf(window).input.events.push_back(
        {.kind = InputEvent::Kind::MouseButton, .code = button, .down = action == GLFW_PRESS});
}

static void onMove(GLFWwindow* window, double x, double y) {
    int w = 1, h = 1, fw = 1, fh = 1;
    glfwGetWindowSize(window, &w, &h);
    glfwGetFramebufferSize(window, &fw, &fh);
    const glm::vec2 position(x * fw / std::max(w, 1), y * fh / std::max(h, 1));
    auto& events = windowOf(window).input.events;
    if (!events.empty() && events.back().kind == InputEvent::Kind::MouseMove)
        events.back().position = position; // a frame shows one of them anyway
    else
        events.push_back({.kind = InputEvent::Kind::MouseMove, .position = position});
}

static void onScroll(GLFWwindow* window, double x, double y) {
    windowOf(window).input.events.push_back({.kind = InputEvent::Kind::Scroll, .position = {x, y}});
}

static void onFocus(GLFWwindow* window, int focused) {
    windowOf(window).input.events.push_back(
        {.kind = InputEvent::Kind::Focus, .down = focused != 0});
}

static void onDrop(GLFWwindow* window, int count, const char** paths) {
    windowOf(window).dropped.assign(paths, paths + count);
}

static void onClose(GLFWwindow* window) {
    windowOf(window).closed = true;
    glfwSetWindowShouldClose(window, GLFW_FALSE);
}

static void onDamage(GLFWwindow* window) {
    windowOf(window).damaged = true;
}

static void onSize(GLFWwindow* window, int, int) {
    windowOf(window).damaged = true;
}

static void setCallbacks(GLFWwindow* window) {
    glfwSetKeyCallback(window, onKey);
    glfwSetCharCallback(window, onCharacter);
    glfwSetMouseButtonCallback(window, onButton);
    glfwSetCursorPosCallback(window, onMove);
    glfwSetScrollCallback(window, onScroll);
    glfwSetWindowFocusCallback(window, onFocus);
    glfwSetDropCallback(window, onDrop);
    glfwSetWindowCloseCallback(window, onClose);
    glfwSetWindowRefreshCallback(window, onDamage);
    glfwSetFramebufferSizeCallback(window, onSize);
}

static std::string lastGlfwError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "unknown reason";
}

/// A window without an icon works as well.
static void setIcon(GLFWwindow* window) {
    const std::string path = dataFolder("resources") + "/icons/limn.png";
    const Result<std::string> bytes = readFile(path);
    if (!bytes)
        return logWarning(path + ": " + bytes.error().message);
    Result<Image> icon =
        decodeImage({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
    if (!icon)
        return logWarning(path + ": " + icon.error().message);
    const GLFWimage image{int(icon->width), int(icon->height), icon->rgba.data()};
    glfwSetWindowIcon(window, 1, &image);
}

Result<std::unique_ptr<EditorWindow>> createEditorWindow(std::uint32_t width,
                                                         std::uint32_t height) {
    if (!glfwInit())
        return fail(fmt::format("no display: use `limn render` ({})", lastGlfwError()));
    if (!glfwVulkanSupported()) {
        glfwTerminate();
        return fail("no Vulkan driver that can draw into a window");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    std::unique_ptr<EditorWindow> window(new EditorWindow);
    window->m_window = glfwCreateWindow(int(width), int(height), "Limn", nullptr, nullptr);
    if (!window->m_window)
        return fail(fmt::format("cannot open a window: {}", lastGlfwError()));
    glfwSetWindowSizeLimits(window->m_window, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
    setIcon(window->m_window);
    glfwSetWindowUserPointer(window->m_window, window.get());
    setCallbacks(window->m_window);
    return window;
}

EditorWindow::~EditorWindow() {
    for (GLFWcursor* cursor : m_cursors)
        if (cursor)
            glfwDestroyCursor(cursor);
    if (m_window)
        glfwDestroyWindow(m_window);
    glfwTerminate();
}

void EditorWindow::wait(double seconds) {
    if (seconds < 0)
        glfwWaitEvents();
    else if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

void EditorWindow::wake() {
    m_woken = true;
    glfwPostEmptyEvent();
}

glm::uvec2 EditorWindow::size() const {
    int w = 0, h = 0;
    glfwGetFramebufferSize(m_window, &w, &h);
    return {unsigned(std::max(w, 0)), unsigned(std::max(h, 0))};
}

float EditorWindow::scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(m_window, &x, &y);
    return std::clamp(y, 1.f, 4.f);
}

gpu::DeviceDesc EditorWindow::deviceDesc() const {
    gpu::DeviceDesc desc;
    std::uint32_t count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&count);
    desc.instanceExtensions.assign(extensions, extensions + count);
    desc.canPresent = [](VkInstance instance, VkPhysicalDevice physical, std::uint32_t family) {
        return glfwGetPhysicalDevicePresentationSupport(instance, physical, family) == GLFW_TRUE;
    };
    return desc;
}

Result<VkSurfaceKHR> EditorWindow::createSurface(VkInstance instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    const VkResult result = glfwCreateWindowSurface(instance, m_window, nullptr, &surface);
    if (result != VK_SUCCESS)
        return fail(fmt::format("cannot draw into the window: {}", gpu::resultName(result)));
    return surface;
}

void EditorWindow::connectImGui() {
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = m_window;
    io.GetClipboardTextFn = [](void* window) {
        return glfwGetClipboardString(static_cast<GLFWwindow*>(window));
    };
    io.SetClipboardTextFn = [](void* window, const char* text) {
        glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
    };
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    m_cursors.assign(ImGuiMouseCursor_COUNT, nullptr);
    m_cursors[ImGuiMouseCursor_TextInput] = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
    m_cursors[ImGuiMouseCursor_ResizeNS] = glfwCreateStandardCursor(GLFW_VRESIZE_CURSOR);
    m_cursors[ImGuiMouseCursor_ResizeEW] = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
    m_cursors[ImGuiMouseCursor_Hand] = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
}

void EditorWindow::showCursor(int imguiCursor) {
    if (imguiCursor == m_cursor || imguiCursor < 0 || std::size_t(imguiCursor) >= m_cursors.size())
        return;
    m_cursor = imguiCursor;
    glfwSetCursor(m_window, m_cursors[std::size_t(imguiCursor)]); // null: the arrow
}

void EditorWindow::setTitle(const std::string& title) {
    if (title == m_title)
        return;
    m_title = title;
    glfwSetWindowTitle(m_window, title.c_str());
}

} // namespace limn
