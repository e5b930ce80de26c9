// SPDX-License-Identifier: MIT
#include "engine/export/lightmap_file.h"

#include "engine/core/percent_encoding.h"
#include "engine/export/gltf_scene.h"
#include "engine/files/exr_image.h"
#include "engine/files/ktx2.h"
#include "engine/scene/export_settings_fields.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace limn {

namespace {

/// Fails on values that the encoding would clamp.
Result<void> checkRange(const LightmapImage& image, TextureEncoding encoding) {
    float minimum = 0, maximum = 0;
    for (const glm::vec3& v : image.rgb) {
        minimum = std::min({minimum, v.x, v.y, v.z});
        maximum = std::max({maximum, v.x, v.y, v.z});
    }
    const bool shared = encoding == TextureEncoding::Ktx2Rgb9e5;
    if (shared && minimum < 0)
        return fail("encoding: a shared exponent cannot hold the negative values of harmonics; use "
                    "half floats");
    const float limit = shared ? 65408.f : 65504.f; // also of blocks
    if (std::max(maximum, -minimum) > limit)
        return fail(fmt::format("encoding: a value of {:.6g} exceeds {}, the largest that it can "
                                "hold; use EXR or dim the lights",
                                std::max(maximum, -minimum), limit));
    return {};
}

Ktx2Format ktx2FormatOf(TextureEncoding encoding, bool harmonics) {
    switch (encoding) {
    case TextureEncoding::Ktx2Rgb9e5:
        return Ktx2Format::Rgb9e5;
    case TextureEncoding::Ktx2Bc6h:
        return harmonics ? Ktx2Format::Bc6hSigned : Ktx2Format::Bc6hUnsigned;
    default:
        return Ktx2Format::Rgba16f;
    }
}

} // namespace

const char* textureExtension(TextureEncoding encoding) {
    return encoding == TextureEncoding::Exr ? ".exr" : ".ktx2";
}

TextureEncoding encodingFor(const ExportSettings& settings, std::string_view name) {
    const bool asked = settings.encoding != TextureEncoding::Exr;
    return asked || !name.ends_with(".ktx2") ? settings.encoding : TextureEncoding::Ktx2Half;
}

Result<void> checkEncoding(const ExportSettings& settings, std::uint32_t layers) {
    if (layers > 1 && settings.encoding == TextureEncoding::Exr)
        return fail("encoding: EXR holds one layer; use KTX2 for harmonics");
    if (layers > 1 && settings.encoding == TextureEncoding::Ktx2Bc6h &&
        settings.layers == ShLayers::Volume)
        return fail("layers: no consumer reads 3D textures of blocks; use an array");
    return {};
}

Result<ExportFile> lightmapFile(const LightmapImage& image, const ExportSettings& settings,
                                const std::string& stem) {
    const std::string name = stem + textureExtension(settings.encoding);
    if (const Result<void> fits = checkEncoding(settings, image.layers); !fits)
        return tl::make_unexpected(fits.error());
    Result<std::string> bytes;
    if (settings.encoding == TextureEncoding::Exr) {
        bytes = encodeExr({image.width, image.height, image.rgb});
    } else {
        if (const Result<void> ok = checkRange(image, settings.encoding); !ok)
            return tl::make_unexpected(ok.error());
        const std::uint32_t layers = image.layers > 1 ? image.layers : 0;
        const bool volume = settings.layers == ShLayers::Volume;
        bytes = encodeKtx2({.format = ktx2FormatOf(settings.encoding, layers > 0),
                            .width = image.width,
                            .height = image.height,
                            .layers = volume ? 0 : layers,
                            .depth = volume ? layers : 0,
                            .zstd = settings.compress},
                           image.rgb);
    }
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    return ExportFile{name, std::move(*bytes)};
}

Result<std::vector<ExportFile>> lightmapFiles(const std::vector<LightmapImage>& pages,
                                              const ExportSettings& settings,
                                              const std::string& stem) {
    std::vector<ExportFile> files;
    for (const LightmapImage& page : pages) {
        Result<ExportFile> file = lightmapFile(
            page, settings, files.empty() ? stem : fmt::format("{}-{}", stem, files.size() + 1));
        if (!file)
            return tl::make_unexpected(file.error());
        files.push_back(std::move(*file));
    }
    return files;
}

Json lightmapJson(const LightmapImage& image, const ExportSettings& settings,
                  const std::vector<ExportFile>& files) {
    constexpr std::array<const char*, 3> kUnits = {"W m^-2", "W m^-2 sr^-1", "W m^-2 sr^-1"};
    constexpr std::array<const char*, 3> kEquations = {"L = albedo / pi * texel",
                                                       "L = albedo * texel", "L = texel"};
    const auto quantity = std::size_t(settings.quantity);
    const bool harmonics = image.layers > 1;
    Json json;
    if (files.size() == 1)
        json["uri"] = percentEncoded(files.front().name);
    else
        for (const ExportFile& file : files)
            json["uris"].push_back(percentEncoded(file.name));
    json.update({{"texCoord", 1},
                 {"width", image.width},
                 {"height", image.height},
                 {"firstRow", "top"},
                 {"colors", "linear Rec. 709"},
                 {"quantity", harmonics ? "harmonics" : kLightmapQuantityNames[quantity]},
                 {"unit", harmonics ? kUnits[2] : kUnits[quantity]},
                 {"outgoingRadiance", harmonics ? "L = albedo / pi * E(n)" : kEquations[quantity]},
                 {"includesDirectLight", settings.direct}});
    if (harmonics) {
        json["bands"] = image.layers == 4 ? 2 : 3;
        json["stackedAs"] = kShLayersNames[std::size_t(settings.layers)];
        json["harmonics"] = "radiance, real, orthonormal, without Condon-Shortley sign; layer "
                            "i = l (l + 1) + m";
        json["irradiance"] = "E(n) = max(0, sum over i of A_l c_i Y_i(n)), A = pi, 2 pi / 3, "
                             "pi / 4";
    }
    return json;
}

Json errorJson(const Comparison& error) {
    return {{"nrmse", error.nrmse},
            {"nrmseNoise", error.nrmseNoise},
            {"bias", error.bias},
            {"biasNoise", error.biasNoise}};
}

Json seamsJson(const SeamError& seams) {
    return {{"jump", seams.relative()}, {"metres", seams.length}};
}

} // namespace limn
