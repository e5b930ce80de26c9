// SPDX-License-Identifier: MIT
// Files that a document refers to, and what moves in them.
#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/timeline.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "tests/editor_ui/session_fixture.h"
#include "tests/gltf/gltf_builder.h"

#include <fstream>

namespace limn::session_files_test {
namespace {

struct SessionFiles : SessionTest {};

TEST_F(SessionFiles, TimeMovesWhatTheFileAnimatesWithoutABakeOrAnEdit) {
    GltfBuilder b = triangleScene();
    b.mesh({{"attributes", {{"POSITION", b.vec3({{0, 0, 0}, {9, 0, 0}, {0, 0, 9}})}}}});
    animate(b, {{"node", 0}, {"path", "translation"}}, scalars(b, {0, 2}),
            b.vec3({{0, 1, 0}, {4, 1, 0}}));
    const std::string path = (folder / "moving.glb").string();
    std::ofstream(path, std::ios::binary) << b.glb();
    Session session(options());
    session.open(path);
    ASSERT_TRUE(runUntilIdle(session));
    ASSERT_TRUE(session.state.animation);
    const auto place = [&] { return session.scene()->instances.at(0).toWorld[3]; };
    ASSERT_TRUE(session.scene()->instances.at(0).dynamic);
    const glm::vec4 atRest = place();
    const Document document = session.state.document;
    const double bakeSeconds = session.bakeSeconds();
    session.state.seconds = 1;
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_EQ(place(), glm::vec4(2, 1, 0, 1));
    session.state.seconds = 0.5;
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_EQ(place(), glm::vec4(1, 1, 0, 1));
    session.state.seconds = 0;
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_EQ(place(), atRest);
    EXPECT_EQ(session.state.document, document);
    EXPECT_EQ(session.bakeSeconds(), bakeSeconds);
    EXPECT_FALSE(hasUnsavedChanges(session.state));
    advanceTime(session.state, 3.5); // of 2 s
    EXPECT_EQ(session.state.seconds, 1.5);
}

TEST_F(SessionFiles, TheSunOfAPanoramaBecomesALightAndStaysOneInTheProject) {
    const std::string path = (folder / "sun.exr").string();
    ImageF image{64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(1))};
    image.rgb[64 * 8 + 20] = glm::vec3(5000, 4000, 3000);
    ASSERT_TRUE(writeExr(path, image));
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    const std::size_t lights = session.scene()->lights.size();
    session.state.requests.push_back({Request::Kind::OpenSkyImage, path});
    ASSERT_TRUE(runUntil(session, [&] { return session.scene()->sky.showsImage(); }));
    session.state.requests.push_back({Request::Kind::ExtractSun, {}});
    ASSERT_TRUE(runUntilIdle(session));
    ASSERT_EQ(session.scene()->lights.size(), lights + 1);
    EXPECT_EQ(session.scene()->lights.back().kind, LightKind::Directional);
    EXPECT_EQ(session.scene()->sky.panorama->pixels.rgb[64 * 8 + 20], glm::vec3(1));
    const std::string saved = (folder / "sun.limn").string();
    ASSERT_TRUE(saveProject(saved, session.state.document));
    const Result<ImportedScene> again = loadProject(saved);
    ASSERT_TRUE(again) << again.error().message;
    const Sky sky = singleton<Sky>(again->document);
    ASSERT_TRUE(sky.showsImage());
    EXPECT_EQ(sky.panorama->pixels.rgb, session.scene()->sky.panorama->pixels.rgb);
    ASSERT_TRUE(undoEdit(session.state)); // sun and sky in one step
    EXPECT_EQ(singleton<Sky>(session.state.document).image, path);

    session.state.requests.push_back({Request::Kind::ExtractSun, {}});
    session.update();
    session.state.requests.push_back({Request::Kind::ExtractSun, {}});
    session.update();
    EXPECT_NE(session.state.log.back().text.find("No sun"), std::string::npos);
}

TEST_F(SessionFiles, APhotometricFileIsReadForTheLightThatIsSelected) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    const std::string path = (folder / "Lamp.IES").string();
    std::ofstream(path) << "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n70 0\n";
    Light lamp;
    lamp.strength = 1;
    const ObjectId id = addLight(session.state, lamp);
    session.state.requests.push_back({Request::Kind::Open, path}); // as a file that is dropped
    ASSERT_TRUE(runUntil(session, [&] { return session.scene()->lights.back().strength == 70; }));
    ASSERT_TRUE(session.scene()->lights.back().profile);
    EXPECT_EQ(session.scene()->lights.back().profile->name, "Lamp");
    ASSERT_TRUE(undoEdit(session.state));
    EXPECT_FALSE(std::get<Light>(session.state.document.objects.at(id)).profile);

    const auto complained = [&](const Request& request, const char* text) {
        session.state.requests.push_back(request);
        EXPECT_TRUE(runUntil(session, [&] {
            return session.state.log.back().level == LogLine::Level::Error && session.idle();
        }));
        EXPECT_NE(session.state.log.back().text.find(text), std::string::npos)
            << session.state.log.back().text;
    };
    complained(
        {.kind = Request::Kind::OpenProfile, .path = (folder / "none.ies").string(), .object = id},
        "none.ies");
    session.state.selection.clear();
    complained({Request::Kind::Open, path}, "select the light");
}

TEST_F(SessionFiles, ASkyImageIsReadLightsTheSceneWithoutABakeAndIsUndone) {
    Session session(options());
    session.open(project);
    ASSERT_TRUE(runUntilIdle(session));
    const auto before = session.field();
    const double bakeSeconds = session.bakeSeconds();
    const std::string path = (folder / "sky.exr").string();
    ASSERT_TRUE(writeExr(path, {4, 2, std::vector<glm::vec3>(8, glm::vec3(3))}));
    session.state.requests.push_back({Request::Kind::OpenSkyImage, path});
    ASSERT_TRUE(runUntil(session, [&] { return session.scene()->sky.showsImage(); }));
    ASSERT_TRUE(runUntilIdle(session));
    EXPECT_EQ(session.scene()->sky.image, path);
    EXPECT_NE(session.field()->lightmap, before->lightmap);
    EXPECT_EQ(session.bakeSeconds(), bakeSeconds);
    EXPECT_TRUE(hasUnsavedChanges(session.state));
    ASSERT_TRUE(undoEdit(session.state));
    EXPECT_EQ(singleton<Sky>(session.state.document).kind, SkyKind::Color);
    EXPECT_FALSE(hasUnsavedChanges(session.state));

    session.state.requests.push_back({Request::Kind::OpenSkyImage, folder / "none.exr"});
    ASSERT_TRUE(runUntil(session, [&] {
        return session.state.log.back().level == LogLine::Level::Error && session.idle();
    }));
    EXPECT_NE(session.state.log.back().text.find("none.exr"), std::string::npos);
}

} // namespace
} // namespace limn::session_files_test
