// SPDX-License-Identifier: MIT
#include "app/bench/bench_techniques.h"

#include "app/bench/leak_room.h"
#include "app/bench/light_place.h"
#include "app/bench/measured_scene.h"
#include "app/bench/picture_size.h"
#include "app/bench/place_on_device.h"
#include "app/bench/scene_bench.h"
#include "app/bench/technique_variants.h"
#include "app/bench/techniques_page.h"
#include "app/commands/scene_options.h"

#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/core/replace_file.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace limn {

namespace {

/// Where techniques are measured, as --relight names it. Auto: both where there is a device.
enum class MeasureOn { Auto, Cpu, Gpu, Both };
constexpr std::array<std::string_view, 4> kMeasureOnNames = {"auto", "cpu", "gpu", "both"};

struct TechniquesBench {
    SceneOptions common; ///< lights, sky and dynamic objects of every scene
    CameraOptions camera;
    SceneBenchOptions bench;
    std::vector<std::string> scenes, sizes, varied;
    std::vector<std::uint32_t> points = {0}; ///< numbers of lights; 0: the scene's own
    std::string output, relight = "auto", device;
    std::uint32_t samplesPerPixel = 128;
    int threads = 0;
    bool json = false;
};

constexpr Column kTechniqueColumns[] = {{"scene", -10, "scene"},
                                        {"technique", -26, "technique"},
                                        {"settings", -16, "settings"},
                                        {"device", -10, "device"},
                                        {"pre [s]", 7, "seconds"},
                                        {"MiB", 8, "bytes", 2, kMiB},
                                        {"first ms", 9, "first_ms"},
                                        {"light ms", 9, "light_ms"},
                                        {"colour ms", 9, "color_ms"},
                                        {"mat. ms", 9, "material_ms"},
                                        {"obj. ms", 9, "object_ms"},
                                        {"cam. ms", 9, "camera_ms"},
                                        {"nRMSE", 7, "nrmse", 3},
                                        {"-1 %", 7, "nrmse_without_worst_percent", 3},
                                        {"bias %", 7, "bias", 1, 100},
                                        {"1 bounce", 8, "one_bounce_nrmse", 3},
                                        {"bias %", 7, "one_bounce_bias", 1, 100},
                                        {"SSIM", 6, "ssim", 3},
                                        {"FLIP", 6, "flip", 3},
                                        {"leak %", 7, "leak", 2, 100},
                                        {"flick. %", 8, "flicker", 2, 100},
                                        {"cam. fl. %", 10, "camera_flicker", 2, 100},
                                        {"obj. fl. %", 10, "object_flicker", 2, 100},
                                        {"lag", 5, "lag"},
                                        {"to CPU %", 8, "cpu_difference_rms", 3, 100},
                                        {"max %", 7, "cpu_difference_max", 3, 100}};

/// The CPU, the device or both. Where there is no device, fails if it was asked for, and else says
/// so.
Result<std::vector<LightPlace>> placesOf(const TechniquesBench& o) {
    const auto on = named<MeasureOn>(kMeasureOnNames, o.relight);
    std::vector<LightPlace> places;
    if (on != MeasureOn::Gpu)
        places.push_back(placeOnCpu());
    if (on == MeasureOn::Cpu)
        return places;
    Result<LightPlace> device = placeOnDevice(o.device);
    if (device)
        places.push_back(std::move(*device));
    else if (on == MeasureOn::Auto && o.device.empty())
        logWarning("measuring on the CPU only: " + device.error().message);
    else
        return fail("--relight: " + device.error().message);
    return places;
}

/// A scene as it is measured: its file, its picture and its lights.
struct MeasuredView {
    SceneOptions scene;
    CameraOptions camera;
    std::uint32_t points = 0;
    std::string suffix; ///< tells it from the other views of the scene
};

/// Every scene in every size with every number of lights.
std::vector<MeasuredView> viewsOf(const TechniquesBench& o) {
    std::vector<glm::uvec2> sizes;
    for (const std::string& size : o.sizes)
        sizes.push_back(*pictureSize(size));
    if (sizes.empty())
        sizes.emplace_back(o.camera.width, o.camera.height);
    std::vector<MeasuredView> views;
    for (const std::string& path : o.scenes)
        for (const glm::uvec2 size : sizes)
            for (const std::uint32_t points : o.points) {
                MeasuredView& view = views.emplace_back(MeasuredView{o.common, o.camera, points});
                view.scene.scene = path;
                view.camera.width = size.x;
                view.camera.height = size.y;
                if (sizes.size() > 1)
                    view.suffix += fmt::format(", {} x {}", size.x, size.y);
                if (points > 0)
                    view.suffix += fmt::format(", {} lights", points);
                else if (o.points.size() > 1)
                    view.suffix += ", its own lights";
            }
    return views;
}

/// The columns of the printed table, wide enough to tell views and varied settings apart.
std::vector<Column> columnsFor(const TechniquesBench& o, const std::vector<MeasuredView>& views) {
    std::vector<Column> columns(std::begin(kTechniqueColumns), std::end(kTechniqueColumns));
    const auto longest = std::ranges::max_element(
        views, {}, [](const MeasuredView& view) { return view.suffix.size(); });
    if (longest != views.end())
        columns[0].width -= int(longest->suffix.size());
    if (!o.varied.empty())
        columns[2].width = -16 * int(o.varied.size() + 1);
    return columns;
}

Exit runTechniquesBench(const TechniquesBench& o) {
    const ThreadLimit threads(o.threads);
    const Result<std::vector<LightPlace>> places = placesOf(o);
    if (!places)
        return failed(places.error().message);
    SceneBenchOptions bench = o.bench;
    bench.varied = variedSettings(o.varied);
    const std::vector<MeasuredView> views = viewsOf(o);
    const std::vector<Column> columns = columnsFor(o, views);
    bench.show = [&](const Json& row) {
        if (!o.json)
            printRow(columns, row);
    };
    if (!o.json)
        printTitles(columns);
    const LeakRoom room(o.samplesPerPixel);
    Json rows = Json::array();
    std::vector<PageScene> pages;
    for (const MeasuredView& view : views) {
        Result<MeasuredScene> opened =
            openMeasured(view.scene, view.camera, o.samplesPerPixel, view.points);
        if (!opened)
            return failed(opened.error().message);
        opened->name += view.suffix;
        Result<PageScene> page = benchScene(bench, room, *places, *opened);
        if (!page)
            return failed(page.error().message);
        for (const Json& row : page->rows)
            rows.push_back(row);
        pages.push_back(std::move(*page));
    }
    const Result<std::string> html = techniquesPage(pages, room.description());
    if (!html)
        return failed(html.error().message);
    if (const Exit written = writeRows(rows, o.output, "techniques", o.json); written != Exit::Done)
        return written;
    const Result<void> written = replaceFile(o.output + "/techniques.html", *html);
    return written ? Exit::Done : failed(written.error().message);
}

} // namespace

void addTechniquesBench(Command& bench) {
    const auto o = std::make_shared<TechniquesBench>();
    o->camera.width = 160;
    o->camera.height = 90;
    Command command = bench.addCommand(
        "techniques", "Time, memory and error of all techniques on the same scenes");
    command
        .option("scenes", o->scenes,
                "Scenes (.gltf, .glb), projects (.limn), names of sample projects, or "
                "generated:SEED")
        .required();
    addLightOptions(command, o->common);
    addDynamicOption(command, o->common);
    addCameraOptions(command, o->camera);
    std::vector<std::string> names;
    for (const Technique* technique : techniques())
        names.emplace_back(technique->name);
    command
        .option("--technique", o->bench.techniques, "Techniques to measure, a list; default: all")
        .list()
        .oneOf(names);
    command
        .option("-o,--output", o->output,
                "Folder for techniques.csv, techniques.json and techniques.html")
        .required();
    command
        .option("--vary", o->varied,
                "KEY=VALUE,...: values of a setting of a technique, such as probes.count, or of "
                "bakes, such as surfels; may be repeated. Techniques that have some of these "
                "settings are measured with every combination")
        .repeatable()
        .check(variedDefect);
    command
        .option("--size", o->sizes,
                "Sizes of the pictures, WxH, a list, in place of --width and --height")
        .list()
        .check(pictureSizeDefect);
    command
        .option("--lights", o->points,
                "Numbers of point lights over the scene, in place of its own, a list; 0: its own")
        .list()
        .within(0, 4096);
    command
        .option("--relight", o->relight,
                "Where to light: cpu; gpu, a Vulkan device; both; or auto, both where there is "
                "such a device")
        .oneOf(namesIn(kMeasureOnNames));
    command.option("--device", o->device, "Part of the Vulkan device's name");
    command
        .option("--seconds", o->bench.seconds,
                "Time for the techniques of each scene, without its references [s]: settings "
                "that do not fit are skipped, and fewer updates are measured; default: no "
                "limit")
        .within(0.1, 1e6);
    command.option("--spp", o->samplesPerPixel, "Samples per pixel of all references")
        .within(4, 1 << 20);
    command
        .option("--runs", o->bench.runs,
                "Maximum number of updates of each kind; their median counts")
        .within(1, 1000);
    command.option("--threads", o->threads, "Threads to use; 0: all").within(0, 1024);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runTechniquesBench(*o); });
}

} // namespace limn
