// SPDX-License-Identifier: MIT
// A transport file. An input that begins as one is given to the runtime with its hashes put right;
// any other is a list of words to be written into the sections of a valid file. What is accepted is
// lit, and its light must be finite.
#include "engine/runtime/limn_runtime.h"
#include "tests/core/source_path.h"
#include "tests/fuzz/target.h"
#include "tests/runtime/transport_bytes.h"

#include <algorithm>
#include <cmath>

using namespace limn;

namespace {

/// A word to be written into a section.
struct Change {
    std::uint8_t section, bytes;
    std::uint16_t place; ///< in words, modulo the section's length
    std::uint32_t value;
};

std::string changed(const std::string& file, std::string_view changes) {
    static const std::vector<SectionPlace> sections = sectionsOf(file);
    std::string result = file;
    for (; changes.size() >= sizeof(Change); changes.remove_prefix(sizeof(Change))) {
        Change change;
        std::memcpy(&change, changes.data(), sizeof change);
        const SectionPlace& section = sections[change.section % sections.size()];
        const std::size_t bytes = 1 + change.bytes % 4, size = section.end - section.begin;
        if (size >= bytes)
            std::memcpy(&result[section.begin + std::size_t(change.place) * 4 % (size - bytes + 1)],
                        &change.value, bytes);
    }
    return result;
}

bool finite(const float* values, std::size_t count) {
    return std::all_of(values, values + count, [](float v) { return std::isfinite(v); });
}

void light(limnrt_scene* scene) {
    limnrt_counts counts;
    limnrt_get_counts(scene, &counts);
    limnrt_step(scene);
    limnrt_step(scene);
    const std::size_t coefficients = std::size_t(counts.bands) * counts.bands;
    require(finite(limnrt_radiosity(scene), std::size_t(4) * counts.nodes), "radiosity is finite");
    require(finite(limnrt_cache_sh(scene), 4 * coefficients * counts.caches), "light is finite");
    const std::size_t texels = std::size_t(counts.lightmap_width) * counts.lightmap_height;
    std::vector<float> rgba(4 * coefficients *
                            std::max<std::size_t>(texels, counts.caches - counts.lightmap_caches));
    limnrt_lightmap_sh(scene, rgba.data());
    limnrt_lightmap_irradiance(scene, nullptr, rgba.data());
    limnrt_grid_sh(scene, rgba.data());
    const float normal[3] = {0, 1, 0};
    float rgb[3];
    for (const float x : {-3.f, 0.f, 0.7f, 1e9f}) {
        const float position[3] = {x, 1, 0.5f};
        limnrt_sample_grid(scene, position, normal, rgb);
    }
    limnrt_light lights[2] = {};
    lights[0].kind = LIMNRT_POINT;
    lights[1].kind = LIMNRT_RECTANGLE;
    lights[1].direction[1] = -1;
    lights[1].width = lights[1].height = 1;
    for (limnrt_light& l : lights) {
        l.position[0] = l.position[1] = l.position[2] = 1;
        l.color[0] = l.strength = 1;
    }
    limnrt_set_lights(scene, lights, 2);
    for (std::uint32_t k = 0; k < counts.materials; ++k)
        require(limnrt_material_name(scene, k) != nullptr, "each material has a name");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    useOneThread();
    static const std::string room = fileBytes(sourcePath("tests/corpus/starts/room.limnrt"));
    const std::string_view input = textOf(data, size);
    std::string file = input.starts_with("LIMNRT") ? std::string(input) : changed(room, input);
    rehash(file);
    // On the heap at its very length, so that a read beyond it is seen.
    void* const bytes = std::aligned_alloc(64, (file.size() + 63) / 64 * 64);
    std::memcpy(bytes, file.data(), file.size());
    char error[64] = "";
    limnrt_options options{};
    options.max_lights = 4;
    limnrt_scene* const scene = limnrt_open(bytes, file.size(), &options, error, sizeof error);
    require(scene != nullptr || error[0] != '\0', "a refusal says why");
    if (scene)
        light(scene);
    limnrt_close(scene);
    std::free(bytes);
    return 0;
}
