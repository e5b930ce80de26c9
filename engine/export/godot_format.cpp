// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/core/base64.h"
#include "engine/export/engine_scene.h"
#include "engine/export/exported_lightmap.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/godot_probes.h"
#include "engine/export/lightmap_image.h"
#include "engine/export/panorama.h"
#include "engine/export/reflection_places.h"
#include "engine/math/packing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace limn {

namespace godot_format {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};
constexpr std::uint32_t kRoomWidth = 256; ///< of what metal reflects [pixels]
constexpr std::array<std::string_view, 8> kSettings = {
    "quality", "texels", "texelsPerMetre", "keepTriangles", "bands", "direct", "detail", "maxSize"};

ExportSettings ownSettings(ExportSettings settings) {
    settings.bands = std::min(settings.bands, 2U); // its directional lightmaps have two
    settings.quantity =
        settings.bands > 1 ? LightmapQuantity::Irradiance : LightmapQuantity::IrradianceOverPi;
    return settings;
}

void putHalf(std::string& out, float v) {
    const std::uint16_t half = floatToHalf(std::clamp(v, -65504.f, 65504.f));
    out += char(half);
    out += char(half >> 8);
}

/// Texels of the layers of Godot's lightmap, RGBA in half floats.
std::vector<std::string> layersOf(const LightmapImage& image) {
    const std::size_t texels = std::size_t(image.width) * image.height;
    std::vector<std::string> layers(image.layers);
    for (std::size_t t = 0; t < texels; ++t) {
        std::array<glm::vec3, 4> values{};
        for (std::size_t l = 0; l < image.layers; ++l)
            values[l] = image.rgb[l * texels + t];
        if (image.layers == 4)
            values = godotDirectional(values);
        for (std::size_t l = 0; l < image.layers; ++l) {
            for (int c = 0; c < 3; ++c)
                putHalf(layers[l], values[l][c]);
            putHalf(layers[l], 1);
        }
    }
    return layers;
}

/// "Name(1, 2, 3)"
template <class Numbers>
void putArray(std::string& out, const char* type, const Numbers& numbers) {
    out += type;
    out += '(';
    bool first = true;
    for (const auto& v : numbers) {
        if (!std::exchange(first, false))
            out += ", ";
        fmt::format_to(std::back_inserter(out), "{}", v);
    }
    out += ')';
}

void putProbes(std::string& out, const GodotProbes& probes) {
    std::vector<float> points, colors;
    std::vector<std::int32_t> corners, tree;
    for (const glm::vec3& p : probes.points)
        points.insert(points.end(), {p.x, p.y, p.z});
    for (const Sh3& sh : probes.harmonics)
        for (const glm::vec3& c : sh)
            colors.insert(colors.end(), {c.x, c.y, c.z, 1.f});
    for (const auto& t : probes.tetrahedra)
        for (const std::uint32_t p : t)
            corners.push_back(std::int32_t(p));
    for (const GodotProbes::Node& node : probes.nodes) {
        for (const float v : node.plane)
            tree.push_back(std::bit_cast<std::int32_t>(v));
        tree.insert(tree.end(), {node.over, node.under});
    }
    const glm::vec3 l = probes.lower, s = probes.upper - probes.lower;
    out +=
        fmt::format("probe_data = {{\n\"baked_exposure\": 1.0,\n\"bounds\": AABB({}, {}, {}, {}, "
                    "{}, {}),\n\"interior\": false,\n\"bsp\": ",
                    l.x, l.y, l.z, s.x, s.y, s.z);
    putArray(out, "PackedInt32Array", tree);
    out += ",\n\"points\": ";
    putArray(out, "PackedVector3Array", points);
    out += ",\n\"sh\": ";
    putArray(out, "PackedColorArray", colors);
    out += ",\n\"tetrahedra\": ";
    putArray(out, "PackedInt32Array", corners);
    out += "\n}\n";
}

/// Shows the sky, and lets what metal reflects be the room. The Compatibility renderer takes what a
/// sky's shader returns for sRGB and makes it linear by a polynomial, of which this finds the root
/// by Newton's method.
constexpr const char* kSkyShader = R"(shader_type sky;
uniform sampler2D panorama : filter_linear, repeat_enable, hint_default_black;
uniform sampler2D room : filter_linear, repeat_enable;
void sky() {
	vec3 c = AT_CUBEMAP_PASS ? texture(room, SKY_COORDS).rgb : texture(panorama, SKY_COORDS).rgb;
#ifdef RENDERER_COMPATIBILITY
#if CURRENT_RENDERER == RENDERER_COMPATIBILITY
	vec3 x = 1.055 * pow(c, vec3(0.41667));
	for (int k = 0; k < 4; ++k)
		x -= (x * (x * (x * 0.305306011 + 0.682171111) + 0.012522878) - c) / (x * (x * 0.915918033 + 1.364342222) + 0.012522878);
	c = x;
#endif
#endif
	COLOR = c;
}
)";

/// An image in half floats.
std::string imageResource(const std::string& id, const std::string& texels, std::uint32_t width,
                          std::uint32_t height) {
    return fmt::format("[sub_resource type=\"Image\" id=\"{}\"]\ndata = {{\n\"data\": "
                       "PackedByteArray(\"{}\"),\n\"format\": \"RGBAHalf\",\n\"height\": {},\n"
                       "\"mipmaps\": false,\n\"width\": {}\n}}\n\n",
                       id, base64(texels), height, width);
}

/// The texels as Godot wants them: its panoramas begin where ours have their first quarter.
std::string panoramaTexels(const ImageF& image) {
    std::string texels;
    for (std::size_t pixel = 0; pixel < image.rgb.size(); ++pixel) {
        const std::size_t row = pixel / image.width;
        const std::size_t column = (pixel + image.width / 4) % image.width;
        for (int c = 0; c < 3; ++c)
            putHalf(texels, image.rgb[row * image.width + column][c]);
        putHalf(texels, 1);
    }
    return texels;
}

std::string textureResource(const std::string& id, const ImageF& image) {
    return imageResource(id + "Image", panoramaTexels(image), image.width, image.height) +
           fmt::format("[sub_resource type=\"ImageTexture\" id=\"{0}\"]\nimage = "
                       "SubResource(\"{0}Image\")\n\n",
                       id);
}

/// An Environment that shows the sky and what metal reflects of the room, and lights nothing.
std::string environmentResource(const ImageF& sky, const ImageF& room) {
    const bool hasSky = !sky.rgb.empty();
    return (hasSky ? textureResource("Sky", sky) : "") + textureResource("Room", room) +
           "[sub_resource type=\"Shader\" id=\"SkyShader\"]\ncode = \"" + kSkyShader +
           "\"\n\n[sub_resource type=\"ShaderMaterial\" id=\"SkyMaterial\"]\n"
           "shader = SubResource(\"SkyShader\")\n" +
           (hasSky ? "shader_parameter/panorama = SubResource(\"Sky\")\n" : "") +
           "shader_parameter/room = SubResource(\"Room\")\n\n"
           "[sub_resource type=\"Sky\" id=\"Surroundings\"]\n"
           "sky_material = SubResource(\"SkyMaterial\")\n\n"
           "[sub_resource type=\"Environment\" id=\"Environment\"]\n" +
           fmt::format("background_mode = {}\n", hasSky ? 2 : 1) +
           "sky = SubResource(\"Surroundings\")\nambient_light_source = 1\n"
           "reflected_light_source = 2\n\n";
}

/// A LightmapGIData as Godot's text resource, format 4, which Godot reads from version 4.3 on.
std::string lightmapData(const ExportScene& scene, const LightmapImage& image, bool direct,
                         const Progress& progress) {
    const ImageF sky = skyPanorama(scene.scene.sky);
    const glm::vec3 middle = reflectionPlaces(scene, 1).places.front();
    const ImageF room = panoramaSeenFrom(scene, middle, kRoomWidth, kRoomWidth / 2, progress);
    std::string out =
        fmt::format("[gd_resource type=\"LightmapGIData\" load_steps={} format=4]\n\n",
                    image.layers + (sky.rgb.empty() ? 8 : 10));
    std::string images;
    std::size_t number = 0;
    for (const std::string& layer : layersOf(image)) {
        out += imageResource(fmt::format("Image_{}", number), layer, image.width, image.height);
        images += fmt::format("{}SubResource(\"Image_{}\")", number > 0 ? ", " : "", number);
        ++number;
    }
    out += environmentResource(sky, room);
    out += fmt::format("[sub_resource type=\"Texture2DArray\" id=\"Lightmap\"]\n_images = "
                       "Array[Image]([{}])\n\n[resource]\n",
                       images);
    out += "lightmap_textures = Array[TextureLayered]([SubResource(\"Lightmap\")])\n";
    out += fmt::format("uses_spherical_harmonics = {}\n", image.layers == 4);
    out += "user_data = []\n";
    if (!scene.field.grid.empty())
        putProbes(out, godotProbes(scene.field, glm::vec3(scene.document.origin)));
    if (image.layers == 4)
        out += "_uses_packed_directional = true\n";
    out += fmt::format(
        "metadata/direct = {}\nmetadata/environment = SubResource(\"Environment\")\n", direct);
    return out;
}

Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings& settings,
                                      const std::string& name, const Progress& progress) {
    const Result<ExportedLightmap> map =
        exportedLightmap(scene, ownSettings(settings), PageCount::One, progress);
    if (!map)
        return tl::make_unexpected(map.error());
    Result<std::vector<ExportFile>> files = gltfFiles(
        scene, {.pages = &map->pages, .cut = map->cut.get(), .extras = {}}, name, progress);
    if (!files)
        return files;
    const std::string stem = stemOf(name);
    files->push_back(
        {stem + ".tres", lightmapData(scene, map->images.front(), settings.direct, progress)});
    files->push_back(loaderFile(stem + "-godot.gd", stem, {"godot.gd"}));
    return files;
}

ExportForecast forecast(const ExportScene& scene, const ExportSettings& settings) {
    const ExportSettings godotSettings = ownSettings(settings);
    ExportForecast f = forecastLightmapOf(scene, godotSettings, PageCount::One);
    const std::uint64_t layers = godotSettings.bands > 1 ? 4 : 1;
    f.bytes = gltfBytes(scene) + layers * f.width * f.height * 11; // 8 bytes in base64
    f.bytes += std::min<std::uint64_t>(scene.field.cells(), kMaxGodotProbes) *
               800; // a probe and its tetrahedra
    return f;
}

} // namespace
} // namespace godot_format

constinit const ExportFormat kGodotFormat = {
    .name = "godot",
    .label = "Godot 4",
    .summary = "glTF, a LightmapGIData with the lightmap and the grid's probes, and a script that "
               "shows them in Godot 4.3 or later",
    .extensions = godot_format::kExtensions,
    .settings = godot_format::kSettings,
    .write = godot_format::write,
    .forecast = godot_format::forecast};

} // namespace limn
