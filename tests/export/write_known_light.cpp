// SPDX-License-Identifier: MIT
// write_known_light FOLDER: exports scenes in known light by every format, for ./check --export.
// FOLDER/probe-0 … probe-8 are lit by a harmonic each, FOLDER/linear by a grid that is linear in
// the position.
#include "engine/export/export_table.h"
#include "tests/export/known_light.h"

#include <cstdio>
#include <filesystem>
#include <string>

using namespace limn;

namespace {

std::array<glm::vec3, 9> linearLight(glm::vec3 p) {
    const float y0 = std::sqrt(1 / (4 * std::numbers::pi_v<float>));
    const std::array<float, 9> c = {1 / y0 + 0.1f * p.x,
                                    0.05f * p.y,
                                    0.4f + 0.05f * p.z,
                                    0.3f - 0.02f * p.x,
                                    0.1f,
                                    -0.1f,
                                    0.15f,
                                    0.02f * p.y,
                                    -0.12f};
    std::array<glm::vec3, 9> colors;
    for (std::size_t i = 0; i < 9; ++i)
        colors[i] = c[i] * glm::vec3(1, 0.5f, 2);
    return colors;
}

bool write(const KnownLight& light, const std::string& folder, const ExportFormat& format,
           const std::string& stem, ExportSettings settings) {
    settings.quality = LightmapQuality::Draft; // the light that the field has
    const std::string extension =
        format.extensions.empty() ? "" : std::string(format.extensions.front());
    const auto files = format.write(light.view(), settings, stem + extension, {});
    const Result<void> done = files ? writeExport(folder + "/" + stem + extension, format, *files)
                                    : Result<void>(tl::make_unexpected(files.error()));
    if (!done)
        std::fprintf(stderr, "%s: %s\n", format.name, done.error().message.c_str());
    return done.has_value();
}

bool writeAll(const KnownLight& light, const std::string& folder) {
    bool ok = true;
    for (const ExportFormat* format : formatsOfLight()) {
        const std::string name = format->name;
        ok = write(light, folder, *format, name, {}) && ok;
        if (name == "godot")
            ok = write(light, folder, *format, name + "-directional", {.bands = 2}) && ok;
        if (name == "babylon")
            ok = write(light, folder, *format, name + "-radiance",
                       {.quantity = LightmapQuantity::Radiance}) &&
                 ok;
        if (name == "three" || name == "babylon")
            ok = write(light, folder, *format, name + "-packed",
                       {.quantize = true, .meshopt = true}) &&
                 ok;
        if (name != "three")
            continue;
        for (const auto& [suffix, encoding, zstd] :
             {std::tuple("half", TextureEncoding::Ktx2Half, false),
              std::tuple("half-zstd", TextureEncoding::Ktx2Half, true),
              std::tuple("rgb9e5", TextureEncoding::Ktx2Rgb9e5, false)})
            ok = write(light, folder, *format, name + "-" + suffix,
                       {.encoding = encoding, .compress = zstd}) &&
                 ok;
    }
    return ok;
}

/// Lightmaps of harmonics, each of which is the same everywhere.
bool writeHarmonics(KnownLight& light, const std::string& folder, std::size_t probe) {
    light.setLightmap(KnownLight::probe(probe));
    bool ok = true;
    for (const std::uint32_t bands : {2U, 3U})
        ok = write(light, folder, *findExportFormat("three"), "three-sh" + std::to_string(bands),
                   {.bands = bands}) &&
             ok;
    return ok;
}

} // namespace

int main(int count, char** arguments) {
    if (count != 2)
        return 2;
    const std::string folder = arguments[1];
    bool ok = true;
    for (std::size_t i = 0; i < 9; ++i) {
        KnownLight light([i](glm::vec3) { return KnownLight::probe(i); });
        const std::string probe = folder + "/probe-" + std::to_string(i);
        ok = writeAll(light, probe) && ok;
        ok = writeHarmonics(light, probe, i) && ok;
    }
    return writeAll(KnownLight(linearLight), folder + "/linear") && ok ? 0 : 1;
}
