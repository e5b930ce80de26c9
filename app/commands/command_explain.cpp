// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/light_on_cpu.h"
#include "app/commands/relight_options.h"
#include "app/commands/scene_options.h"
#include "app/commands/technique_options.h"

#include "engine/json/json.h"
#include "engine/math/luminance.h"
#include "engine/picture/explain_pixel.h"
#include "engine/scene/surface/reflection_lobe.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

struct ExplainCommand {
    SceneOptions scene;
    CameraOptions camera;
    TechniqueOptions technique;
    std::string bake, light = "radiance";
    std::vector<std::uint32_t> pick;
    std::vector<std::string> mute;
    std::uint32_t rows = 8;
    GivenSettings relighting; ///< instead of the document's
    bool json = false;
};

std::uint32_t depthOf(const std::vector<LightRow>& rows, const LightRow& row) {
    return row.parent == LightRow::kNone ? 0 : 1 + depthOf(rows, rows[row.parent]);
}

/// "light:3", as --mute names lights and surfaces, or the kind alone.
std::string nameOfRow(const LightRow& row) {
    return row.index == LightRow::kNone ? std::string(nameOf(row.kind))
                                        : fmt::format("{}:{}", nameOf(row.kind), row.index);
}

/// Reads the --mute options.
Result<Muted> mutedOf(const std::vector<std::string>& names, const Scene& scene) {
    Muted muted;
    for (const std::string& name : names) {
        const std::size_t colon = name.find(':');
        const std::string kind = name.substr(0, colon);
        const std::optional<double> number =
            colon != std::string::npos ? numberOf(name.substr(colon + 1)) : std::nullopt;
        const bool numbered =
            number && *number >= 0 && *number < 1e9 && *number == std::floor(*number);
        const auto index = numbered ? std::uint32_t(*number) : 0;
        if (name == nameOf(LightRowKind::Sky))
            muted.sky = true;
        else if (kind == nameOf(LightRowKind::Light) && numbered && index < scene.lights.size())
            muted.lights.push_back(index);
        else if (kind == nameOf(LightRowKind::Surface) && numbered &&
                 index < scene.instances.size())
            muted.surfaces.push_back(index);
        else
            return fail(
                fmt::format("--mute: \"{}\" is not sky, light:N or surface:N of the tables", name));
    }
    return muted;
}

void printTable(const char* title, const std::vector<LightRow>& rows, glm::vec3 total) {
    fmt::print("\n{:<52} {:>8}  {:>10} {:>10} {:>10}\n", title, "share", "red", "green", "blue");
    for (const LightRow& row : rows) {
        const std::string label = std::string(2 * depthOf(rows, row), ' ') + row.label;
        fmt::print("{:<52} {:>7.2f}%  {:>10.4g} {:>10.4g} {:>10.4g}  {}\n", label,
                   100 * shareOf(row.value, total), row.value.x, row.value.y, row.value.z,
                   row.kind == LightRowKind::Group ? "" : nameOfRow(row));
    }
}

Json rgbJson(glm::vec3 rgb) {
    return {rgb.x, rgb.y, rgb.z};
}

Json tableJson(const std::vector<LightRow>& rows, glm::vec3 total) {
    auto json = Json::array();
    for (const LightRow& row : rows) {
        Json r = {{"kind", nameOf(row.kind)}, {"label", row.label}};
        if (row.index != LightRow::kNone)
            r["index"] = row.index;
        r["parent"] = row.parent == LightRow::kNone ? Json() : Json(row.parent);
        r["value"] = rgbJson(row.value);
        r["luminance"] = luminance(glm::dvec3(row.value));
        r["share"] = shareOf(row.value, total);
        json.push_back(std::move(r));
    }
    return json;
}

void printJson(const ExplainCommand& options, const PixelExplanation& e,
               const std::optional<glm::vec3>& without, PixelLight light, double ms) {
    Json json = {{"pick", options.pick},
                 {"width", options.camera.width},
                 {"height", options.camera.height},
                 {"light", options.light},
                 {"unit", unitOf(light)},
                 {"total", rgbJson(e.total)},
                 {"luminance", luminance(glm::dvec3(e.total))},
                 {"objects", e.seen},
                 {"bounces", e.tables.bounces},
                 {"ms", ms},
                 {"by_origin", tableJson(e.tables.byOrigin, e.total)},
                 {"by_sender", tableJson(e.tables.bySender, e.total)}};
    if (without)
        json["without"] = {{"muted", options.mute}, {"value", rgbJson(*without)}};
    fmt::print("{}\n", json.dump());
}

Exit runExplain(const ExplainCommand& options) {
    using Clock = std::chrono::steady_clock;
    if (options.pick[0] >= options.camera.width || options.pick[1] >= options.camera.height)
        return failed(fmt::format("--pick: {},{} is not in a picture of {} x {} pixels",
                                  options.pick[0], options.pick[1], options.camera.width,
                                  options.camera.height));
    const Result<ImportedScene> imported = openScene(options.scene);
    if (!imported)
        return failed(imported.error().message);
    Scene scene = flatten(imported->document, imported->assets, options.scene.seconds);
    applyRelightOptions(options.relighting, scene.relight);
    if (const Result<void> chosen = chooseTechnique(options.technique, scene.technique); !chosen)
        return failed(chosen.error().message);
    const Result<Camera> camera = chooseCamera(scene, options.camera);
    if (!camera)
        return failed(camera.error().message);
    const Viewpoint view = viewpointOf(*camera, {options.camera.width, options.camera.height});
    const Result<ConvergedLight> lit =
        lightOnCpu(options.scene, options.bake, std::move(scene), LitFor::Pictures, &view);
    if (!lit)
        return failed(fmt::format("{}: {}", options.scene.scene, lit.error().message));
    const Result<Muted> muted = mutedOf(options.mute, *lit->scene);
    if (!muted)
        return failed(muted.error().message);
    const PixelLight light =
        options.light == "radiance" ? PixelLight::Radiance : PixelLight::Irradiance;
    const PixelQuestion question{.camera = *camera,
                                 .width = options.camera.width,
                                 .height = options.camera.height,
                                 .x = options.pick[0],
                                 .y = options.pick[1],
                                 .light = light,
                                 .samples = kFileSamples.perPixel,
                                 .nearRays = kFileSamples.nearRays,
                                 .gatherRays = kFileSamples.gatherRays};
    reflectionTable(); // a process makes it once, the editor with its first picture
    const Clock::time_point start = Clock::now();
    const PixelExplanation e = explainPixel(*lit, question, {.rows = options.rows});
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    const std::optional<glm::vec3> without =
        options.mute.empty() ? std::nullopt : std::optional(lightWithout(*lit, question, *muted));
    if (options.json) {
        printJson(options, e, without, light, ms);
        return Exit::Done;
    }
    fmt::print("{},{}: {} {:.4g} {:.4g} {:.4g} {}, {} bounces followed, {:.0f} ms\n",
               options.pick[0], options.pick[1], options.light, e.total.x, e.total.y, e.total.z,
               unitOf(light), e.tables.bounces, ms);
    if (without)
        fmt::print("Without {}: {:.4g} {:.4g} {:.4g}\n", fmt::join(options.mute, ", "), without->x,
                   without->y, without->z);
    printTable("By origin, over all bounces", e.tables.byOrigin, e.total);
    printTable("By what sends it to here", e.tables.bySender, e.total);
    return Exit::Done;
}

} // namespace

void addExplainCommand(Command& app) {
    const auto options = std::make_shared<ExplainCommand>();
    Command command = app.addCommand(
        "explain", "Says where the light of a pixel comes from, in tables that sum to all of it");
    addSceneOptions(command, options->scene);
    addTimeOption(command, options->scene);
    addCameraOptions(command, options->camera);
    command
        .option("--pick", options->pick,
                "X,Y of the pixel in a picture of --width and --height; 0,0 is the upper left")
        .list(2)
        .required();
    command.option("--bake", options->bake,
                   ".limnbake of this scene; without it, one is made in memory if needed");
    addTechniqueOptions(command, options->technique);
    command
        .option("--quantity", options->light,
                "radiance that reaches the eye, as limn render --device cpu shows it, or "
                "irradiance that arrives at what the pixel shows")
        .oneOf({"radiance", "irradiance"});
    command.option("--mute", options->mute,
                   "sky, light:N or surface:N, as the tables name it: also says what the "
                   "pixel would be without that light, or were that surface black; may be "
                   "repeated");
    command
        .option("--rows", options->rows,
                "number of objects, of clusters of each and of surfels of each cluster that "
                "are listed; one row sums up the others")
        .within(1, 1 << 20);
    addRelightOptions(command, options->relighting);
    command.flag("--json", options->json, "one JSON object on stdout");
    command.onRun([options] { return runExplain(*options); });
}

} // namespace limn
