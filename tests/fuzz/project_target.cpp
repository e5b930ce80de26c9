// SPDX-License-Identifier: MIT
// A project, beside a scene and a sky that it may name: scene.glb and sky.hdr.
#include "engine/files/project_file.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/project_files.h"

using namespace limn;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    useOneThread();
    static const std::string scenePath = scratchFile("scene.glb", projectScene());
    static const std::string skyPath = scratchFile("sky.hdr", projectSky());
    const std::string path = scratchFile("project.limn", textOf(data, size));
    if (const Result<Document> document = documentFromJson(std::string(textOf(data, size)))) {
        const Result<Document> again = documentFromJson(documentToJson(*document));
        require(again && *again == *document, "a document that was read is written and read again");
    }
    const Result<ImportedScene> scene = loadProject(path, {}, {.memory = kFuzzMemory});
    if (!scene) {
        require(scene.error().message.starts_with(path), "a message names the file");
        return 0;
    }
    for (const double seconds : {0.0, 1e5})
        exercise(flatten(scene->document, scene->assets, seconds));
    return 0;
}
