// SPDX-License-Identifier: MIT
#include "app/editor/editor_app.h"

#include "app/editor/editor_window.h"
#include "app/editor/screenshot.h"
#include "app/editor/viewport_picture.h"
#include "app/resources.h"
#include "editor_ui/editor.h"
#include "editor_ui/panels/theme.h"
#include "engine/core/log.h"
#include "engine/core/replace_file.h"
#include "engine/core/user_folder.h"
#include "engine/json/json.h"
#include "engine/stages/stage_store.h"

#include <imgui.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace limn {

using Clock = std::chrono::steady_clock;

namespace {

/// ImGui's context with our colours, keys and font, for a window.
struct ImGuiContextOwner {
    explicit ImGuiContextOwner(EditorWindow& window) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.ConfigDragClickToInputText = true;
        io.ConfigInputTextCursorBlink = false; // each blink would draw the whole window
        mapKeys();
        applyTheme();
        const float scale = window.scale();
        ImGui::GetStyle().ScaleAllSizes(scale);
        if (addFont(kFontPixels * scale, dataFolder("resources") + "/fonts").empty())
            logWarning("no font found: Greek letters and superscripts are shown as \"?\"; install "
                       "DejaVu Sans");
        window.connectImGui();
    }
    ~ImGuiContextOwner() { ImGui::DestroyContext(); }
    ImGuiContextOwner(const ImGuiContextOwner&) = delete;
    ImGuiContextOwner& operator=(const ImGuiContextOwner&) = delete;
};

/// Where copies of unsaved documents are kept; empty: nowhere.
std::string recoveryFolder() {
    const std::string state = userFolder(UserFolder::State);
    return state.empty() ? state : state + "/recovery";
}

/// Empty: nothing is remembered.
std::string settingsFile() {
    const std::string config = userFolder(UserFolder::Config);
    return config.empty() ? config : config + "/editor.json";
}

double msBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

/// Milliseconds of a frame, all of it and by part.
Json frameJson(const FrameTime& frame) {
    return {{"total_ms", frame.total()},     {"beyond_viewport_ms", frame.beyondViewport()},
            {"panels_ms", frame.panels},     {"jobs_ms", frame.jobs},
            {"viewport_ms", frame.viewport}, {"window_ms", frame.window}};
}

/// How far the picture is from the reference; null where there is none of this view.
Json comparisonJson(const Session& session) {
    const ReferenceStatus& reference = session.state.compare.reference;
    if (!reference.error)
        return nullptr;
    return {{"number", session.compared().number},
            {"samples", reference.samples},
            {"nrmse", reference.error->nrmse},
            {"nrmse_noise", reference.error->nrmseNoise},
            {"flip", reference.error->flip}};
}

/// Frames drawn after the last event, so that hover and layout of ImGui settle.
constexpr int kFramesAfterEvent = 2;
constexpr double kLookWhenIdleSeconds = 0.25, kLookWhenBusySeconds = 0.05;

/// The window, the session and what draws them. Members are destroyed last to first.
class EditorApp {
public:
    EditorApp(const EditorAppOptions& options, std::unique_ptr<EditorWindow> window,
              std::unique_ptr<gpu::Device> device, VkSurfaceKHR surface)
        : m_options(options), m_window(std::move(window)), m_device(std::move(device)),
          m_swapchain(*m_device, surface), m_imgui(*m_window), m_renderer(*m_device, m_swapchain),
          m_picture(*m_device, options.validate, [this] { m_window->wake(); }),
          m_session({options.projectsFolder, [this] { m_window->wake(); }, !options.noBake,
                     defaultStageFolder(), options.import, options.exportFolders, recoveryFolder(),
                     settingsFile()}) {}

    void run();
    void writeStats() const;
    std::vector<std::string> validationMessages() const;

private:
    bool waitForWork();
    void frame();
    bool fitSwapchain();
    void draw(FrameTime& time);
    void takeWindowEvents();
    void takeScreenshots();
    void countLatency(double ms);

    EditorAppOptions m_options;
    std::unique_ptr<EditorWindow> m_window;
    std::unique_ptr<gpu::Device> m_device;
    gpu::Swapchain m_swapchain;
    ImGuiContextOwner m_imgui;
    UiRenderer m_renderer;
    ViewportPicture m_picture;
    ScreenshotWriter m_screenshots;
    Session m_session;
    Clock::time_point m_lastFrame = Clock::now();
    int m_framesOwed = kFramesAfterEvent;
    bool m_wasIdle = false;
    std::uint64_t m_compared = 0; ///< ComparedPicture::number of the latest frame
    bool m_gathered = false;      ///< its picture was gathered
};

/// Sleeps until there is something to draw. Returns false after a wait that brought nothing.
bool EditorApp::waitForWork() {
    const EditorState& state = m_session.state;
    const double seconds = m_picture.secondsToNext();
    const bool due =
        m_framesOwed > 0 || state.view.animating || state.playing || m_window->pending();
    const auto before = Clock::now();
    // Sleeps are bounded: a thread of the Vulkan driver that reads the same X connection can
    // consume the event we sleep for, a key or a wake(), without waking us. Checking costs nothing
    // and draws nothing.
    const double longest = m_wasIdle ? kLookWhenIdleSeconds : kLookWhenBusySeconds;
    m_window->wait(due ? 0 : seconds < 0 ? longest : seconds);
    const bool timer =
        !due && seconds >= 0 &&
        std::chrono::duration<double>(Clock::now() - before).count() >= seconds * 0.9;
    if (!m_window->input.events.empty() || m_window->damaged || m_window->closed ||
        !m_window->dropped.empty())
        m_framesOwed = kFramesAfterEvent;
    const bool woken = m_window->takeWake();
    if ((woken || timer) && m_framesOwed == 0)
        m_framesOwed = 1;
    return m_framesOwed > 0 || state.view.animating || state.playing;
}

void EditorApp::takeWindowEvents() {
    if (std::exchange(m_window->closed, false))
        m_session.state.requests.push_back({Request::Kind::Quit, {}});
    for (const std::string& path : std::exchange(m_window->dropped, {}))
        m_session.state.requests.push_back({Request::Kind::Open, path});
    m_window->damaged = false;
}

void EditorApp::frame() {
    const auto start = Clock::now();
    const WorkSet before = m_session.working();
    const float gathered = m_session.state.frame.gathered;
    ImGuiIO& io = ImGui::GetIO();
    const glm::uvec2 size = m_window->size();
    io.DisplaySize = {float(size.x), float(size.y)};
    io.DeltaTime = std::max(std::chrono::duration<float>(start - m_lastFrame).count(), 1e-4f);
    m_lastFrame = start;
    takeWindowEvents();
    const auto pressed = feedInput(m_window->input);
    ImGui::NewFrame();
    drawEditor(m_session.state, pressed);
    ImGui::Render();
    m_window->showCursor(ImGui::GetMouseCursor());
    const auto drawn = Clock::now();
    m_session.update();
    takeScreenshots();
    const auto updated = Clock::now();
    m_picture.update(m_session);
    FrameTime time{.panels = msBetween(start, drawn),
                   .jobs = msBetween(drawn, updated),
                   .viewport = msBetween(updated, Clock::now())};
    draw(time);
    FrameStatus& status = m_session.state.frame;
    m_framesOwed = std::max(m_framesOwed - 1, status.gathered != gathered ? 1 : 0); // panels say it
    ++status.uiFrames;
    status.frames.add(time, before | m_session.working());
}

void EditorApp::countLatency(double ms) {
    FrameStatus& f = m_session.state.frame;
    f.longestLatencyMs = std::max(f.longestLatencyMs, ms);
}

/// False while the window is minimised.
bool EditorApp::fitSwapchain() {
    const glm::uvec2 size = m_window->size();
    if (!m_swapchain.outdated() && m_swapchain.width == size.x && m_swapchain.height == size.y)
        return true;
    if (!m_swapchain.resize(size.x, size.y))
        return false;
    m_renderer.resized();
    m_framesOwed = kFramesAfterEvent;
    return true;
}

/// Draws the window and adds to `time` what that took.
void EditorApp::draw(FrameTime& time) {
    const auto start = Clock::now();
    if (!fitSwapchain())
        return;
    const auto image = m_swapchain.acquire();
    if (!image) {
        m_framesOwed = kFramesAfterEvent;
        return;
    }
    VkCommandBuffer cmd = m_device->begin("window");
    const auto acquired = Clock::now();
    const WindowPicture picture = m_picture.record(cmd, m_session.state.view);
    const auto copied = Clock::now();
    m_renderer.record(cmd, *image, picture);
    m_swapchain.present(cmd, *image);
    time.viewport += msBetween(acquired, copied);
    time.window = msBetween(start, acquired) + msBetween(copied, Clock::now());
}

void EditorApp::takeScreenshots() {
    auto& requests = m_session.state.requests;
    const auto shots = std::erase_if(
        requests, [](const Request& r) { return r.kind == Request::Kind::Screenshot; });
    if (shots == 0 || !m_picture.image())
        return;
    const std::string path = m_screenshots.write(*m_picture.image());
    m_session.state.log.push_back({LogLine::Level::Info, "Screenshot " + path});
}

std::vector<std::string> EditorApp::validationMessages() const {
    std::vector<std::string> all = m_device->validationMessages();
    for (std::string& message : m_picture.validationMessages())
        all.push_back(std::move(message));
    return all;
}

void EditorApp::writeStats() const {
    if (m_options.statsPath.empty())
        return;
    const EditorState& s = m_session.state;
    Json during;
    for (std::size_t i = 0; i < kWorkNames.size(); ++i)
        during[kWorkNames[i]] = frameJson(s.frame.frames.during[i]);
    const Json json = {
        {"device", m_device->properties.deviceName},
        {"frames", s.frame.uiFrames},
        {"pictures", s.frame.pictures},
        {"gathered", s.frame.gathered},
        {"longest_frame", frameJson(s.frame.frames.sinceStart)},
        {"longest_frame_since_idle", frameJson(s.frame.frames.sinceIdle)},
        {"longest_frame_during", during},
        {"longest_latency_ms", s.frame.longestLatencyMs},
        {"bake_seconds", m_session.bakeSeconds()},
        {"bake_seconds_since_light_edit", s.bake.secondsSinceLightEdit},
        {"bake_bytes", totalOf(s.bake.last.bytes)},
        {"bake_up_to_date", s.bake.freshness == BakeFreshness::UpToDate},
        {"technique", singleton<TechniqueChoice>(s.document).technique},
        {"relight_calls", s.relight.calls},
        {"relight_converged", s.relight.converged},
        {"relight_on", kRelightOnNames[std::size_t(s.relightPlace.used())]},
        {"relight_cpu_ms", s.relightPlace.times ? s.relightPlace.times->cpuMs : 0},
        {"relight_gpu_ms", s.relightPlace.times ? s.relightPlace.times->gpuMs : 0},
        {"edits", s.history.applied},
        {"selection", s.selection},
        {"unsaved", hasUnsavedChanges(s)},
        {"comparison", comparisonJson(m_session)},
        {"validating", m_device->validating},
        {"validation_messages", validationMessages()},
    };
    if (const Result<void> written = replaceFile(m_options.statsPath, json.dump(2) + '\n');
        !written)
        logWarning(written.error().message);
}

void EditorApp::run() {
    m_session.state.relightPlace.wanted = m_options.relightOn;
    m_session.open(m_options.scene);
    while (!m_session.wantsQuit()) {
        if (!waitForWork())
            continue;
        const auto wanted = Clock::now();
        while (!m_swapchain.ready()) // events are still taken in while the GPU is behind
            m_window->wait(0.002);
        frame();
        countLatency(msBetween(wanted, Clock::now()));
        // A reference is refined for minutes, in which the editor is never idle. Pictures are
        // gathered while it is.
        const std::uint64_t number = m_session.compared().number;
        const bool gathered = m_session.state.frame.gathered == 1;
        if (number != m_compared || (gathered && !m_gathered))
            writeStats();
        m_compared = number;
        m_gathered = gathered;
        const bool idle = m_session.idle() && m_framesOwed == 0 && m_picture.idle();
        if (idle && !m_wasIdle) {
            writeStats();
            m_session.state.frame.frames.idle();
            m_framesOwed = 1; // the panels show the last numbers
        }
        m_wasIdle = idle;
        m_window->setTitle(
            m_session.state.projectPath.empty() ? "Limn" : m_session.state.projectPath + " - Limn");
    }
    writeStats();
}

} // namespace

Result<void> runEditor(const EditorAppOptions& options) {
    auto window = createEditorWindow(options.width, options.height);
    if (!window)
        return tl::make_unexpected(window.error());
    gpu::DeviceDesc desc = (*window)->deviceDesc();
    desc.validation = options.validate;
    auto device = gpu::createDevice(desc);
    if (!device)
        return tl::make_unexpected(device.error());
    if (!(*device)->lacking.empty())
        logInfo(fmt::format("{} lacks {}", (*device)->properties.deviceName,
                            fmt::join((*device)->lacking, ", ")));
    const auto surface = (*window)->createSurface((*device)->instance);
    if (!surface)
        return tl::make_unexpected(surface.error());
    EditorApp app(options, std::move(*window), std::move(*device), *surface);
    app.run();
    const std::vector<std::string> messages = app.validationMessages();
    if (options.validate && !messages.empty())
        return fail(
            fmt::format("{} validation messages, the first: {}", messages.size(), messages[0]));
    return {};
}

} // namespace limn
