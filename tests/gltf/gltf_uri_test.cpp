// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_uri.h"

#include "tests/gltf/gltf_builder.h"
#include "tests/scene/small_png.h"

namespace limn::gltf_uri_test {
namespace {

std::string fileOf(const std::string& uri, FileReach reach = FileReach::Folder) {
    const Result<std::string> path = fileOfUri("/scenes", uri, reach);
    return path ? *path : path.error().message;
}

TEST(GltfUri, DecodesEscapesOnceAndLeavesAPlus) {
    EXPECT_EQ(fileOf("a%20b.bin"), "/scenes/a b.bin");
    EXPECT_EQ(fileOf("a+b.bin"), "/scenes/a+b.bin");
    EXPECT_EQ(fileOf("a%2520b"), "/scenes/a%20b");
    EXPECT_EQ(fileOf("50%.png"), "/scenes/50%.png");
    EXPECT_EQ(fileOf("%zz%4"), "/scenes/%zz%4");
    EXPECT_EQ(fileOf("%C3%A4.png"), "/scenes/\xc3\xa4.png");
    EXPECT_EQ(fileOf("sub/../b.bin"), "/scenes/sub/../b.bin");
    EXPECT_EQ(fileOf("..b/c"), "/scenes/..b/c");
}

TEST(GltfUri, StaysInTheFolderUnlessItMayLeaveIt) {
    for (const char* uri : {"../a.bin", "%2e%2e/a.bin", "..%2Fa.bin", "b/../../a.bin", "..",
                            "/etc/passwd", "%2Fetc/passwd"}) {
        EXPECT_EQ(fileOf(uri), "lies outside the scene's folder, which --outside-files allows")
            << uri;
        EXPECT_NE(fileOf(uri, FileReach::Anywhere).find('/'), std::string::npos) << uri;
    }
    EXPECT_EQ(fileOf("/etc/passwd", FileReach::Anywhere), "/etc/passwd");
    EXPECT_EQ(fileOf("file:///etc/passwd"), "file: is not supported");
    EXPECT_EQ(fileOf("http://h/a.png", FileReach::Anywhere), "http: is not supported");
    EXPECT_EQ(fileOf(std::string("a%00b")), "names no file");
}

TEST(GltfUri, AnImportReadsWhatItMay) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path / "scene");
    const std::string path = folder.file("scene/s.gltf");
    GltfBuilder b = triangleScene();
    const std::vector<std::uint8_t> png = greyPng();
    writeFile(folder.file("secret.png"), std::string(png.begin(), png.end()));
    writeFile(folder.file("scene/a+b.bin"), b.bytes);
    b.json["buffers"] = {{{"uri", "a+b.bin"}, {"byteLength", b.bytes.size()}}};
    b.json["images"] = {{{"uri", "%2e%2e/secret.png"}}};
    writeFile(path, b.json.dump());
    Result<ImportedScene> scene = importGltf(path);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->assets->images[0].rgba[0], 255);
    EXPECT_TRUE(hasRepair(*scene, "lies outside the scene's folder"));
    scene = importGltf(path, {}, {.reach = FileReach::Anywhere});
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->assets->images[0].rgba[0], 128);

    b.json["buffers"][0]["uri"] = "../buffer.bin";
    writeFile(folder.file("buffer.bin"), b.bytes);
    writeFile(path, b.json.dump());
    scene = importGltf(path);
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("s.gltf: buffers[0].uri: ../buffer.bin: lies outside"),
              std::string::npos)
        << scene.error().message;
}

} // namespace
} // namespace limn::gltf_uri_test
