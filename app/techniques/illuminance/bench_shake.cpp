// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_shake.h"

#include "app/bench/random_scene.h"

#include "engine/core/log.h"
#include "engine/gpu/device.h"
#include "engine/measure/compare.h"
#include "engine/render/shadowed_lights.h"
#include "engine/techniques/illuminance/gpu/viewport_relighter.h"

#include <chrono>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

namespace limn {

namespace {

using Clock = std::chrono::steady_clock;

/// Share of the time, and frames, after which caches and pools have grown to what they need and a
/// driver has compiled its shaders.
constexpr double kWarmUp = 0.2;
constexpr std::uint64_t kWarmFrames = 100;

constexpr std::uint32_t kFramesPerRelighter = 300, kFramesPerFieldLook = 10;

/// Resident memory of this process [bytes].
std::uint64_t residentBytes() {
    std::ifstream in("/proc/self/statm");
    std::uint64_t whole = 0, resident = 0;
    in >> whole >> resident;
    return resident * std::uint64_t(sysconf(_SC_PAGESIZE));
}

std::uint64_t countInvalid(const std::vector<glm::vec4>& values) {
    std::uint64_t count = 0;
    for (const glm::vec4& v : values)
        count += !std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z);
    return count;
}

struct ShakeResult {
    std::array<std::uint64_t, kShakeNames.size()> shakes{};
    std::uint64_t frames = 0, fieldLooks = 0, invalidPixels = 0, invalidField = 0;
    std::uint64_t linksOccluded = 0; ///< in all frames
    std::uint64_t residentStart = 0, residentWarm = 0, residentEnd = 0;
    std::uint64_t gpuBytesWarm = 0, gpuBytesEnd = 0;
    std::vector<double> frameMs;

    /// Growth after the warm-up [MiB]; 0 if the warm-up took all of the time, which proves nothing.
    double growthMiB() const {
        if (residentWarm == 0)
            return 0;
        return (double(residentEnd) - double(residentWarm)) / double(1 << 20);
    }
};

/// A viewport with bounced light that draws the current state of a changing scene.
class StressedViewport {
public:
    StressedViewport(gpu::Device& device, const BenchBake& baked, const ViewportOptions& options)
        : m_device(device), m_bake(baked.bake), m_viewport(device), m_options(options) {}

    /// Grows the shadow maps to their maximum, which random lights would do sooner or later.
    void fillShadowMaps(Scene scene);
    /// Draws one frame after some changes.
    Result<void> draw(RandomScene& random, ShakeResult& result);
    std::uint64_t gpuBytes() {
        m_device.waitIdle();
        return m_viewport.stats().gpuBytes;
    }

private:
    gpu::Device& m_device;
    std::shared_ptr<const Bake> m_bake;
    Viewport m_viewport;
    std::unique_ptr<ViewportRelighter> m_relighter;
    ViewportOptions m_options;
};

void StressedViewport::fillShadowMaps(Scene scene) {
    scene.lights.clear();
    for (std::uint32_t k = 0; k < kMaxShadowLayers; ++k) {
        Light& sun = scene.lights.emplace_back();
        sun.kind = LightKind::Directional;
        sun.direction = glm::normalize(glm::vec3(float(k), -100, 0));
        sun.strength = 1;
    }
    m_viewport.setScene(scene, nullptr);
    m_viewport.shadowedLights();
}

Result<void> StressedViewport::draw(RandomScene& random, ShakeResult& result) {
    if (result.frames % kFramesPerRelighter == 0) {
        auto made = ViewportRelighter::create(m_device, m_bake);
        if (!made)
            return tl::make_unexpected(made.error());
        m_relighter = std::move(*made);
    }
    for (std::uint32_t changes = random.below(4); changes > 0; --changes)
        ++result.shakes[std::size_t(random.shake())];
    const auto start = Clock::now();
    m_viewport.setScene(random.scene, {m_bake, &m_bake->lightmap});
    result.linksOccluded +=
        m_relighter->relight(m_viewport, random.scene, 1 + random.below(3)).linksOccluded;
    m_options.view = View(random.below(std::uint32_t(kViewNames.size())));
    m_viewport.render(m_options);
    result.invalidPixels += countInvalidPixels(m_viewport.readLinear());
    result.frameMs.push_back(
        std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    if (result.frames++ % kFramesPerFieldLook == 0) {
        const IndirectField field = m_relighter->gpu().readField();
        result.invalidField += countInvalid(field.lightmap) + countInvalid(field.grid);
        ++result.fieldLooks;
    }
    return {};
}

Result<ShakeResult> stress(const ShakeBench& o, const BenchBake& baked, gpu::Device& device) {
    const Result<Camera> camera = chooseCamera(baked.scene, o.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    ShakeResult result;
    result.residentStart = residentBytes();
    RandomScene random(baked.scene, o.seed);
    StressedViewport viewport(
        device, baked, {.camera = *camera, .width = o.camera.width, .height = o.camera.height});
    viewport.fillShadowMaps(random.scene);
    const auto start = Clock::now();
    for (double seconds = 0; seconds < o.seconds || result.frames < o.frames;) {
        if (const Result<void> drawn = viewport.draw(random, result); !drawn)
            return tl::make_unexpected(drawn.error());
        seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (result.residentWarm == 0 && seconds >= kWarmUp * o.seconds &&
            result.frames >= kWarmFrames) {
            result.gpuBytesWarm = viewport.gpuBytes();
            result.residentWarm = residentBytes();
        }
    }
    if (result.residentWarm == 0)
        logWarning(fmt::format("{}: {} frames are too few to tell whether memory grows", baked.name,
                               result.frames));
    result.gpuBytesEnd = viewport.gpuBytes();
    result.residentEnd = residentBytes();
    return result;
}

Json describe(const ShakeBench& o, const BenchBake& baked, const gpu::Device& device,
              const ShakeResult& r, std::size_t messages) {
    Json row = {{"name", baked.name},      {"device", device.properties.deviceName},
                {"seed", o.seed},          {"seconds", o.seconds},
                {"width", o.camera.width}, {"height", o.camera.height}};
    row.update(settingsOf(baked));
    row.update({{"frames", r.frames},
                {"field_looks", r.fieldLooks},
                {"links_occluded", r.linksOccluded},
                {"messages", messages},
                {"invalid_pixels", r.invalidPixels},
                {"invalid_field", r.invalidField},
                {"resident_start", r.residentStart},
                {"resident_warm", r.residentWarm},
                {"resident_end", r.residentEnd},
                {"growth_mib", r.growthMiB()},
                {"gpu_bytes_warm", r.gpuBytesWarm},
                {"bytes", r.gpuBytesEnd}});
    for (std::size_t k = 0; k < kShakeNames.size(); ++k)
        row[std::string(kShakeNames[k])] = r.shakes[k];
    addSpread(row, "", r.frameMs);
    return row;
}

constexpr Column kShakeColumns[] = {{"scene", -14, "name"},
                                    {"frames", 7, "frames"},
                                    {"messages", 8, "messages"},
                                    {"bad px", 8, "invalid_pixels"},
                                    {"bad tx", 8, "invalid_field"},
                                    {"start MiB", 9, "resident_start", 1, kMiB},
                                    {"warm MiB", 9, "resident_warm", 1, kMiB},
                                    {"end MiB", 9, "resident_end", 1, kMiB},
                                    {"growth", 8, "growth_mib", 1},
                                    {"frame ms", 9, "median_ms"},
                                    {"p95", 8, "p95_ms"}};

/// Describes what is wrong with a run; empty if nothing is.
std::string defectOf(const ShakeBench& o, const ShakeResult& r,
                     const std::vector<std::string>& messages) {
    if (!messages.empty())
        return fmt::format("{} validation messages, the first: {}", messages.size(), messages[0]);
    if (r.invalidPixels + r.invalidField > 0)
        return fmt::format("{} pixels and {} texels are not finite", r.invalidPixels,
                           r.invalidField);
    if (r.growthMiB() > o.growthMiB)
        return fmt::format("memory grew by {:.1f} MiB, more than {:.1f}", r.growthMiB(),
                           o.growthMiB);
    return {};
}

} // namespace

Exit runShakeBench(const ShakeBench& o) {
    const auto device = gpu::createDevice({.name = o.device, .validation = true});
    if (!device)
        return failed("--device: " + device.error().message);
    if (!(*device)->validating)
        return failed("the Vulkan validation layer is missing");
    if (!o.json)
        printTitles(kShakeColumns);
    Json rows = Json::array();
    std::string defect;
    const Result<void> measured = forEachBake(o.bakes, [&](const BenchBake& baked) -> Result<void> {
        const Result<ShakeResult> result = stress(o, baked, **device);
        if (!result)
            return tl::make_unexpected(result.error());
        const std::vector<std::string> messages = (*device)->validationMessages();
        rows.push_back(describe(o, baked, **device, *result, messages.size()));
        if (!o.json)
            printRow(kShakeColumns, rows.back());
        if (defect.empty())
            defect = defectOf(o, *result, messages);
        return {};
    });
    if (!measured)
        return failed(measured.error().message);
    const Exit written = writeRows(rows, o.output, "stress", o.json);
    return written == Exit::Done && !defect.empty() ? failed(defect) : written;
}

void addShakeOptions(Command& command, ShakeBench& o) {
    o.bakes.surfels = {4096};
    o.bakes.storages = {"rtp"};
    o.bakes.lightmap = 2000;
    o.bakes.rays = 256;
    o.camera.width = 160;
    o.camera.height = 120;
    addBenchBakes(command, o.bakes).required(false);
    addCameraOptions(command, o.camera);
    command.option("--seconds", o.seconds, "Duration for each bake [s]").within(0.1, 1e6);
    command.option("--frames", o.frames, "Minimum number of frames, however long they take")
        .within(1, 1000000);
    command.option("--seed", o.seed, "Seed of the changes");
    command
        .option("--growth", o.growthMiB,
                "Maximum growth of resident memory after a fifth of the time and 100 frames "
                "[MiB]")
        .within(0.0, 1e6);
}

} // namespace limn
