// SPDX-License-Identifier: MIT
#include "app/bench/bench_techniques.h"

#include "app/bench/leak_room.h"
#include "app/bench/live_light.h"
#include "app/bench/moving_lights.h"
#include "app/bench/techniques_page.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"

#include "engine/core/parallel.h"
#include "engine/core/replace_file.h"
#include "engine/lighting/fastest_update.h"
#include "engine/lightmap/atlas.h"
#include "engine/measure/compare.h"
#include "engine/measure/field_render.h"
#include "engine/measure/reference_set.h"
#include "engine/scene/tone_map.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

struct TechniquesBench {
    SceneOptions common; ///< lights and sky of every scene
    CameraOptions camera;
    std::vector<std::string> scenes, techniques;
    std::string output;
    std::uint32_t samplesPerPixel = 128;
    int threads = 0, runs = 9;
    bool json = false;
};

/// Settings of a technique that are measured together.
struct Variant {
    std::string name;
    TechniqueChoice choice;
    BakeSettings bake; ///< read by techniques that precompute
};

/// The settings to measure: the presets for a technique that precomputes, else its defaults and
/// a quarter to four times the default of its first setting, unless that is a switch.
std::vector<Variant> variantsOf(const Technique& technique, const BakeSettings& bake) {
    std::vector<Variant> variants;
    if (technique.precomputation) {
        for (const BakePreset& preset : kBakePresets) {
            variants.push_back({preset.name, {technique.name, {}}, bake});
            preset.applyTo(variants.back().bake);
        }
        return variants;
    }
    const TechniqueSetting* first = technique.settings.empty() ? nullptr : &technique.settings[0];
    if (!first || first->range.upper <= 1)
        return {{"defaults", {technique.name, {}}, bake}};
    for (const double factor : {0.25, 0.5, 1., 2., 4.}) {
        const double value = std::clamp(factor * first->usual, double(first->range.lower),
                                        double(first->range.upper));
        const std::string key = first->setting.key;
        variants.push_back({fmt::format("{} {:g}", key.substr(key.find('.') + 1), value),
                            {technique.name, {{key, value}}},
                            bake});
    }
    return variants;
}

/// A scene with its references.
struct Measured {
    std::string name;
    Scene scene;
    std::unique_ptr<TraceScene> trace;
    ReferenceOptions view;
    ReferenceSet one, all; ///< of one bounce, and of all
    ImageF lit;            ///< with direct light and all bounces
    MotionTruth motion;    ///< of irradiance while lights move
};

Result<Measured> openMeasured(const TechniquesBench& o, const std::string& path) {
    SceneOptions options = o.common;
    options.scene = path;
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    Measured m{.name = std::filesystem::path(path).stem().string(),
               .scene = flatten(imported->document, imported->assets)};
    const Result<Camera> camera = chooseCamera(m.scene, o.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    m.trace = std::make_unique<TraceScene>(m.scene);
    m.view = {.view = View::Irradiance,
              .camera = *camera,
              .width = o.camera.width,
              .height = o.camera.height,
              .samplesPerPixel = std::max(o.samplesPerPixel / 4, 1U)};
    m.all = *renderReferenceSet(*m.trace, m.view, progressOnStderr()); // never cancelled
    ReferenceOptions once = m.view;
    once.maxBounces = 1;
    m.one = *renderReferenceSet(*m.trace, once, progressOnStderr());
    ReferenceOptions lit = m.view;
    lit.view = View::Lit;
    lit.samplesPerPixel = o.samplesPerPixel;
    m.lit = renderReference(*m.trace, lit, progressOnStderr()).image;
    m.motion = renderMotion(*m.trace, m.view);
    endProgressLine();
    return m;
}

double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// Updates of one kind end when they have taken this long; the median is then of fewer [ms].
constexpr double kLongEnough = 4000;

double sumOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.);
}

/// Milliseconds of updates after changes of the scene.
class Updates {
public:
    Updates(const TechniquesBench& o, Lighting& lighting, const Measured& m)
        : m_options(o), m_lighting(lighting), m_measured(m) {}

    double once(const Scene& scene, const TraceScene& trace) {
        const auto start = std::chrono::steady_clock::now();
        m_report = m_lighting.update(
            {.scene = scene, .trace = &trace, .bounces = scene.relight.maxBounces}, {});
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        return took.count();
    }

    /// Median over runs with what change(scene, run) made of the scene; runs count from 1.
    template <class Change>
    double median(const Scene& standing, const Change& change) {
        std::vector<double> ms;
        for (int k = 1; k <= m_options.runs && sumOf(ms) < kLongEnough; ++k) {
            Scene scene = standing;
            change(scene, k);
            ms.push_back(once(scene, *m_measured.trace));
        }
        return medianOf(std::move(ms));
    }

    /// Median with all dynamic objects moved; null if there are none.
    Json objects(const Scene& standing) {
        if (std::ranges::none_of(standing.instances, [](const Instance& i) { return i.dynamic; }))
            return nullptr;
        std::vector<double> ms;
        for (int k = 1; k <= m_options.runs && sumOf(ms) < kLongEnough; ++k) {
            Scene scene = standing;
            moveObjects(scene, standing, k);
            const TraceScene moved(scene, *m_measured.trace);
            ms.push_back(once(scene, moved));
        }
        return medianOf(std::move(ms));
    }

    const LightingReport& last() const { return m_report; }

private:
    const TechniquesBench& m_options;
    Lighting& m_lighting;
    const Measured& m_measured;
    LightingReport m_report;
};

double bytesOf(const std::vector<LightingCounter>& counters) {
    double sum = 0;
    for (const LightingCounter& c : counters)
        sum += c.unit == CounterUnit::Bytes ? c.value : 0;
    return sum;
}

/// Exposure at which a picture's mean is middle grey [stops].
float exposureOf(const ImageF& image) {
    const double mean = meanOf(image);
    return mean > 0 ? float(std::log2(double(kMiddleGrey) / mean)) : 0;
}

/// The scene with its lights moved as in run k, or, where it has none, with a brighter sky and
/// brighter emissive surfaces.
Scene withOtherLight(const Scene& scene, int k) {
    Scene other = withMovedLights(scene, k);
    if (scene.lights.empty())
        for (Material& material : other.materials)
            material.emission *= 1 + 0.01f * float(k);
    return other;
}

/// A number for JSON, which has no infinities; null: none.
Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// A technique's light with some settings, its costs and its error.
struct Point {
    Json row;
    ImageF picture;
};

/// Adds how the light follows its lights, and how much of it leaks.
Result<void> addLiveColumns(const Measured& m, const LeakRoom& room, const Technique& technique,
                            const Variant& variant, LiveLight live, Json& row) {
    const Result<double> leak = room.leak(technique, variant.choice, variant.bake);
    if (!leak)
        return fail(fmt::format("leak, {}: {}", variant.name, leak.error().message));
    row["leak"] = finite(*leak);
    row["flicker"] = finite(live.flicker(m.motion));
    const std::optional<std::uint32_t> lag = live.lag();
    row["lag"] = lag ? Json(*lag) : Json(nullptr);
    return {};
}

Result<Point> measure(const TechniquesBench& o, const Measured& m, const LeakRoom& room,
                      const Technique& technique, const Variant& variant) {
    Scene scene = m.scene;
    scene.technique = variant.choice;
    Prepared prepared;
    LightmapLayout layout = layoutWithoutLightmap(scene);
    double seconds = 0, bytes = 0;
    if (const Precomputation* p = technique.precomputation) {
        const auto made = p->prepare(
            *m.trace, {.settings = &variant.bake, .choice = &variant.choice}, progressOnStderr());
        endProgressLine();
        if (!made)
            return fail(fmt::format("{}, {}: {}", m.name, variant.name, made.error().message));
        prepared = {*made, std::make_shared<const Scene>(scene)};
        layout = prepared.data->layout();
        const PrecomputedReport report = prepared.data->report();
        seconds = totalOf(report.seconds);
        bytes = totalOf(report.bytes);
    }
    const auto lighting = technique.light(prepared);
    Updates updates(o, *lighting, m);
    const double first = updates.once(scene, *m.trace);
    bytes += bytesOf(updates.last().counters);
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera = m.view.camera;
    options.width = m.view.width;
    options.height = m.view.height;
    ImageF picture = renderField(*m.trace, *lighting->field(), layout, options);
    const Comparison all = *compareImages(picture, m.all), one = *compareImages(picture, m.one);
    FieldRenderOptions whole = options;
    whole.view = View::Lit;
    const Comparison lit =
        *compareImages(renderField(*m.trace, *lighting->field(), layout, whole), m.lit);
    Json row = {{"scene", m.name},          {"technique", technique.label},
                {"settings", variant.name}, {"seconds", seconds},
                {"bytes", bytes},           {"first_ms", first}};
    row["light_ms"] = updates.median(scene, [&](Scene& s, int k) { s = withOtherLight(scene, k); });
    updates.once(scene, *m.trace);
    row["color_ms"] = updates.median(scene, [](Scene& s, int k) {
        for (Light& light : s.lights)
            light.color *= 1 + 0.01f * float(k);
    });
    updates.once(scene, *m.trace);
    row["material_ms"] = updates.median(scene, [](Scene& s, int k) {
        if (!s.materials.empty())
            s.materials[0].baseColor *= glm::vec4(glm::vec3(1 - 0.01f * float(k)), 1);
    });
    updates.once(scene, *m.trace);
    row["object_ms"] = updates.objects(scene);
    row["nrmse"] = all.nrmse;
    row["nrmse_without_worst_percent"] = all.nrmseMost;
    row["bias"] = all.bias;
    row["one_bounce_nrmse"] = one.nrmse;
    row["one_bounce_bias"] = one.bias;
    row["nrmse_noise"] = all.nrmseNoise;
    row["ssim"] = lit.ssim;
    row["flip"] = lit.flip;
    if (const Result<void> added =
            addLiveColumns(m, room, technique, variant,
                           {technique.light(prepared), scene, *m.trace, layout, options}, row);
        !added)
        return tl::make_unexpected(added.error());
    return Point{std::move(row), std::move(picture)};
}

constexpr Column kColumns[] = {{"scene", -10, "scene"},
                               {"technique", -26, "technique"},
                               {"settings", -16, "settings"},
                               {"pre [s]", 7, "seconds"},
                               {"MiB", 8, "bytes", 2, kMiB},
                               {"first ms", 9, "first_ms"},
                               {"light ms", 9, "light_ms"},
                               {"colour ms", 9, "color_ms"},
                               {"mat. ms", 9, "material_ms"},
                               {"obj. ms", 9, "object_ms"},
                               {"nRMSE", 7, "nrmse", 3},
                               {"-1 %", 7, "nrmse_without_worst_percent", 3},
                               {"bias %", 7, "bias", 1, 100},
                               {"1 bounce", 8, "one_bounce_nrmse", 3},
                               {"bias %", 7, "one_bounce_bias", 1, 100},
                               {"SSIM", 6, "ssim", 3},
                               {"FLIP", 6, "flip", 3},
                               {"leak %", 7, "leak", 2, 100},
                               {"flick. %", 8, "flicker", 2, 100},
                               {"lag", 5, "lag"}};

bool isWanted(const TechniquesBench& o, const Technique& technique) {
    return o.techniques.empty() || std::ranges::count(o.techniques, technique.name) > 0;
}

Result<PageScene> measureScene(const TechniquesBench& o, const LeakRoom& room,
                               const std::string& path) {
    Result<Measured> opened = openMeasured(o, path);
    if (!opened)
        return tl::make_unexpected(opened.error());
    const Measured& m = *opened;
    const ImageF truth = meanImage(m.all.first(), m.all.second());
    const float exposure = exposureOf(truth);
    PageScene page{m.name,
                   fmt::format("{} x {} pixels; standard error of a reference's pixel {:.3f} of "
                               "the mean, {:.3f} with one bounce",
                               m.view.width, m.view.height, noiseOf(m.all), noiseOf(m.one)),
                   {},
                   {{"Reference", toneMappedImage(truth, Tonemap::Aces, exposure)}}};
    for (const Technique* technique : techniques()) {
        if (!isWanted(o, *technique))
            continue;
        std::optional<Point> best;
        for (const Variant& variant : variantsOf(*technique, m.scene.bake)) {
            Result<Point> point = measure(o, m, room, *technique, variant);
            if (!point)
                return tl::make_unexpected(point.error());
            if (!o.json)
                printRow(kColumns, point->row);
            page.rows.push_back(point->row);
            if (!best || point->row["nrmse"] < best->row["nrmse"])
                best = std::move(*point);
        }
        const std::string what =
            fmt::format("{}, {}", technique->label, best->row["settings"].get<std::string>());
        page.pictures.push_back({what, toneMappedImage(best->picture, Tonemap::Aces, exposure)});
        page.pictures.push_back(
            {what + ": blue is too dark, orange too bright", errorHeatmap(best->picture, truth)});
    }
    return page;
}

Exit runTechniquesBench(const TechniquesBench& o) {
    const ThreadLimit threads(o.threads);
    if (!o.json)
        printTitles(kColumns);
    const LeakRoom room(o.samplesPerPixel);
    Json rows = Json::array();
    std::vector<PageScene> pages;
    for (const std::string& path : o.scenes) {
        Result<PageScene> page = measureScene(o, room, path);
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

void addTechniquesBench(CLI::App& bench, Run& run) {
    const auto o = std::make_shared<TechniquesBench>();
    o->camera.width = 160;
    o->camera.height = 90;
    CLI::App* command = bench.add_subcommand(
        "techniques", "Time, memory and error of all techniques on the same scenes");
    command
        ->add_option("scenes", o->scenes,
                     "Scenes (.gltf, .glb), projects (.limn), names of sample projects, or "
                     "generated:SEED")
        ->required();
    addLightOptions(*command, o->common);
    addCameraOptions(*command, o->camera);
    std::vector<std::string> names;
    for (const Technique* technique : techniques())
        names.emplace_back(technique->name);
    addList(*command, "--technique", o->techniques, "Techniques to measure, a list; default: all",
            CLI::IsMember(names));
    command
        ->add_option("-o,--output", o->output,
                     "Folder for techniques.csv, techniques.json and techniques.html")
        ->required();
    command->add_option("--spp", o->samplesPerPixel, "Samples per pixel of all references")
        ->check(CLI::Range(4, 1 << 20));
    command
        ->add_option("--runs", o->runs,
                     "Maximum number of updates of each kind; their median counts")
        ->check(CLI::Range(1, 1000));
    command->add_option("--threads", o->threads, "Threads to use; 0: all")
        ->check(CLI::Range(0, 1024));
    command->add_flag("--json", o->json, "Print one JSON object to stdout");
    command->callback([o, &run] { run = [o] { return runTechniquesBench(*o); }; });
}

} // namespace limn
