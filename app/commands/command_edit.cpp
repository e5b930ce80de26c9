// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/scene_options.h"
#include "app/editor/editor_app.h"
#include "app/resources.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace limn {

static bool parseSize(const std::string& text, EditorAppOptions& options) {
    char end = 0;
    return std::sscanf(text.c_str(), "%ux%u%c", &options.width, &options.height, &end) == 2 &&
           options.width >= 320 && options.height >= 240 && options.width <= 16384 &&
           options.height <= 16384;
}

void addEditCommand(Command& app) {
    auto options = std::make_shared<EditorAppOptions>();
    Command command = app.addCommand("edit", "Open the editor");
    command
        .option("scene", options->scene,
                "Scene (.gltf, .glb), project (.limn), or name of a sample project")
        .showDefault("cornell");
    command
        .option(
            "--size", [options](const std::string& text) { parseSize(text, *options); },
            "Size of the window, WIDTHxHEIGHT [pixels]")
        .check([](const std::string& text) {
            EditorAppOptions scratch;
            return parseSize(text, scratch) ? "" : "not WIDTHxHEIGHT from 320x240 to 16384x16384";
        });
    command.option(
        "--stats-json", options->statsPath,
        "File for counters and the longest frame, written whenever all work is done and on exit");
    command.flag("--validate", options->validate,
                 "Enable Vulkan validation; fail if it reports a message");
    command
        .option(
            "--relight",
            [options](const std::string& name) {
                options->relightOn =
                    RelightOn(std::find(kRelightOnNames.begin(), kRelightOnNames.end(), name) -
                              kRelightOnNames.begin());
            },
            "Where bounced light is computed: cpu, gpu (the Vulkan device that draws), or auto, "
            "whichever is faster on this machine")
        .oneOf(std::vector<std::string>(kRelightOnNames.begin(), kRelightOnNames.end()));
    addImportOptions(command, options->import);
    addTimeOption(command, options->import);
    command.flag("--no-bake", options->noBake, "Do not bake a scene as soon as it is opened");
    command.onRun([options] {
        options->projectsFolder = projectsFolder();
        options->exportFolders = exportFolders();
        const Result<void> done = runEditor(*options);
        return done ? Exit::Done : failed(done.error().message);
    });
}

} // namespace limn
