// SPDX-License-Identifier: MIT
#include "engine/files/project_file.h"

#include "tests/files/random_document.h"

#include <clocale>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace limn::document_json_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(DocumentJson, EveryDocumentComesBackEqual) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const Document document = RandomDocument(seed).make();
        const std::string text = documentToJson(document);
        const Result<Document> again = documentFromJson(text);
        ASSERT_TRUE(again) << again.error().message << "\n" << text;
        ASSERT_TRUE(*again == document) << "seed " << seed << "\n" << text;
        ASSERT_EQ(documentToJson(*again), text);
    }
}

TEST(DocumentJson, DefaultsComeBackAndMissingFieldsTakeThem) {
    Document document;
    for (Object object :
         {Object(Node{}), Object(Material{}), Object(Light{}), Object(Camera{}), Object(Sky{}),
          Object(BakeSettings{}), Object(TechniqueChoice{}), Object(RelightSettings{})})
        addObject(document, object);
    EXPECT_TRUE(*documentFromJson(documentToJson(document)) == document);
    const Result<Document> sparse = documentFromJson(R"({"version": 1, "objects": [
        {"id": 1, "node": {}}, {"id": 2, "material": {}}, {"id": 3, "light": {}},
        {"id": 4, "camera": {}}, {"id": 5, "sky": {}}, {"id": 6, "bakeSettings": {}},
        {"id": 7, "technique": {}}, {"id": 8, "relighting": {}}]})");
    ASSERT_TRUE(sparse) << sparse.error().message;
    EXPECT_TRUE(*sparse == document);
}

TEST(DocumentJson, RelightSettingsAreFoundWhereOlderProjectsKeepThem) {
    const Result<Document> old = documentFromJson(R"({"version": 1, "nextId": 9, "objects": [
        {"id": 2, "bakeSettings": {"rays": 64, "maxBounces": 3, "dimming": false}}]})");
    ASSERT_TRUE(old) << old.error().message;
    EXPECT_EQ(singleton<BakeSettings>(*old), BakeSettings{.rays = 64});
    EXPECT_EQ(std::get<RelightSettings>(old->objects.at(9)),
              (RelightSettings{.maxBounces = 3, .dynamicOcclusion = false}));
    EXPECT_EQ(old->nextId, 10U);
    EXPECT_EQ(*documentFromJson(documentToJson(*old)), *old);

    const Result<Document> both = documentFromJson(R"({"version": 1, "objects": [
        {"id": 1, "relighting": {"maxBounces": 5}}, {"id": 2, "bakeSettings": {"maxBounces": 3}}]})");
    ASSERT_TRUE(both) << both.error().message;
    EXPECT_EQ(both->objects.size(), 2U);
    EXPECT_EQ(singleton<RelightSettings>(*both).maxBounces, 5U);

    const Result<Document> bad = documentFromJson(R"({"version": 1, "objects": [
        {"id": 1, "bakeSettings": {"dimming": 1}}]})");
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().message, "objects[0].bakeSettings.dimming: not true or false");
}

TEST(DocumentJson, NumbersDoNotDependOnTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"})
        if (std::setlocale(LC_ALL, name)) {
            const Document document = RandomDocument(5).make();
            EXPECT_TRUE(*documentFromJson(documentToJson(document)) == document) << name;
        }
    std::setlocale(LC_ALL, before.c_str());
}

TEST(DocumentJson, AnErrorNamesTheFieldByItsPath) {
    Document document;
    Node node;
    node.meshes = {1, 2};
    addObject(document, node);
    addObject(document, Material{});
    Light light;
    light.profile = {std::make_shared<const LightProfile>(
        LightProfile{.name = "Lamp", .rows = 2, .columns = 1, .share = {1, 0.5f}})};
    addObject(document, light);
    addObject(document, Camera{});
    addObject(document, BakeSettings{});
    const Json good = Json::parse(documentToJson(document));
    struct Case {
        const char* at;
        Json value;
        const char* expected;
    };
    const Case cases[] = {
        {"/objects/2/light/color/1", "red", "objects[2].light.color[1]: not a number"},
        {"/objects/2/light/color/1", -1, "objects[2].light.color[1]: less than 0"},
        {"/objects/2/light/color", {1, 2}, "objects[2].light.color: not 3 numbers"},
        {"/objects/2/light/colour", 1, "objects[2].light.colour: unknown field"},
        {"/objects/2/light/kind", "laser",
         "objects[2].light.kind: not one of directional, point, spot"},
        {"/objects/2/light/enabled", 1, "objects[2].light.enabled: not true or false"},
        {"/objects/2/light/strength", nullptr, "objects[2].light.strength: not a number"},
        {"/objects/2/light/profile", 1, "objects[2].light.profile: not an object"},
        {"/objects/2/light/profile/share", {1}, "objects[2].light.profile.share: 1 numbers"},
        {"/objects/2/light/profile/share/1", 2, "objects[2].light.profile.share: a number"},
        {"/objects/2/light/profile/share/1", "x",
         "objects[2].light.profile.share[1]: not a number"},
        {"/objects/2/light/profile/rows", 1, "objects[2].light.profile.rows"},
        {"/objects/2/light/profile/columns", 4000000000, "objects[2].light.profile.columns"},
        {"/objects/2/light/profile/lastVertical", 0, "objects[2].light.profile.lastVertical"},
        {"/objects/2/light/profile/peak", 0, "objects[2].light.profile.peak"},
        {"/objects/2/light/profile/lamp", 1, "objects[2].light.profile.lamp: unknown field"},
        {"/objects/2/light/direction", {0, 0, 2}, "objects[2].light.direction: not of unit length"},
        {"/objects/0/node/name", 3, "objects[0].node.name: not a string"},
        {"/objects/0/node/meshes/1", -1, "objects[0].node.meshes[1]: not an integer >= 0"},
        {"/objects/0/node/meshes/0", 1.5, "objects[0].node.meshes[0]: not an integer >= 0"},
        {"/objects/0/node/meshes", 1, "objects[0].node.meshes: not an array"},
        {"/objects/0/node/parent", 4294967296, "objects[0].node.parent: not an integer >= 0"},
        {"/objects/0/node/transform/scale/2", 0,
         "objects[0].node.transform.scale[2]: may not be 0"},
        {"/objects/0/node/transform/rotation", {0, 0, 0, 2}, "objects[0].node.transform.rotation"},
        {"/objects/0/node/transform/pivot", 0, "objects[0].node.transform.pivot: unknown field"},
        {"/objects/0/node/transform", 0, "objects[0].node.transform: not an object"},
        {"/objects/0/node", "x", "objects[0].node: not an object"},
        {"/objects/1/material/metallic", 1.5, "objects[1].material.metallic: more than 1"},
        {"/objects/1/material/transmission", 1.5, "objects[1].material.transmission: more than 1"},
        {"/objects/1/material/transmission", -0.1, "objects[1].material.transmission: less than 0"},
        {"/objects/1/material/ior", 0.9, "objects[1].material.ior: less than 1"},
        {"/objects/1/material/ior", 1e39, "objects[1].material.ior: not a number"},
        {"/objects/1/material/thickness", -1, "objects[1].material.thickness: less than 0"},
        {"/objects/1/material/normalTexture/image", 0.5, "objects[1].material.normalTexture.image"},
        {"/objects/1/material/normalTexture/texCoord", 16,
         "objects[1].material.normalTexture.texCoord"},
        {"/objects/3/camera/fovY", 0, "objects[3].camera.fovY"},
        {"/objects/4/bakeSettings/bands", 9, "objects[4].bakeSettings.bands: more than 8"},
        {"/objects/4/bakeSettings/bands", 1, "objects[4].bakeSettings.bands: less than 2"},
        {"/objects/4/id", 4, "objects[4].id: 4 is there twice"},
        {"/objects/4/id", 0, "objects[4].id: not a positive integer"},
        {"/objects/4/id", "x", "objects[4].id: not a positive integer"},
        {"/objects/4/note", 1, "objects[4].note: unknown field"},
        {"/objects/4", 1, "objects[4]: not an object"},
        {"/objects", 1, "objects: not an array"},
        {"/nextId", 3, "nextId: object 5 exists"},
        {"/version", 2, "version: 2 is unknown"},
        {"/version", "1", "version: not an integer"},
        {"/sceneHash", "xyz", "sceneHash"},
        {"/extra", 1, "extra: unknown field"},
    };
    for (const Case& c : cases) {
        Json bad = good;
        bad[Json::json_pointer(c.at)] = c.value;
        const Result<Document> read = documentFromJson(bad.dump());
        ASSERT_FALSE(read) << c.at << " = " << c.value;
        EXPECT_EQ(read.error().message.find(c.expected), 0u)
            << c.at << ": " << read.error().message;
    }
}

TEST(DocumentJson, TextThatIsNoProjectIsAnError) {
    for (const char* bad :
         {"", "{", "[]", "1", "null", "{}", "{\"version\": 1} x", "{\"version\": 1e99}", "\xff\xfe",
          "{\"version\": 1, \"objects\": [{}]}", "{\"version\": 1, \"objects\": [{\"id\": 1}]}"})
        EXPECT_FALSE(documentFromJson(bad)) << bad;
    EXPECT_FALSE(documentFromJson("{\"version\":1,\"objects\":" + std::string(100000, '[')));
    EXPECT_TRUE(documentFromJson("{\"version\": 1}"));
}

TEST(DocumentJson, TheTreeMustBeOne) {
    const auto read = [](const std::string& objects) {
        return documentFromJson("{\"version\":1,\"objects\":[" + objects + "]}");
    };
    EXPECT_NE(read(R"({"id":1,"node":{"parent":7}})").error().message.find("7 is no node"),
              std::string::npos);
    EXPECT_NE(read(R"({"id":1,"node":{"parent":1}})").error().message.find("ancestor"),
              std::string::npos);
    EXPECT_NE(read(R"({"id":1,"node":{"parent":2}},{"id":2,"node":{"parent":1}})")
                  .error()
                  .message.find("ancestor"),
              std::string::npos);
    EXPECT_NE(read(R"({"id":1,"node":{"parent":2}},{"id":2,"light":{}})")
                  .error()
                  .message.find("2 is no node"),
              std::string::npos);
    EXPECT_TRUE(
        read(R"({"id":1,"node":{"parent":3}},{"id":2,"node":{"parent":3}},{"id":3,"node":{}})"));
}

TEST(DocumentJson, DamagedTextNeverCrashes) {
    const std::string whole = documentToJson(RandomDocument(12).make());
    std::mt19937 random(3);
    for (int round = 0; round < 500; ++round) {
        std::string text = whole.substr(0, round % 5 ? whole.size() : random() % whole.size());
        for (int i = int(random() % 4); i >= 0 && !text.empty(); --i)
            text[random() % text.size()] = "0123456789-{}[]\",.:entrufals"[random() % 29];
        if (const Result<Document> read = documentFromJson(text); read) {
            EXPECT_TRUE(documentFromJson(documentToJson(*read)));
        }
    }
}

} // namespace
} // namespace limn::document_json_test
