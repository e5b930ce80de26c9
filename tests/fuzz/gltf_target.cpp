// SPDX-License-Identifier: MIT
// A glTF, as text or binary, imported, baked and lit.
#include "engine/gltf/gltf_import.h"
#include "tests/fuzz/exercise.h"

using namespace limn;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    useOneThread();
    const std::string path = scratchFile("scene.gltf", textOf(data, size));
    ImportOptions options{.memory = kFuzzMemory};
    if (size % 2 == 1)
        options.seconds = 0.3;
    const Result<ImportedScene> scene = importGltf(path, {}, options);
    if (!scene) {
        require(scene.error().message.starts_with(path + ": "), "a message names the file");
        return 0;
    }
    exercise(flatten(scene->document, scene->assets));
    return 0;
}
