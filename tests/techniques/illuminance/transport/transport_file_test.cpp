// SPDX-License-Identifier: MIT
// A bake that is written to a transport file and lit by the runtime has the light of the Relighter.
#include "engine/techniques/illuminance/transport/transport_file.h"
#include "tests/runtime/open_file.h"
#include "tests/runtime/transport_bytes.h"
#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/techniques/illuminance/relight/relit.h"

namespace limn::transport_file_test {
namespace {

/// Errors of the runtime's radiosity and lightmap against the Relighter's.
struct Errors {
    double radiosity, lightmap, grid;
};

/// Both lit by the scene's light until it converges, to far less than what is compared.
Errors errorsOf(const OpenFile& file, Scene scene, const TraceScene& trace,
                const std::shared_ptr<const Bake>& baked) {
    scene.relight.tolerance = 0.001f;
    EXPECT_EQ(limnrt_set_tolerance(file, 1e-5f), 1);
    Relighter relighter(baked, LitBands::All);
    EXPECT_TRUE(relighter.relight(scene, trace, 1000).converged);
    std::vector<limnrt_light> lights;
    for (const Light& light : scene.lights)
        lights.push_back(runtimeLight(light));
    EXPECT_EQ(limnrt_set_lights(file, lights.data(), std::uint32_t(lights.size())), 1);
    limnrt_reset(file);
    limnrt_converge(file, 1000);
    EXPECT_EQ(limnrt_converged(file), 1);
    Errors errors{};
    errors.radiosity =
        nrmse(limnrt_radiosity(file), relighter.radiosity().data(), relighter.radiosity().size());
    const IndirectField& field = relighter.field();
    const std::vector<float> lightmap = file.lightmapSh();
    EXPECT_EQ(lightmap.size(), 4 * field.lightmap.size());
    errors.lightmap = nrmse(lightmap.data(), field.lightmap.data(), field.lightmap.size());
    if (!field.grid.empty()) {
        std::vector<float> grid(4 * field.grid.size());
        limnrt_grid_sh(file, grid.data());
        errors.grid = nrmse(grid.data(), field.grid.data(), field.grid.size());
    }
    return errors;
}

void expectSame(const Errors& errors) {
    // Rounding, and rays along edges of triangles, which the two tracers decide differently.
    constexpr double kRounding = 5e-5;
    EXPECT_LT(errors.radiosity, kRounding);
    EXPECT_LT(errors.lightmap, kRounding);
    EXPECT_LT(errors.grid, kRounding);
}

Light lightOf(LightKind kind) {
    Light light;
    light.kind = kind;
    light.position = {2.3f, 2.6f, 2.9f};
    light.direction = glm::normalize(glm::vec3(0.3f, -1, -0.2f));
    light.color = {1, 0.6f, 0.3f};
    light.strength = 7;
    light.range = 4;
    light.innerAngle = 0.3f;
    light.outerAngle = 0.9f;
    light.size = {0.8f, 0.5f};
    light.roll = 0.4f;
    return light;
}

TEST(TransportFile, RelightsEveryKindOfLightAsTheRelighterDoes) {
    Scene scene = *litRoom(900, 800);
    scene.instances.push_back(scene.instances[1]); // a dynamic copy, which the grid lights
    scene.instances.back().dynamic = true;
    scene.instances.back().toWorld[3] = glm::vec4(40, 0, 0, 1);
    const TraceScene trace(scene);
    const auto baked = bakeOf(trace);
    const OpenFile file(fileOf(*baked, scene));
    ASSERT_TRUE(file) << file.message;
    for (const LightKind kind :
         {LightKind::Point, LightKind::Spot, LightKind::Rectangle, LightKind::Directional}) {
        scene.lights = {lightOf(kind), lightOf(kind)};
        scene.lights[1].position.x = 3.3f;
        SCOPED_TRACE(int(kind));
        expectSame(errorsOf(file, scene, trace, baked));
    }
}

Scene quickHall(LinkStorage storage, std::uint32_t bands = 3, bool window = false) {
    Scene scene = hall(storage, bands, window);
    scene.bake.rays = 64;
    scene.bake.lightmapCaches = 400;
    return scene;
}

TEST(TransportFile, RelightsThroughAWindowInEveryNumberOfBands) {
    for (std::uint32_t bands = 2; bands <= 8; ++bands)
        for (const std::uint32_t chroma : {0U, 1U, 2U}) {
            Scene scene = quickHall(LinkStorage::Rtp, bands, true);
            scene.bake.chromaBands = chroma;
            scene.sky.radiance = {1, 2, 3};
            scene.lights = {lightOf(LightKind::Directional)};
            const TraceScene trace(scene);
            const auto baked = bakeOf(trace);
            const OpenFile file(fileOf(*baked, scene));
            ASSERT_TRUE(file) << file.message;
            SCOPED_TRACE(bands * 10 + chroma);
            expectSame(errorsOf(file, scene, trace, baked));
        }
}

/// A file as minor version 0 wrote it: without the section of light points.
std::string withoutLightPoints(std::string file) {
    file[12] = 0; // the minor version
    changeSection(file, "DIMS", [](std::string& dims) { dims.replace(4 * 21, 4, 4, '\0'); });
    file.replace(sectionOf(file, "SLPT").entry, 4, "NON1"); // tags that readers skip
    file.replace(sectionOf(file, "SLNM").entry, 4, "NON2");
    rehash(file);
    return file;
}

TEST(TransportFile, OlderFilesLightSurfelsAtTheirMiddles) {
    Scene scene = *litRoom(900, 800);
    const TraceScene trace(scene);
    const auto baked = bakeOf(trace), middles = bakeOfMiddles(trace);
    const OpenFile older(withoutLightPoints(fileOf(*baked, scene))), none(fileOf(*middles, scene));
    ASSERT_TRUE(older) << older.message;
    ASSERT_TRUE(none) << none.message;
    for (const LightKind kind : {LightKind::Point, LightKind::Rectangle}) {
        scene.lights = {lightOf(kind)};
        expectSame(errorsOf(older, scene, trace, middles));
        expectSame(errorsOf(none, scene, trace, middles));
        EXPECT_GT(errorsOf(older, scene, trace, baked).radiosity, 0.005) << "the points matter";
    }
}

Image noise(std::uint32_t width, std::uint32_t height) {
    Image image{"noise", width, height, {}};
    std::uint32_t bits = 7;
    for (std::uint32_t k = 0; k < 4 * width * height; ++k) {
        bits = bits * 1664525U + 1013904223U;
        image.rgba.push_back(std::uint8_t(bits >> 24));
    }
    return image;
}

/// A room below five sheets whose holes differ in kind. Three share one image.
Scene roomOfSheets() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.assets->images = {noise(5, 3), noise(4, 4)};
    for (int k = 0; k < 5; ++k) {
        Material m = simple::lambert(glm::vec3(0.5f));
        m.doubleSided = true;
        m.alphaMode = k == 1 ? AlphaMode::Blend : AlphaMode::Mask;
        m.baseColor.w = k == 4 ? 0.9f : 1.f;
        TextureRef& t = m.baseColorTexture;
        t.image = k == 3 ? -1 : k == 4 ? 1 : 0;
        t.wrapU = t.wrapV = k == 1 ? Wrap::Clamp : k == 2 ? Wrap::Mirror : Wrap::Repeat;
        t.nearest = k == 1;
        t.scale = {1.7f, 2.3f};
        t.offset = {-0.6f, -0.3f};
        t.rotation = k == 4 ? 0.4f : 0;
        const float x = 0.1f + 0.77f * float(k);
        Mesh sheet = simple::quad({x, 2, 0.2f}, {0, 0, 4.6f}, {0.7f, 0, 0}, b.addMaterial(m));
        if (k == 3)
            sheet.colors = {{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 0.2f}, {1, 1, 1, 0.8f}};
        b.add(sheet);
    }
    b.scene.bake.surfels = 4000;
    b.scene.bake.lightmapCaches = 500;
    b.scene.bake.rays = 32;
    b.scene.bake.links = 32;
    return b.build();
}

TEST(TransportFile, HolesLetThroughWhatTheyLetThroughInTheScene) {
    Scene scene = roomOfSheets();
    const TraceScene trace(scene);
    const auto baked = bakeOf(trace);
    const std::string bytes = fileOf(*baked, scene);
    std::string closed = bytes;
    changeSection(closed, "CTEX", [](std::string& alpha) {
        EXPECT_EQ(alpha.size(), 5 * 3 + 1 + 4 * 4) << "each image once, and one of a texel";
        alpha.assign(alpha.size(), '\xff');
    });
    rehash(closed);
    for (const LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        scene.lights = {lightOf(kind)};
        scene.lights[0].position.x += 0.013f; // else a ray meets the very edge of a hole
        expectSame(errorsOf(OpenFile(bytes), scene, trace, baked));
        EXPECT_GT(errorsOf(OpenFile(closed), scene, trace, baked).radiosity, 0.01);
    }
}

TEST(TransportFile, RefusesWhatItCannotHold) {
    const Scene scene = quickHall(LinkStorage::Sh);
    const auto baked = bakeOf(TraceScene(scene));
    const Result<std::string> file = transportFile({*baked, scene, nullptr, "test"});
    ASSERT_FALSE(file);
    EXPECT_NE(file.error().message.find("--storage rtp"), std::string::npos);

    const Scene room = quickHall(LinkStorage::Rtp), other = quickHall(LinkStorage::Rtp, 3, true);
    const auto fits = bakeOf(TraceScene(room));
    EXPECT_FALSE(transportFile({*fits, other, nullptr, "test"}));
    const std::vector<glm::uvec4> texel(1, glm::uvec4(1 << 30));
    const std::vector<glm::vec4> weight(1, glm::vec4(1, 0, 0, 0)),
        half(1, glm::vec4(0.5f, 0, 0, 0));
    const TransportLightmap unknown{1, 1, texel, weight}, dark{1, 1, texel, half},
        empty{2, 1, texel, weight};
    for (const TransportLightmap* map : {&unknown, &dark, &empty})
        EXPECT_FALSE(transportFile({*fits, room, map, "test"}));
}

TEST(TransportFile, IsTheSameForTheSameInput) {
    const Scene scene = quickHall(LinkStorage::Rtp);
    EXPECT_EQ(fileOf(*bakeOf(TraceScene(scene)), scene), fileOf(*bakeOf(TraceScene(scene)), scene));
}

} // namespace
} // namespace limn::transport_file_test
