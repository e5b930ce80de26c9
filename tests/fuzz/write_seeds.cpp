// SPDX-License-Identifier: MIT
// write_seeds FOLDER: writes the valid examples from which fuzzing starts, FOLDER/TARGET/NAME.
#include "engine/files/image_file.h"
#include "engine/files/ktx2.h"
#include "engine/files/project_file.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_file.h"
#include "engine/techniques/illuminance/transport/transport_file.h"
#include "tests/fuzz/small_bake.h"
#include "tests/fuzz/small_room.h"
#include "tests/fuzz/target.h"
#include "tests/gltf/packed_scenes.h"
#include "tests/scene/small_ktx2.h"
#include "tests/scene/small_png.h"

#include <filesystem>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfTiledOutputFile.h>
#include <stb/stb_image_write.h>
#include <turbojpeg.h>
#include <webp/encode.h>

using namespace limn;

namespace {

void append(void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data), std::size_t(size));
}

void putBig(std::string& out, std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out += char(word >> shift);
}

void pngChunk(std::string& out, const std::string& name, const std::string& content) {
    putBig(out, std::uint32_t(content.size()));
    out += name + content;
    putBig(out, 0); // a checksum, which nobody looks at
}

/// Rows of zeros, not compressed, of any kind of texel.
std::string plainPng(std::uint32_t width, std::uint32_t height, int depth, int color,
                     bool interlaced, bool palette) {
    std::string out = "\x89PNG\r\n\x1a\n", header;
    putBig(header, width), putBig(header, height);
    for (const int byte : {depth, color, 0, 0, int(interlaced)})
        header += char(byte);
    pngChunk(out, "IHDR", header);
    if (palette) {
        pngChunk(out, "PLTE", std::string("\0\0\0\xff\x80\x40", 6));
        pngChunk(out, "tRNS", std::string("\xff\x10", 2));
    }
    const std::size_t bytes = interlaced ? 400 : height * (1 + width * 8);
    std::string data = {
        0x78, 0x01, 1, char(bytes), char(bytes >> 8), char(~bytes), char(~bytes >> 8)};
    data += std::string(bytes, '\0') + std::string(4, '\0');
    pngChunk(out, "IDAT", data);
    pngChunk(out, "IEND", "");
    return out;
}

void writeImages(const TemporaryFolder&, const auto& write) {
    const std::vector<std::uint8_t> grey = greyPng();
    write("grey.png", std::string(grey.begin(), grey.end()));
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 16 * 16 * 4; ++i)
        texels.push_back(std::uint8_t(i * 7));
    for (const int channels : {1, 2, 3, 4}) {
        std::string png;
        stbi_write_png_to_func(append, &png, 16, 8, channels, texels.data(), 16 * channels);
        write("channels" + std::to_string(channels) + ".png", png);
    }
    for (const std::uint32_t packing : {0U, 2U})
        for (const auto& [format, size] :
             {std::pair(9U, 15U), {29U, 45U}, {44U, 60U}, {132U, 16U}, {138U, 32U}}) {
            const std::vector<std::uint8_t> file =
                ktx2(format, 5, 3, std::string(texels.begin(), texels.begin() + size), packing);
            write(std::to_string(format) + (packing ? "_zstd.ktx2" : ".ktx2"),
                  std::string(file.begin(), file.end()));
        }
    write("bits1.png", plainPng(5, 3, 1, 0, false, false));
    write("bits16.png", plainPng(3, 3, 16, 6, false, false));
    write("palette.png", plainPng(5, 3, 4, 3, false, true));
    write("interlaced.png", plainPng(9, 5, 8, 2, true, false));
    for (const int channels : {1, 3})
        for (const int quality : {20, 95}) { // the latter with full colour
            std::string jpeg;
            stbi_write_jpg_to_func(append, &jpeg, 16, 12, channels, texels.data(), quality);
            write("channels" + std::to_string(channels) + "_" + std::to_string(quality) + ".jpg",
                  jpeg);
        }
    unsigned char* bytes = nullptr;
    unsigned long jpegSize = 0;
    const tjhandle encoder = tjInitCompress();
    tjCompress2(encoder, texels.data(), 16, 0, 12, TJPF_CMYK, &bytes, &jpegSize, TJSAMP_444, 90, 0);
    write("inks.jpg", std::string(reinterpret_cast<const char*>(bytes), jpegSize));
    tjFree(bytes);
    tjDestroy(encoder);
    for (const bool isLossless : {false, true}) {
        const std::size_t size = isLossless
                                     ? WebPEncodeLosslessRGBA(texels.data(), 16, 12, 64, &bytes)
                                     : WebPEncodeRGBA(texels.data(), 16, 12, 64, 75, &bytes);
        write(isLossless ? "lossless.webp" : "lossy.webp",
              std::string(reinterpret_cast<const char*>(bytes), size));
        WebPFree(bytes);
    }
}

std::string exr(Imf::Compression compression, bool inTiles) {
    constexpr int kWidth = 5, kHeight = 40;
    std::vector<float> plane;
    for (int i = 0; i < kWidth * kHeight; ++i)
        plane.push_back(float(i % 7) * 0.25f);
    Imf::Header header(kWidth, kHeight);
    header.compression() = compression;
    Imf::FrameBuffer pixels;
    for (const char* name : {"B", "G", "R"}) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        pixels.insert(name, Imf::Slice::Make(Imf::FLOAT, plane.data(), header.dataWindow()));
    }
    Imf::addChromaticities(header, {{0.7f, 0.3f}, {0.2f, 0.7f}, {0.15f, 0.05f}, {0.33f, 0.33f}});
    Imf::StdOSStream out;
    if (inTiles) {
        header.setTileDescription({4, 4, Imf::MIPMAP_LEVELS});
        Imf::TiledOutputFile file(out, header, 0);
        file.setFrameBuffer(pixels);
        for (int level = 0; level < file.numLevels(); ++level)
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    } else {
        Imf::OutputFile file(out, header, 0);
        file.setFrameBuffer(pixels);
        file.writePixels(kHeight);
    }
    return out.str();
}

void writeFloatImages(const TemporaryFolder& folder, const auto& write) {
    for (int i = Imf::NO_COMPRESSION; i < Imf::NUM_COMPRESSION_METHODS; ++i)
        for (const bool inTiles : {false, true})
            write("compression" + std::to_string(i) + (inTiles ? "_tiles.exr" : "_lines.exr"),
                  exr(Imf::Compression(i), inTiles));
    (void)writeExr(folder.file("own.exr"), {2, 2, std::vector<glm::vec3>(4, {1, 2, 3})});
    write("own.exr", fileBytes(folder.file("own.exr")));
    for (const int width : {4, 12}) { // rows of fewer than 8 texels are not packed
        std::vector<float> texels(std::size_t(width) * 4 * 3, 1.5f);
        std::string hdr;
        stbi_write_hdr_to_func(append, &hdr, width, 4, 3, texels.data());
        write("width" + std::to_string(width) + ".hdr", hdr);
    }
}

/// Two textured triangles that a lamp lights: project_files.h reads the file.
std::string plainScene() {
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int uv = b.accessor(b.view(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}), "VEC2",
                              GltfBuilder::kFloat, 4);
    const int normal = b.vec3(std::vector<glm::vec3>(4, {0, 0, 1}));
    b.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}},
            {"indices", b.indices({0, 1, 2, 0, 2, 3})},
            {"material", 0}});
    b.json["images"] = {{{"bufferView", b.view(greyPng())}, {"mimeType", "image/png"}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 5}}};
    b.json["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
    return b.glb();
}

/// A floor and a lamp's panel above it, with as much of glTF as fits on them.
GltfBuilder richScene() {
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}});
    const int normal = b.vec3({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
    const int uv =
        b.accessor(b.view(std::vector<std::uint16_t>{0, 0, 65535, 0, 65535, 65535, 0, 65535}),
                   "VEC2", GltfBuilder::kUnsignedShort, 4, true);
    const int color = b.accessor(b.view(std::vector<std::uint8_t>(16, 200)), "VEC4",
                                 GltfBuilder::kUnsignedByte, 4, true);
    const int rows = b.view(std::vector<std::uint16_t>{2});
    const int values = b.view(std::vector<glm::vec3>{{2, 0.1f, 2}});
    b.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", rows}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    b.mesh({{"attributes",
             {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}, {"COLOR_0", color}}},
            {"indices", b.indices({0, 1, 2, 0, 2, 3})},
            {"material", 0}});
    const int panel = b.vec3({{0.5f, 1, 0.5f}, {1, 1, 0.5f}, {0.5f, 1, 1}, {1, 1, 1}});
    b.mesh({{"attributes", {{"POSITION", panel}}}, {"mode", 5}, {"material", 1}});
    b.json["images"] = {{{"bufferView", b.view(greyPng())}, {"mimeType", "image/png"}}};
    b.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    b.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    const nlohmann::json texture = {
        {"index", 0},
        {"extensions",
         {{"KHR_texture_transform",
           {{"offset", {0.1, 0.2}}, {"scale", {2, 2}}, {"rotation", 0.3}}}}}};
    b.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {0.8, 0.7, 0.6, 1}},
           {"baseColorTexture", texture},
           {"metallicRoughnessTexture", {{"index", 0}}},
           {"metallicFactor", 0.5},
           {"roughnessFactor", 0.4}}},
         {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3}},
        {{"emissiveFactor", {1, 1, 0.5}},
         {"emissiveTexture", {{"index", 0}}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}}}},
         {"doubleSided", true},
         {"alphaMode", "BLEND"}}};
    b.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    b.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing",
                                "KHR_texture_transform", "KHR_materials_emissive_strength"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 5}, {"range", 10}},
        {{"type", "directional"}, {"intensity", 2}, {"color", {1, 0.5, 0.2}}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
    const int translation = b.vec3({{0, 0, 0}, {4, 0, 0}});
    b.json["nodes"][0]["extensions"] = {
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", translation}}}}}};
    b.json["nodes"][1]["matrix"] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1};
    for (int light = 0; light < 3; ++light) {
        b.json["nodes"].push_back({{"translation", {1, 0.5, light}},
                                   {"rotation", {0.6, 0, 0, 0.8}},
                                   {"camera", 0},
                                   {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
        b.json["scenes"][0]["nodes"].push_back(2 + light);
    }
    b.json["nodes"].push_back({{"children", {5}}, {"scale", {1, 2, 3}}});
    b.json["nodes"][5]["children"] = {6};
    b.json["nodes"].push_back({{"mesh", 1}});
    b.json["scenes"][0]["nodes"].push_back(5);
    return b;
}

void writeScenes(const TemporaryFolder&, const auto& write) {
    write("triangle.glb", triangleScene().glb());
    write("plain.glb", plainScene());
    write("rich.glb", richScene().glb());
    const Grid grid;
    write("meshopt.glb", meshoptScene(grid).glb());
    write("draco.glb", dracoScene(dracoBytes(grid, 5), grid.indices.size()).glb());
    write("draco_sequential.glb", dracoScene(dracoBytes(grid, 10), grid.indices.size()).glb());
    GltfBuilder moving = bentStrip();
    const int times = scalars(moving, {0, 1});
    animate(moving, {{"node", 2}, {"path", "translation"}}, times,
            moving.vec3({{1, 0, 0}, {1, 1, 0}}));
    write("moving.glb", moving.glb());
    // As text; the buffer is zeros: degenerate triangles to be mended.
    nlohmann::json text = triangleScene().json;
    text["buffers"] = {{{"byteLength", 36},
                        {"uri", "data:application/octet-stream;base64," + std::string(48, 'A')}}};
    write("zeros.gltf", text.dump());
    // Without a buffer at all an accessor is zeros.
    text = triangleScene().json;
    text.erase("bufferViews");
    text["accessors"][0].erase("bufferView");
    write("bufferless.gltf", text.dump());
    GltfBuilder closed;
    closed.mesh(
        {{"attributes", {{"POSITION", closed.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})}}},
         {"indices", closed.indices({0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2})}});
    closed.json["materials"] = {{{"emissiveFactor", {1, 1, 1}}}};
    closed.json["meshes"][0]["primitives"][0]["material"] = 0;
    write("closed.glb", closed.glb());
}

void writeProjects(const TemporaryFolder& folder, const auto& write) {
    writeFile(folder.file("scene.glb"), plainScene());
    ImportedScene scene = *importGltf(folder.file("scene.glb"));
    Document& document = scene.document;
    Light spot;
    spot.kind = LightKind::Spot;
    Light panel;
    panel.kind = LightKind::Rectangle;
    addObject(document, spot);
    addObject(document, panel);
    addObject(document, Light{});
    addObject(document, Camera{});
    document.scenePath = "scene.glb";
    write("whole.limn", documentToJson(document));
    for (auto& [id, object] : document.objects)
        if (Sky* sky = std::get_if<Sky>(&object)) {
            sky->kind = SkyKind::Image;
            sky->image = "sky.hdr";
        }
    write("sky.limn", documentToJson(document));
    write("short.limn", R"({"version": 1, "scene": "scene.glb"})");
    document.scenePath.clear();
    document.sceneHash = 0;
    write("no_scene.limn", documentToJson(document));
}

/// Changes as changes.h reads them: field, kind, index, value.
std::string change(int field, int kind, int index, std::uint64_t value) {
    std::string out = {char(field), char(kind), char(index), char(index >> 8)};
    for (const std::uint64_t word : {value, value})
        out.append(reinterpret_cast<const char*>(&word), sizeof word);
    return out;
}

void writeChanges(const TemporaryFolder&, const auto& write) {
    for (const int links : {0, 1}) {
        write("unchanged" + std::to_string(links), std::string(1, char(links)));
        for (const int kind : {0, 1, 2, 3, 4}) {
            std::string all(1, char(links));
            for (int field = 16; field < 52; field += 5)
                all += change(field + kind, kind, 3, 1);
            write("kind" + std::to_string(kind) + "_" + std::to_string(links), all);
        }
    }
}

void writeStageChanges(const TemporaryFolder&, const auto& write) {
    write("unchanged", "");
    for (const int kind : {0, 1, 2, 3, 4})
        for (const int stage : {0, 3, 6, 9})
            write("kind" + std::to_string(kind) + "_" + std::to_string(stage),
                  change(stage, kind, stage, 1));
}

void writeTextures(const TemporaryFolder&, const auto& write) {
    for (const Ktx2Format format : {Ktx2Format::Rgba16f, Ktx2Format::Rgba32f, Ktx2Format::Rgb9e5,
                                    Ktx2Format::Bc6hUnsigned, Ktx2Format::Bc6hSigned})
        for (const bool zstd : {false, true}) {
            const std::string name = std::to_string(std::uint32_t(format)) + (zstd ? "_zstd" : "");
            for (const auto& [layers, depth] : {std::pair(0U, 0U), {2, 0}, {0, 2}}) {
                const Ktx2Shape shape{format, 3, 2, layers, depth, zstd};
                std::vector<glm::vec4> texels(shape.texels());
                for (std::size_t i = 0; i < texels.size(); ++i)
                    texels[i] = glm::vec4(i, 1, 0.5f, 1);
                write(name + "_" + std::to_string(layers) + std::to_string(depth),
                      encodeKtx2(shape, texels).value());
            }
        }
}

/// Words written into sections, as transport_target.cpp reads them.
void writeTransports(const TemporaryFolder&, const auto& write) {
    write("unchanged", "");
    write("header", "LIMNRT\r\n" + std::string(120, '\1'));
    for (const std::uint32_t value : {0U, 0x7fc00000U, 0xffffffffU}) {
        std::string all;
        for (int section = 0; section < 37; ++section) {
            const std::string one = {char(section), 3, char(section), 0};
            all += one + std::string(reinterpret_cast<const char*>(&value), sizeof value);
            write("section" + std::to_string(section) + "_" + std::to_string(value >> 24),
                  all.substr(all.size() - 8));
        }
    }
}

void writeOptions(const TemporaryFolder&, const auto& write) {
    write("lights", "scene\n--light\nsun dir=1,-1,0 lux=3 color=1,0.5,0\n--light\npoint pos=0,1,2 "
                    "cd=5 range=4\n--light\nspot pos=0,1,0 dir=0,-1,0 cd=2 inner=10 "
                    "outer=20\n--light\nrect pos=0,1,0 dir=0,-1,0 size=1,2 nits=3 roll=30 name=x");
    write("sky", "scene\n--sky\n1,2,3");
    write("gradient", "scene\n--sky\ngradient up=1,1,1 horizon=2,2,2 ground=0,0,0\n--time\n1.5");
    write("dynamic", "scene\n--dynamic\nNode 0@1,2,3");
    write("camera", "scene\n--eye\n1,2,3\n--target\n0,0,0\n--fov\n60\n--width\n64\n--height\n48");
    write("bake", "scene\n--preset\ndraft\n--grid\n2x3x4\n--storage\nsh\n--texels-per-metre\n"
                  "10\n--memory\n0.5");
    write("times", R"({"version": 1, "times": {"k": {"cpu_ms": 2.5, "gpu_ms": 1}}})");
}

/// The small room, whose sheet has holes.
Scene roomWithHoles() {
    Scene scene = smallRoom();
    const auto assets = std::make_shared<Assets>(*scene.assets);
    assets->images.push_back({"holes", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    scene.assets = assets;
    scene.materials[1].alphaMode = AlphaMode::Mask;
    scene.materials[1].baseColorTexture.image = 0;
    return scene;
}

Bake smallBakeOf(const Scene& scene, LinkStorage storage) {
    BakeSettings settings = smallBake();
    settings.storage = storage;
    Bake made = bake(TraceScene(scene), {}, nullptr, &settings).value();
    made.seconds.clear(); // the same file each time
    return made;
}

/// Valid files to which bake_target.cpp and transport_target.cpp make the changes of their inputs.
void writeLamps(const auto& write) {
    const std::string head = "TILT=NONE\n1 1000 1 ", tail = " 1 2 0 0 0\n1 1 40\n0 45 90\n";
    write("even.ies", "IESNA:LM-63-1995\n[LUMINAIRE] Lamp\n" + head + "3 1" + tail + "0\n9 5 0\n");
    write("quarter.ies", head + "3 2" + tail + "0 90\n9 5 0\n9 6 1\n");
    write("half.ies", "IESNA91\n" + head + "3 3" + tail + "0 90 180\n9,5,0\n9,6,1\n9,7,2\n");
    write("turned.ies", head + "3 2" + tail + "90 270\n9 5 0\n9 6 1\n");
    write("around.ies",
          "IES:LM-63-2019\n" + head + "3 3" + tail + "0 120 240\n9 5 0\n9 6 1\n9 7 2\n");
}

void writeStarts(const TemporaryFolder& folder, const auto& write) {
    for (const auto& [name, storage] : {std::pair("cones.bake", LinkStorage::Rtp),
                                        std::pair("harmonics.bake", LinkStorage::Sh)}) {
        require(writeBake(folder.file(name), smallBakeOf(smallRoom(), storage)).has_value(),
                "a small bake is written");
        write(name, fileBytes(folder.file(name)));
    }
    const Scene scene = roomWithHoles();
    const Bake made = smallBakeOf(scene, LinkStorage::Rtp);
    write("room.limnrt", transportFile({made, scene, nullptr, "fuzz"}).value());
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2)
        return 2;
    const TemporaryFolder temporary;
    const auto into = [&](const std::string& target) {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / target;
        std::filesystem::create_directories(folder);
        return [folder](const std::string& name, const std::string& bytes) {
            writeFile((folder / name).string(), bytes);
        };
    };
    writeImages(temporary, into("image"));
    writeFloatImages(temporary, into("float_image"));
    writeLamps(into("ies"));
    writeScenes(temporary, into("gltf"));
    writeProjects(temporary, into("project"));
    writeChanges(temporary, into("bake"));
    writeStageChanges(temporary, into("stage"));
    writeTextures(temporary, into("ktx2"));
    writeOptions(temporary, into("option"));
    writeTransports(temporary, into("transport"));
    writeStarts(temporary, into("starts"));
    return 0;
}
