// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/light_on_cpu.h"
#include "app/commands/output_file.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/commands/technique_options.h"

#include "engine/files/project_file.h"
#include "engine/json/json.h"
#include "engine/picture/solve_strengths.h"
#include "engine/scene/light/photometry.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

struct SolveCommand {
    SceneOptions scene;
    CameraOptions camera;
    TechniqueOptions technique;
    std::string bake, quantity = "irradiance", output;
    std::vector<std::string> goals;
    std::vector<std::uint32_t> lights; ///< empty: all
    bool json = false;
};

constexpr const char* kGoalForm = "X,Y=LUMINANCE, a pixel of the picture and a number above 0";

std::string_view unitOf(const Light& light) {
    return nameOf(unitsOf(light.kind).front());
}

/// Reads the --goal options.
Result<std::vector<StrengthGoal>> goalsOf(const SolveCommand& command, const Camera& camera) {
    std::vector<StrengthGoal> goals;
    for (const std::string& text : command.goals) {
        const std::size_t comma = text.find(','), equals = text.find('=');
        if (comma == std::string::npos || equals == std::string::npos || equals < comma)
            return fail(fmt::format("--goal: \"{}\" is not {}", text, kGoalForm));
        const auto x = numberOf(text.substr(0, comma)),
                   y = numberOf(text.substr(comma + 1, equals - comma - 1)),
                   luminance = numberOf(text.substr(equals + 1));
        const auto isPixel = [](const std::optional<double>& v, std::uint32_t size) {
            return v && *v >= 0 && *v < size && *v == std::floor(*v);
        };
        if (!isPixel(x, command.camera.width) || !isPixel(y, command.camera.height) || !luminance ||
            !(*luminance > 0 && std::isfinite(*luminance)))
            return fail(fmt::format("--goal: \"{}\" is not {} of {} x {} pixels", text, kGoalForm,
                                    command.camera.width, command.camera.height));
        goals.push_back({{.camera = camera,
                          .width = command.camera.width,
                          .height = command.camera.height,
                          .x = std::uint32_t(*x),
                          .y = std::uint32_t(*y),
                          .light = command.quantity == "irradiance" ? PixelLight::Irradiance
                                                                    : PixelLight::Radiance,
                          .samples = kFileSamples.perPixel,
                          .nearRays = kFileSamples.nearRays,
                          .gatherRays = kFileSamples.gatherRays},
                         *luminance});
    }
    return goals;
}

/// The lights that may change.
Result<std::vector<std::uint32_t>> lightsOf(const SolveCommand& command, const Scene& scene) {
    std::vector<std::uint32_t> lights = command.lights;
    if (lights.empty()) {
        lights.resize(scene.lights.size());
        std::iota(lights.begin(), lights.end(), 0U);
    }
    std::ranges::sort(lights);
    lights.erase(std::ranges::unique(lights).begin(), lights.end());
    if (!lights.empty() && lights.back() >= scene.lights.size())
        return fail(fmt::format("--lights: there is no light {}; the scene has {}", lights.back(),
                                scene.lights.size()));
    return lights;
}

void print(const SolvedStrengths& solved, const std::vector<StrengthGoal>& goals,
           const Scene& scene) {
    fmt::print("{:<40} {:>12} {:>12}  {:<4} {:>9}\n", "Light", "strength", "solved", "unit",
               "factor");
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
        fmt::print("{:<40} {:>12.5g} {:>12.5g}  {:<4} {:>9.4g}\n",
                   fmt::format("{} {}", l, scene.lights[l].name), scene.lights[l].strength,
                   scene.lights[l].strength * solved.factor[l], unitOf(scene.lights[l]),
                   solved.factor[l]);
    fmt::print("\n{:<40} {:>12} {:>12} {:>12}\n", "Luminance at", "now", "solved", "goal");
    for (std::size_t g = 0; g < goals.size(); ++g)
        fmt::print("{:<40} {:>12.5g} {:>12.5g} {:>12.5g}\n",
                   fmt::format("{},{}", goals[g].question.x, goals[g].question.y),
                   solved.goals[g].before, solved.goals[g].after, goals[g].luminance);
}

void printJson(const SolveCommand& command, const SolvedStrengths& solved,
               const std::vector<StrengthGoal>& goals, const Scene& scene) {
    auto lights = Json::array(), pixels = Json::array();
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
        lights.push_back({{"name", scene.lights[l].name},
                          {"unit", unitOf(scene.lights[l])},
                          {"strength", scene.lights[l].strength},
                          {"solved", scene.lights[l].strength * solved.factor[l]},
                          {"factor", solved.factor[l]}});
    for (std::size_t g = 0; g < goals.size(); ++g)
        pixels.push_back({{"pixel", {goals[g].question.x, goals[g].question.y}},
                          {"goal", goals[g].luminance},
                          {"before", solved.goals[g].before},
                          {"after", solved.goals[g].after}});
    fmt::print("{}\n",
               Json{{"quantity", command.quantity}, {"lights", lights}, {"goals", pixels}}.dump());
}

/// Writes the project with the solved strengths.
Result<void> writeSolved(const std::string& path, Document document,
                         const SolvedStrengths& solved) {
    std::size_t l = 0; // in the order of Scene::lights
    for (auto& [id, object] : document.objects)
        if (Light* light = std::get_if<Light>(&object))
            light->strength = float(double(light->strength) * solved.factor[l++]);
    return saveProject(path, document);
}

Exit runSolve(const SolveCommand& command) {
    if (!command.output.empty())
        if (const Result<void> writable = checkOutputFile(command.output, {".limn"}); !writable)
            return failed(writable.error().message);
    const Result<ImportedScene> imported = openScene(command.scene);
    if (!imported)
        return failed(imported.error().message);
    Scene scene = flatten(imported->document, imported->assets, command.scene.seconds);
    if (const Result<void> chosen = chooseTechnique(command.technique, scene.technique); !chosen)
        return failed(chosen.error().message);
    const Result<Camera> camera = chooseCamera(scene, command.camera);
    if (!camera)
        return failed(camera.error().message);
    const Result<std::vector<StrengthGoal>> goals = goalsOf(command, *camera);
    if (!goals)
        return failed(goals.error().message);
    const Result<std::vector<std::uint32_t>> lights = lightsOf(command, scene);
    if (!lights)
        return failed(lights.error().message);
    const Viewpoint view = viewpointOf(*camera, {command.camera.width, command.camera.height});
    const Result<ConvergedLight> lit =
        lightOnCpu(command.scene, command.bake, std::move(scene), LitFor::Pictures, &view);
    if (!lit)
        return failed(fmt::format("{}: {}", command.scene.scene, lit.error().message));
    const Result<SolvedStrengths> solved = solveStrengths(
        *lit, *findTechnique(lit->scene->technique.technique), *goals, *lights, progressOnStderr());
    endProgressLine();
    if (!solved)
        return failed(fmt::format("{}: {}", command.scene.scene, solved.error().message));
    if (command.json)
        printJson(command, *solved, *goals, *lit->scene);
    else
        print(*solved, *goals, *lit->scene);
    if (command.output.empty())
        return Exit::Done;
    const Result<void> written = writeSolved(command.output, imported->document, *solved);
    return written ? Exit::Done : failed(written.error().message);
}

} // namespace

void addSolveCommand(Command& app) {
    const auto command = std::make_shared<SolveCommand>();
    Command sub = app.addCommand(
        "solve", "Find the strengths of lights that give pixels the light they are to have");
    addSceneOptions(sub, command->scene);
    addTimeOption(sub, command->scene);
    addCameraOptions(sub, command->camera);
    sub.option("--goal", command->goals,
               "X,Y=LUMINANCE of a pixel in a picture of --width and --height, all bounces "
               "included; 0,0 is the upper left; may be repeated")
        .required();
    sub.option("--lights", command->lights,
               "Numbers of the lights that may change, as limn explain names them; default: all")
        .list();
    sub.option("--quantity", command->quantity,
               "irradiance that arrives at what the pixel shows [W m^-2], or radiance that reaches "
               "the eye [W m^-2 sr^-1]")
        .oneOf({"irradiance", "radiance"});
    sub.option("--bake", command->bake,
               ".limnbake of this scene; without it, one is made in memory if needed");
    addTechniqueOptions(sub, command->technique);
    sub.option("-o,--output", command->output, "Project to write, .limn, with the strengths");
    sub.flag("--json", command->json, "Print one JSON object to stdout");
    sub.onRun([command] { return runSolve(*command); });
}

} // namespace limn
