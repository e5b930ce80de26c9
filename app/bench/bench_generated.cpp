// SPDX-License-Identifier: MIT
#include "app/bench/bench_generated.h"

#include "app/bench/picture_size.h"
#include "app/commands/progress_line.h"
#include "app/commands/render_image.h"
#include "app/commands/scene_options.h"

#include "engine/gallery/gallery.h"
#include "engine/json/json.h"
#include "engine/measure/reference_set.h"
#include "engine/picture/field_render.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::uint32_t kFirstSamples = 32; ///< per pixel of a reference, before it is known how
                                            ///< many it takes

/// One generated scene, its references, and who draws it.
struct Measured {
    const GeneratedBench& options;
    std::uint64_t seed;
    GeneratedScene generated;
    Scene scene;
    TraceScene trace;
    ReferenceOptions view;
    ReferenceSet truth;

    Measured(const GeneratedBench& o, std::uint64_t s)
        : options(o), seed(s), generated(generateScene(s)),
          scene(flatten(generated.document, generated.assets)), trace(scene) {
        const glm::uvec2 size = *pictureSize(o.size);
        view.view = View::Irradiance;
        view.camera = scene.cameras.front();
        view.width = size.x;
        view.height = size.y;
        view.samplesPerPixel = std::min(kFirstSamples, o.samplesPerPixel) / 2;
    }

    /// The error of a picture. Adds samples to the references until the error is certain or the
    /// maximum is reached.
    Comparison errorOf(const ImageF& picture) {
        if (truth.samplesPerPixel == 0)
            truth = *renderReferenceSet(trace, view, progressOnStderr()); // never cancelled
        Comparison c = *compareImages(picture, truth);                    // of the same size
        while (!isSure(c) && 4 * truth.samplesPerPixel <= options.samplesPerPixel) {
            refine(truth, trace, view, progressOnStderr());
            c = *compareImages(picture, truth);
        }
        endProgressLine();
        return c;
    }
};

Json settingsOf(const BakeSettings& s) {
    return {{"surfels", s.surfels},
            {"lightmap", s.lightmapCaches},
            {"links", s.links},
            {"rays", s.rays},
            {"bands", s.bands},
            {"linker", kLinkerNames[std::size_t(s.linker)]},
            {"clustering", kClusteringNames[std::size_t(s.clustering)]},
            {"cut", kCutNames[std::size_t(s.cut)]}};
}

/// The scene rendered with the light of a bake, from one camera.
ImageF drawn(const Measured& m, const Camera& camera, const Lighting& lighting,
             const LightmapLayout& layout) {
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera = camera;
    options.width = m.view.width;
    options.height = m.view.height;
    options.samplesPerPixel = kFileSamples.perPixel; // as limn render draws
    options.nearRays = kFileSamples.nearRays;
    options.gatherRays = kFileSamples.gatherRays;
    options.emitted = lighting.emittedField(m.scene);
    return renderField(m.trace, *lighting.field(), layout, options);
}

void addErrors(Json& row, const std::string& prefix, const Comparison& c) {
    row[prefix + "nrmse"] = c.nrmse;
    row[prefix + "nrmse_without_worst_percent"] = c.nrmseTrimmed;
    row[prefix + "bias"] = c.bias;
}

/// `draw` draws with Vulkan; null if that is not requested.
Result<Json> measure(Measured& m, const BakeSettings& settings, const DrawPicture* draw) {
    const Technique& technique = precomputingTechnique(m.scene.technique);
    const auto made =
        technique.precomputation->prepare(m.trace, {.settings = &settings}, progressOnStderr());
    endProgressLine();
    if (!made)
        return fail(fmt::format("generated:{}: {}", m.seed, made.error().message));
    const Prepared prepared{*made, std::make_shared<const Scene>(m.scene)};
    const LightmapLayout& layout = prepared.data->layout();
    const PrecomputedReport report = prepared.data->report();
    const auto lighting = technique.light(prepared);
    const LightingReport lit = lighting->update(
        {.scene = m.scene, .trace = &m.trace, .bounces = m.scene.relight.maxBounces}, {});
    Json row = {{"name", fmt::format("generated:{}", m.seed)},
                {"kind", kSceneKindNames[std::size_t(m.generated.kind)]},
                {"half", m.seed % 2 == 0 ? "tuned" : "untuned"}};
    row.update(settingsOf(settings));
    const Comparison c = m.errorOf(drawn(m, m.view.camera, *lighting, layout));
    addErrors(row, "", c);
    if (draw) {
        RenderRequest request;
        request.view = View::Irradiance;
        request.camera = m.view.camera;
        request.width = m.view.width;
        request.height = m.view.height;
        request.layout = {prepared.data, &layout};
        request.prepared = prepared;
        request.relight = [&](bool) { return CpuLight{*lighting->field(), lit}; };
        request.emitted = [&] { return lighting->emittedField(m.scene); };
        const Result<RenderedImage> picture = (*draw)(m.scene, request);
        if (!picture)
            return tl::make_unexpected(picture.error());
        addErrors(row, "viewport_", m.errorOf(picture->linear));
    }
    row["leak"] = nullptr;
    if (m.generated.darkCamera) {
        const ImageF dark = drawn(m, *m.generated.darkCamera, *lighting, layout);
        row["leak"] = meanOf(dark) / meanOf(meanImage(m.truth.first(), m.truth.second()));
    }
    row["reference_spp"] = 2 * m.truth.samplesPerPixel; // of either of the two
    row["reference_noise"] = c.referenceNoise;
    row["nrmse_noise"] = c.nrmseNoise;
    row["bias_noise"] = c.biasNoise;
    row["sure"] = isSure(c);
    row["seconds"] = totalOf(report.seconds);
    row["bytes"] = std::uint64_t(totalOf(report.bytes));
    row["description"] = m.generated.description;
    return row;
}

constexpr Column kGeneratedColumns[] = {
    {"seed", -14, "name"},           {"kind", -14, "kind"},
    {"surfels", 7, "surfels"},       {"texels", 7, "lightmap"},
    {"links", 5, "links"},           {"rays", 5, "rays"},
    {"bias [%]", 8, "bias", 2, 100}, {"+-", 5, "bias_noise", 2, 100},
    {"nRMSE", 7, "nrmse", 4},        {"-1 %", 7, "nrmse_without_worst_percent", 4},
    {"+-", 6, "nrmse_noise", 4},     {"leak [%]", 8, "leak", 2, 100},
    {"spp", 5, "reference_spp"},     {"sure", -5, "sure"},
    {"bake [s]", 8, "seconds"},      {"MiB", 7, "bytes", 1, kMiB}};

/// Median, 90th percentile, between neighbours where it falls between two, and largest magnitude of
/// one number of the rows that have it.
void addDistribution(Json& to, const std::vector<const Json*>& rows, const std::string& key) {
    std::vector<double> values;
    for (const Json* row : rows)
        if (const Json& value = (*row)[key]; value.isNumber())
            values.push_back(std::abs(value.get<double>()));
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double share) -> Json {
        if (values.empty())
            return nullptr;
        const double place = share * double(values.size() - 1);
        const auto below = std::size_t(place);
        const double above = values[std::min(below + 1, values.size() - 1)];
        return values[below] + (place - double(below)) * (above - values[below]);
    };
    to[key + "_median"] = quantile(0.5);
    to[key + "_p90"] = quantile(0.9);
    to[key + "_worst"] = quantile(1);
}

Json distributionOf(const std::string& group, const Json& settings,
                    const std::vector<const Json*>& rows, bool viewport) {
    Json result = {{"group", group}, {"scenes", rows.size()}};
    result.update(settings);
    std::vector<std::string> keys = {"bias", "nrmse", "nrmse_without_worst_percent", "leak",
                                     "seconds"};
    if (viewport)
        keys.insert(keys.end(), {"viewport_bias", "viewport_nrmse"});
    for (const std::string& key : keys)
        addDistribution(result, rows, key);
    result["unsure"] = std::count_if(rows.begin(), rows.end(),
                                     [](const Json* row) { return !(*row)["sure"].get<bool>(); });
    return result;
}

constexpr Column kDistributionColumns[] = {{"group", -14, "group"},
                                           {"n", 4, "scenes"},
                                           {"unsure", 6, "unsure"},
                                           {"surfels", 7, "surfels"},
                                           {"texels", 7, "lightmap"},
                                           {"links", 5, "links"},
                                           {"rays", 5, "rays"},
                                           {"|bias| 50", 9, "bias_median", 2, 100},
                                           {"90", 6, "bias_p90", 2, 100},
                                           {"worst", 7, "bias_worst", 2, 100},
                                           {"nRMSE 50", 8, "nrmse_median", 4},
                                           {"90", 7, "nrmse_p90", 4},
                                           {"worst", 7, "nrmse_worst", 4},
                                           {"-1 % 50", 8, "nrmse_without_worst_percent_median", 4},
                                           {"leak 50", 7, "leak_median", 2, 100},
                                           {"90", 6, "leak_p90", 2, 100},
                                           {"worst", 6, "leak_worst", 2, 100},
                                           {"bake 50", 8, "seconds_median"}};

constexpr Column kViewportColumns[] = {{"viewport", -14, "group"},
                                       {"n", 4, "scenes"},
                                       {"|bias| 50", 9, "viewport_bias_median", 2, 100},
                                       {"90", 6, "viewport_bias_p90", 2, 100},
                                       {"worst", 7, "viewport_bias_worst", 2, 100},
                                       {"nRMSE 50", 8, "viewport_nrmse_median", 4},
                                       {"90", 7, "viewport_nrmse_p90", 4},
                                       {"worst", 7, "viewport_nrmse_worst", 4}};

void printGroups(std::span<const Column> columns, const Json& groups) {
    printTitles(columns);
    for (const Json& group : groups)
        printRow(columns, group);
}

/// Distributions for each group of scenes with each settings.
Json distributions(const Json& rows, const std::vector<BakeSettings>& settings, bool viewport) {
    Json result = Json::array();
    for (const BakeSettings& s : settings) {
        const Json wanted = settingsOf(s);
        const auto addGroup = [&](const std::string& group, const char* key) {
            std::vector<const Json*> members;
            for (const Json& row : rows) {
                const bool same =
                    std::ranges::all_of(wanted.members(), [&](const JsonMember& setting) {
                        return row[setting.key] == setting.value;
                    });
                if (same && (!key || row[key] == group))
                    members.push_back(&row);
            }
            if (!members.empty())
                result.push_back(distributionOf(group, wanted, members, viewport));
        };
        addGroup("all", nullptr);
        addGroup("tuned", "half");
        addGroup("untuned", "half");
        for (const std::string_view kind : kSceneKindNames)
            addGroup(std::string(kind), "kind");
    }
    return result;
}

Exit writeAll(const GeneratedBench& o, const Json& rows, const Json& groups) {
    if (!o.json) {
        fmt::print("\nEven seeds are the tuned half. Bias, leak [%]; percentiles of magnitudes.\n");
        printGroups(kDistributionColumns, groups);
        if (o.viewport)
            printGroups(kViewportColumns, groups);
    }
    if (const Exit exit = writeRows(rows, o.output, "generated", false); exit != Exit::Done)
        return exit;
    if (const Exit exit = writeRows(groups, o.output, "generated-distribution", false);
        exit != Exit::Done)
        return exit;
    if (o.json)
        fmt::print("{}\n", Json{{"rows", rows}, {"distribution", groups}}.dump());
    return Exit::Done;
}

} // namespace

void addGeneratedOptions(Command& command, GeneratedBench& o) {
    Option generated =
        command
            .option("--generated", o.scenes,
                    "Measure pictures of this many generated scenes instead, with default "
                    "settings except those given")
            .within(1, 100000);
    command.option("--first-seed", o.firstSeed, "Seed of the first generated scene")
        .needs(generated);
    command
        .option("--spp", o.samplesPerPixel,
                "Maximum samples per pixel of a reference; fewer are traced where those suffice")
        .needs(generated)
        .within(2, 1 << 20);
    command.option("--size", o.size, "Size of the pictures, WxH")
        .needs(generated)
        .check(pictureSizeDefect);
    Option viewport = command.flag("--viewport", o.viewport, "Also draw the pictures with Vulkan");
    viewport.needs(generated);
    command
        .option("--device", o.device, "Part of the Vulkan device's name; default: the best device")
        .needs(viewport);
}

Exit runGeneratedBench(const GeneratedBench& o, const std::vector<BakeSettings>& settings) {
    DrawPicture draw;
    if (o.viewport) {
        Result<DrawPicture> made = drawingOnGpu(o.device);
        if (!made)
            return failed(made.error().message);
        draw = std::move(*made);
    }
    if (!o.json)
        printTitles(kGeneratedColumns);
    Json rows = Json::array();
    for (std::uint32_t k = 0; k < o.scenes; ++k) {
        Measured measured(o, o.firstSeed + k);
        for (const BakeSettings& s : settings) {
            Result<Json> row = measure(measured, s, draw ? &draw : nullptr);
            if (!row)
                return failed(row.error().message);
            if (!o.json)
                printRow(kGeneratedColumns, *row);
            rows.push_back(std::move(*row));
        }
    }
    return writeAll(o, rows, distributions(rows, settings, o.viewport));
}

} // namespace limn
