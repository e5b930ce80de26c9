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

void addEditCommand(CLI::App& app, Run& run) {
    auto options = std::make_shared<EditorAppOptions>();
    CLI::App* command = app.add_subcommand("edit", "opens the editor");
    command
        ->add_option("scene", options->scene, ".gltf, .glb or .limn file, or the name of a project")
        ->default_str("cornell");
    command->add_option_function<std::string>(
        "--size",
        [options](const std::string& text) {
            if (!parseSize(text, *options))
                throw CLI::ValidationError("--size",
                                           "not WIDTHxHEIGHT from 320x240 to 16384x16384");
        },
        "WIDTHxHEIGHT of the window [px]");
    command->add_option(
        "--stats-json", options->statsPath,
        "writes counters and the longest frame there, whenever all work is done and at the end");
    command->add_flag("--validate", options->validate,
                      "Vulkan validation; fails if there was a message");
    command
        ->add_option_function<std::string>(
            "--relight",
            [options](const std::string& name) {
                options->relightOn =
                    RelightOn(std::find(kRelightOnNames.begin(), kRelightOnNames.end(), name) -
                              kRelightOnNames.begin());
            },
            "where bounced light is worked out: cpu, gpu (the Vulkan device that draws), or auto, "
            "which is faster here")
        ->check(CLI::IsMember(
            std::vector<std::string>(kRelightOnNames.begin(), kRelightOnNames.end())));
    addImportOptions(*command, options->import);
    command->add_flag("--no-bake", options->noBake, "does not bake a scene as soon as it is open");
    command->callback([options, &run] {
        run = [options] {
            options->projectsFolder = projectsFolder();
            options->exportFolders = exportFolders();
            const Result<void> done = runEditor(*options);
            return done ? Exit::Done : failed(done.error().message);
        };
    });
}

} // namespace limn
