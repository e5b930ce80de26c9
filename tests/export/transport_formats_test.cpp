// SPDX-License-Identifier: MIT
// The formats that carry the transport: the file that relights, and the page that shows it.
#include "engine/export/export_table.h"
#include "engine/export/lightmap_image.h"
#include "engine/export/limnrt_format.h"
#include "engine/runtime/limn_runtime.h"
#include "tests/core/temporary_folder.h"
#include "tests/export/exported_room.h"
#include "tests/export/known_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

namespace limn::transport_formats_test {
namespace {

ExportedRoom room() {
    auto assets = std::make_shared<Assets>();
    Document document = roomDocument(*assets);
    return {std::move(document), assets};
}

/// A transport file as the runtime wants it, aligned to 16 bytes.
struct Opened {
    explicit Opened(const std::string& file) : bytes(file.size() / sizeof(glm::vec4) + 1) {
        std::memcpy(bytes.data(), file.data(), file.size());
        char error[256] = {};
        scene = limnrt_open(bytes.data(), file.size(), nullptr, error, sizeof error);
        EXPECT_TRUE(scene) << error;
        limnrt_get_counts(scene, &counts);
    }
    ~Opened() { limnrt_close(scene); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

    struct alignas(16) Block {
        char bytes[16];
    };
    std::vector<Block> bytes;
    limnrt_scene* scene = nullptr;
    limnrt_counts counts{};
};

TEST(Transport, ItsFileLightsTheLightmapThatOtherFormatsHold) {
    const ExportedRoom exported = room();
    const ExportSettings settings{.bands = 3, .detail = 3};
    const Result<std::string> file = transportBytes(exported.view(), settings, {});
    ASSERT_TRUE(file) << file.error().message;
    const Result<LightmapImage> image = lightmapImage(exported.view(), settings, {});
    ASSERT_TRUE(image) << image.error().message;

    const Opened opened(*file);
    ASSERT_EQ(opened.counts.lightmap_width, image->width);
    ASSERT_EQ(opened.counts.lightmap_height, image->height);
    ASSERT_EQ(opened.counts.bands, 3U);
    limnrt_converge(opened.scene, 200);
    const std::size_t texels = std::size_t(image->width) * image->height;
    std::vector<float> rgba(texels * 9 * 4);
    limnrt_lightmap_sh(opened.scene, rgba.data());
    double error = 0, sum = 0;
    for (std::size_t t = 0; t < texels * 9; ++t)
        for (int c = 0; c < 3; ++c) {
            const double a = rgba[4 * t + std::size_t(c)], b = image->rgb[t][c];
            error += (a - b) * (a - b);
            sum += b * b;
        }
    EXPECT_GT(sum, 0);
    EXPECT_LT(std::sqrt(error / sum), 1e-3);
}

TEST(Transport, ItsSizeIsForeseen) {
    const ExportedRoom exported = room();
    const ExportFormat& format = *findExportFormat("limnrt");
    const auto files = format.write(exported.view(), {}, "room.limnrt", {});
    ASSERT_TRUE(files) << files.error().message;
    const auto bytes = double(files->front().bytes.size());
    EXPECT_NEAR(double(format.forecast(exported.view(), {}).bytes), bytes, 0.5 * bytes);
}

TEST(Transport, ALightThatHasNoneIsRefused) {
    const KnownLight light([](glm::vec3) { return KnownLight::probe(0); });
    for (const char* name : {"limnrt", "web"})
        EXPECT_FALSE(findExportFormat(name)->write(light.view(), {}, "room", {})) << name;
}

class Web : public testing::Test {
protected:
    /// Folders that hold every file of three.js and the runtime, each with its own name as content.
    ExportFolders folders() const {
        for (const char* file :
             {"three/build/three.core.js", "three/build/three.module.js",
              "three/examples/jsm/controls/OrbitControls.js",
              "three/examples/jsm/lights/RectAreaLightTexturesLib.js",
              "three/examples/jsm/lights/RectAreaLightUniformsLib.js",
              "three/examples/jsm/loaders/GLTFLoader.js",
              "three/examples/jsm/utils/BufferGeometryUtils.js",
              "three/examples/jsm/utils/SkeletonUtils.js", "runtime/limn_runtime.wasm"}) {
            std::filesystem::create_directories((folder.path / file).parent_path());
            writeFile(folder.file(file), file);
        }
        return {.three = folder.file("three"), .webRuntime = folder.file("runtime")};
    }
    TemporaryFolder folder;
    const ExportFormat& format = *findExportFormat("web");
};

TEST_F(Web, APageHasEveryModuleThatItsModulesImport) {
    const ExportedRoom exported = room();
    const ExportFolders from = folders();
    const auto files = format.write(exported.view(from), {}, "room", {});
    ASSERT_TRUE(files) << files.error().message;
    EXPECT_EQ(files->front().name, "index.html");
    std::set<std::string> names;
    for (const ExportFile& file : *files)
        names.insert(file.name);
    int imports = 0;
    for (const ExportFile& file : *files) {
        if (!file.name.ends_with(".js") || file.name.starts_with("three/"))
            continue;
        constexpr std::string_view kFrom = "from '";
        for (std::size_t at = 0; (at = file.bytes.find(kFrom, at)) != std::string::npos;
             ++imports) {
            at += kFrom.size();
            std::string name = file.bytes.substr(at, file.bytes.find('\'', at) - at);
            if (name == "three")
                name = "three/three.module.js";
            else if (name.starts_with("./"))
                name = name.substr(2);
            EXPECT_TRUE(names.contains(name)) << file.name << " imports " << name;
        }
    }
    EXPECT_GT(imports, 8);
}

TEST_F(Web, ItsDescriptionNamesFilesThatAreThere) {
    const ExportedRoom exported = room();
    const ExportFolders from = folders();
    const auto files = format.write(exported.view(from), {}, "room", {});
    ASSERT_TRUE(files) << files.error().message;
    const auto named = [&](const std::string& name) {
        return std::ranges::find(*files, name, &ExportFile::name);
    };
    const auto description = nlohmann::json::parse(named("scene.json")->bytes);
    EXPECT_EQ(description["title"], "room");
    for (const char* key : {"scene", "transport"})
        EXPECT_NE(named(description[key]), files->end()) << key;
    EXPECT_EQ(description["transportBytes"], named(description["transport"])->bytes.size());
    ASSERT_NE(named(description["lightmap"]["file"]), files->end());
    EXPECT_GT(description["meanIrradiance"], 0);
}

TEST_F(Web, WhatIsMissingIsNamedWithWhatHelps) {
    const ExportedRoom exported = room();
    ExportFolders from = folders();
    from.webRuntime = folder.file("nowhere");
    const auto withoutRuntime = format.write(exported.view(from), {}, "room", {});
    ASSERT_FALSE(withoutRuntime);
    EXPECT_NE(withoutRuntime.error().message.find("./run --web"), std::string::npos);
    from = folders();
    from.three = folder.file("nowhere");
    const auto withoutThree = format.write(exported.view(from), {}, "room", {});
    ASSERT_FALSE(withoutThree);
    EXPECT_NE(withoutThree.error().message.find("npm install three"), std::string::npos);
}

} // namespace
} // namespace limn::transport_formats_test
