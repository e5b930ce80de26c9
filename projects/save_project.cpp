// SPDX-License-Identifier: MIT
// save_project SCENE.gltf PROJECT.limn [--sky R,G,B]
// [--flipbook MATERIAL=COLUMNSxROWS@FRAMES_PER_SECOND]...: writes the project of a sample scene.
#include "engine/files/project_file.h"
#include "engine/scene/light/light_spec.h"

#include <cstdio>
#include <string>

namespace {

using namespace limn;

// MATERIAL=COLUMNSxROWS@FRAMES_PER_SECOND
Result<void> setFlipbook(Document& document, const std::string& spec) {
    const std::size_t equals = spec.find('=');
    Flipbook flipbook;
    if (equals == std::string::npos ||
        std::sscanf(spec.c_str() + equals, "=%ux%u@%f", &flipbook.columns, &flipbook.rows,
                    &flipbook.framesPerSecond) != 3)
        return fail("--flipbook " + spec + ": expected MATERIAL=COLUMNSxROWS@FRAMES_PER_SECOND");
    for (auto& [id, object] : document.objects)
        if (Material* m = std::get_if<Material>(&object); m && m->name == spec.substr(0, equals)) {
            m->emissiveFlipbook = flipbook;
            return {};
        }
    return fail("--flipbook " + spec + ": there is no such material");
}

Result<void> saveSample(int argc, char** argv) {
    Result<ImportedScene> scene = importGltf(argv[1]);
    if (!scene)
        return tl::make_unexpected(scene.error());
    Document& document = scene->document;
    Sky sky = singleton<Sky>(document);
    const BakeSettings bake = singleton<BakeSettings>(document);
    for (int i = 3; i + 1 < argc; i += 2) {
        const std::string flag = argv[i];
        if (flag == "--sky") {
            const Result<Sky> parsed = parseSky(argv[i + 1]);
            if (!parsed)
                return tl::make_unexpected(parsed.error());
            sky = *parsed;
        } else if (flag == "--flipbook") {
            if (const Result<void> set = setFlipbook(document, argv[i + 1]); !set)
                return tl::make_unexpected(set.error());
        } else {
            return fail("unknown flag " + flag);
        }
    }
    std::erase_if(document.objects, [](const auto& object) {
        return std::holds_alternative<Sky>(object.second) ||
               std::holds_alternative<BakeSettings>(object.second);
    });
    addObject(document, sky);
    addObject(document, bake);
    return saveProject(argv[2], document);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3 || argc % 2 == 0) {
        std::fputs("usage: save_project SCENE.gltf PROJECT.limn [--sky R,G,B] "
                   "[--flipbook MATERIAL=COLUMNSxROWS@FRAMES_PER_SECOND]\n",
                   stderr);
        return 2;
    }
    if (const Result<void> saved = saveSample(argc, argv); !saved) {
        std::fprintf(stderr, "save_project: %s\n", saved.error().message.c_str());
        return 1;
    }
}
