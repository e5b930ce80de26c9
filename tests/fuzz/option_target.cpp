// SPDX-License-Identifier: MIT
// The command line of a bake, one argument a line, on a fixed scene; an input that begins as JSON
// is the file of remembered relighting times.
#include "app/commands/bake_options.h"
#include "app/commands/scene_options.h"
#include "engine/files/relight_choice.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/project_files.h"

using namespace limn;

namespace {

void remember(std::string_view input) {
    const std::string path = scratchFile("relight.json", input);
    if (const auto times = rememberedRelightTimes(path, "k"))
        require(times->cpuMs > 0 && times->gpuMs > 0, "remembered times are numbers");
    const RelightTimes ours{1, 2};
    if (rememberRelightTimes(path, "k", ours))
        require(rememberedRelightTimes(path, "k") == ours, "what is remembered is found again");
}

void runCommand(std::string_view input) {
    Command app("limn", "");
    SceneOptions scene;
    CameraOptions camera;
    BakeOptions bake;
    addSceneOptions(app, scene);
    addTimeOption(app, scene);
    addCameraOptions(app, camera);
    addBakeOptions(app, bake);
    std::vector<std::string> arguments;
    for (std::size_t begin = 0; begin <= input.size();) {
        const std::size_t end = std::min(input.find('\n', begin), input.size());
        arguments.emplace_back(input.substr(begin, end - begin));
        begin = end + 1;
    }
    if (app.parse(arguments).status != Exit::Done)
        return;
    static const std::string path = scratchFile("options.glb", projectScene());
    scene.scene = path;
    scene.import.memory = kFuzzMemory;
    const Result<ImportedScene> opened = openScene(scene);
    if (!opened)
        return;
    BakeSettings settings;
    applyBakeOptions(bake, settings);
    const Scene flat = flatten(opened->document, opened->assets, scene.seconds);
    if (const Result<Camera> chosen = chooseCamera(flat, camera)) {
        const glm::vec3 d =
            rayDirection(*chosen, float(camera.width) / float(camera.height), 0.5f, -0.5f);
        require(std::isfinite(d.x + d.y + d.z), "a camera's ray has a direction");
    }
    exercise(flat);
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    useOneThread();
    const std::string_view input = textOf(data, size);
    if (input.starts_with('{'))
        remember(input);
    else
        runCommand(input);
    return 0;
}
