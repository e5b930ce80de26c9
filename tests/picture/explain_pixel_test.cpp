// SPDX-License-Identifier: MIT
#include "engine/picture/explain_pixel.h"

#include "engine/core/parallel.h"
#include "engine/files/project_file.h"
#include "engine/gltf/gltf_import.h"
#include "engine/picture/field_render.h"
#include "engine/techniques/technique_table.h"
#include "tests/core/source_path.h"
#include "tests/core/sweep.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::explain_pixel_test {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 30;

/// Pictures and explanations take the same samples, so that few of them show whether they agree.
constexpr std::uint32_t kSamples = 4;

ConvergedLight light(const Scene& unlit, const Precomputed* known = nullptr) {
    const auto scene = std::make_shared<const Scene>(unlit);
    const auto trace = std::make_shared<const TraceScene>(*scene);
    const Technique& technique = *findTechnique(scene->technique.technique);
    Prepared prepared;
    if (known)
        prepared = {std::shared_ptr<const Precomputed>(std::shared_ptr<void>(), known), scene};
    else if (technique.precomputation)
        prepared = {*technique.precomputation->prepare(*trace, {}, {}), scene};
    return std::move(*convergeLight(scene, trace, technique, prepared, LitFor::Pictures, {}));
}

FieldRenderOptions pictureOf(const Camera& camera, View view) {
    return {.view = view,
            .camera = camera,
            .width = kWidth,
            .height = kHeight,
            .samplesPerPixel = kSamples};
}

/// The picture that renderField() draws, without the noise of choosing one light for each sample:
/// each light is drawn alone.
std::vector<glm::vec3> picture(const ConvergedLight& lit, const Camera& camera) {
    Scene rest = *lit.scene;
    rest.lights.clear();
    std::vector<glm::vec3> sum = renderField(TraceScene(rest, *lit.trace), lit.field(), *lit.layout,
                                             pictureOf(camera, View::Lit))
                                     .rgb;
    for (const Light& one : lit.scene->lights) {
        Scene alone = *lit.scene;
        alone.sky = {};
        alone.lights = {one};
        for (Material& m : alone.materials)
            m.emission = glm::vec3(0);
        const ImageF direct = renderField(TraceScene(alone, *lit.trace), IndirectField{},
                                          *lit.layout, pictureOf(camera, View::Lit));
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += direct.rgb[i];
    }
    return sum;
}

struct Pixel {
    std::uint32_t x, y;
    std::size_t index() const { return std::size_t(y) * kWidth + x; }
};

std::vector<Pixel> randomPixels(std::size_t count) {
    std::mt19937 random(7);
    std::vector<Pixel> pixels;
    while (pixels.size() < count)
        pixels.push_back({std::uint32_t(random() % kWidth), std::uint32_t(random() % kHeight)});
    return pixels;
}

PixelQuestion questionOf(const Camera& camera, Pixel p) {
    return {.camera = camera,
            .width = kWidth,
            .height = kHeight,
            .x = p.x,
            .y = p.y,
            .samples = kSamples};
}

/// Within a share of the value, or of a hundredth of the picture's mean where a pixel is nearly
/// black.
void expectSame(glm::vec3 a, glm::vec3 b, double share, double mean, const char* what) {
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(a[k], b[k], share * (std::abs(double(b[k])) + 0.01 * mean))
            << what << ", colour " << k;
}

double meanOf(const std::vector<glm::vec3>& rgb) {
    double sum = 0;
    for (const glm::vec3 c : rgb)
        sum += double(c.x + c.y + c.z) / 3;
    return sum / double(rgb.size());
}

/// The rows below each row sum to it.
void expectRowsSum(const std::vector<LightRow>& rows, double mean) {
    std::vector<glm::vec3> below(rows.size(), glm::vec3(0));
    std::vector<bool> any(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (const std::uint32_t parent = rows[k].parent; parent != LightRow::kNone) {
            ASSERT_LT(parent, k) << "parents come first";
            below[parent] += rows[k].value;
            any[parent] = true;
        }
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (any[k])
            expectSame(below[k], rows[k].value, 1e-3, mean, rows[k].label.c_str());
}

/// Both tables of random pixels sum to what the picture shows, within 1 %.
void expectPicture(const ConvergedLight& lit, const Camera& camera,
                   std::size_t pixels = kSanitized ? 10 : 100) {
    const std::vector<glm::vec3> shown = picture(lit, camera);
    const double mean = meanOf(shown);
    ASSERT_GT(mean, 0);
    for (const Pixel p : randomPixels(pixels)) {
        SCOPED_TRACE(testing::Message() << "pixel " << p.x << ", " << p.y);
        const PixelExplanation e = explainPixel(lit, questionOf(camera, p));
        expectSame(totalOf(e.tables.byOrigin), shown[p.index()], 0.01, mean, "by origin");
        expectSame(totalOf(e.tables.bySender), shown[p.index()], 0.01, mean, "by sender");
        expectRowsSum(e.tables.byOrigin, mean);
        expectRowsSum(e.tables.bySender, mean);
    }
}

/// Few surfels and texels, so that a scene is baked in a second.
void coarsen(BakeSettings& bake) {
    bake.surfels = 1500;
    bake.lightmapCaches = 1500;
    bake.rays = 64;
    bake.links = 32;
}

Scene sample(const char* name) {
    const std::string path = sourcePath(std::string("projects/") + name + "/" + name + ".limn");
    const ImportedScene project = std::move(*loadProject(path));
    Scene scene = flatten(project.document, project.assets);
    coarsen(scene.bake);
    return scene;
}

/// Adds a spot and a rectangle in the middle of the scene, and a sky.
void addLights(Scene& scene) {
    const glm::vec3 centre = scene.bounds.centre();
    Light spot;
    spot.kind = LightKind::Spot;
    spot.name = "Spot";
    spot.position = centre;
    spot.color = {0.2f, 1, 0.4f};
    spot.strength = 30;
    Light rectangle;
    rectangle.kind = LightKind::Rectangle;
    rectangle.name = "Panel";
    rectangle.position = centre + glm::vec3(0, 0.2f * scene.bounds.size().y, 0);
    rectangle.size = glm::vec2(0.1f * scene.bounds.size().x);
    rectangle.color = {1, 0.3f, 0.2f};
    rectangle.strength = 50;
    scene.lights.push_back(spot);
    scene.lights.push_back(rectangle);
    scene.sky.radiance = {0.5f, 1, 2};
}

const LightRow* rowOf(const std::vector<LightRow>& rows, LightRowKind kind, std::uint32_t index,
                      std::string_view below) {
    for (const LightRow& row : rows)
        if (row.kind == kind && row.index == index && row.parent != LightRow::kNone &&
            rows[row.parent].label == below)
            return &row;
    return nullptr;
}

const Precomputed& bakeOfCornellBox() {
    static const ConvergedLight lit = light(sample("cornell"));
    return *lit.prepared.data;
}

TEST(ExplainPixel, SumsToThePictureOfTheCornellBox) {
    Scene scene = sample("cornell");
    addLights(scene);
    expectPicture(light(scene, &bakeOfCornellBox()), chooseCamera(scene, {}));
}

TEST(ExplainPixel, SumsToThePictureOfTheAtrium) {
    Scene scene = sample("atrium");
    addLights(scene);
    expectPicture(light(scene), chooseCamera(scene, {}));
}

TEST(ExplainPixel, SumsToThePictureOfSponza) {
    const std::string path = sourcePath("../shared/scenes/sponza-crytek/Sponza.gltf");
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << "the shared scenes are not here";
    const ImportedScene imported = std::move(*importGltf(path));
    Scene scene = flatten(imported.document, imported.assets);
    coarsen(scene.bake);
    addLights(scene);
    Light lamp;
    lamp.position = scene.bounds.centre() - glm::vec3(0, 0.2f * scene.bounds.size().y, 0);
    lamp.strength = 20;
    scene.lights.push_back(lamp);
    ASSERT_GE(scene.lights.size(), 3U);
    Camera inside;
    inside.eye = scene.bounds.centre() - glm::vec3(0.3f * scene.bounds.size().x, 0, 0);
    inside.target = scene.bounds.centre();
    expectPicture(light(scene), inside);
}

/// A room with a lamp, an emissive block, an open side to the sky, and a dynamic block between.
Scene mixedRoom(LinkStorage storage, std::uint32_t bands, std::uint32_t chromaBands) {
    Scene scene = hall(storage, bands, true);
    const auto assets = std::make_shared<Assets>(*scene.assets);
    assets->meshes.push_back(simple::box({-0.2f, -0.2f, -0.2f}, {0.2f, 0.2f, 0.2f}, false));
    assets->meshes.back().name = "Cube";
    scene.assets = assets;
    scene.materials[0].baseColor = {0.8f, 0.5f, 0.3f, 1};
    scene.materials[0].doubleSided = true;
    scene.materials.push_back(simple::lambert(glm::vec3(0.4f), {0.5f, 2, 1}));
    scene.instances[1].material = 1;
    Instance cube = scene.instances[1];
    cube.mesh = std::uint32_t(assets->meshes.size() - 1);
    cube.material = 0;
    cube.dynamic = true;
    cube.toWorld = glm::translate(glm::mat4(1), {3, 1, 2.5f});
    scene.instances.push_back(cube);
    scene.lights.resize(1);
    scene.lights[0].position = {2.5f, 2.5f, 4};
    scene.lights[0].strength = 5;
    scene.sky.radiance = {0.5f, 1, 2};
    scene.bake.lightmapCaches = 1000;
    scene.bake.rays = 64;
    scene.bake.links = 32;
    scene.bake.chromaBands = chromaBands;
    return scene;
}

/// Bakes hold no light, so that the tests that differ in lights alone share one.
const Precomputed& bakeOfMixedRoom() {
    static const ConvergedLight lit = light(mixedRoom(LinkStorage::Rtp, 3, 0));
    return *lit.prepared.data;
}

Camera inMixedRoom() {
    Camera camera;
    camera.eye = {3.8f, 1.5f, 4.8f};
    camera.target = {1.5f, 1, 1.5f};
    return camera;
}

TEST(ExplainPixel, SumsInEveryStorageWithGreyBandsAndWithWhatMoves) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const std::uint32_t chroma : {0U, 2U, 1U}) {
            if (kSanitized && chroma != 2)
                continue;
            SCOPED_TRACE(testing::Message() << "storage " << int(storage) << ", chroma " << chroma);
            Scene scene = mixedRoom(storage, 4, chroma);
            scene.materials[1].metallic = 1;
            scene.materials[1].roughness = 0.4f;
            expectPicture(light(scene), inMixedRoom(), kSanitized ? 4 : 8);
        }
}

TEST(ExplainPixel, FollowsNoMoreBouncesThanTheDocumentAsksFor) {
    for (const std::uint32_t bounces : {1U, 2U}) {
        Scene scene = mixedRoom(LinkStorage::Rtp, 3, 0);
        scene.relight.maxBounces = bounces;
        const ConvergedLight lit = light(scene, &bakeOfMixedRoom());
        expectPicture(lit, inMixedRoom(), 20);
        const PixelExplanation e = explainPixel(lit, questionOf(inMixedRoom(), {20, 15}));
        EXPECT_EQ(e.tables.bounces, bounces);
        for (const LightRow& row : e.tables.byOrigin)
            EXPECT_NE(row.kind, LightRowKind::Remainder);
    }
}

TEST(ExplainPixel, NamesEveryOrigin) {
    const ConvergedLight lit = light(mixedRoom(LinkStorage::Rtp, 3, 0), &bakeOfMixedRoom());
    const PixelExplanation e = explainPixel(lit, questionOf(inMixedRoom(), {20, 27}));
    const std::vector<LightRow>& rows = e.tables.byOrigin;
    for (const auto& [kind, index] :
         {std::pair(LightRowKind::Light, 0U), std::pair(LightRowKind::Sky, LightRow::kNone),
          std::pair(LightRowKind::Surface, 1U)}) {
        const LightRow* row = rowOf(rows, kind, index, "Indirect");
        ASSERT_TRUE(row) << nameOf(kind);
        EXPECT_GT(row->value.y, 0) << nameOf(kind);
    }
    const auto rest = std::ranges::find(rows, LightRowKind::Remainder, &LightRow::kind);
    ASSERT_NE(rest, rows.end());
    EXPECT_LE(rest->value.y, 2.1e-3f * rows[rest->parent].value.y);
}

TEST(ExplainPixel, IrradianceIsWhatArrivesBeforeTheSurfaceReflectsIt) {
    const ConvergedLight lit = light(mixedRoom(LinkStorage::Rtp, 3, 0), &bakeOfMixedRoom());
    const Camera camera = inMixedRoom();
    const auto draw = [&](View view) {
        return renderField(*lit.trace, lit.field(), *lit.layout, pictureOf(camera, view)).rgb;
    };
    const auto direct = draw(View::Direct), bounced = draw(View::Irradiance),
               albedo = draw(View::Albedo);
    std::size_t compared = 0;
    for (const Pixel p : randomPixels(50)) {
        PixelQuestion question = questionOf(camera, p);
        question.light = PixelLight::Irradiance;
        const PixelExplanation e = explainPixel(lit, question);
        if (e.seen.size() != 1) // the albedo is a mean
            continue;
        ++compared;
        expectSame(e.total,
                   bounced[p.index()] +
                       direct[p.index()] * std::numbers::pi_v<float> / albedo[p.index()],
                   0.01, meanOf(bounced), "irradiance");
    }
    EXPECT_GT(compared, 25U);
}

TEST(ExplainPixel, WithoutTheRowsOfALightItIsThePictureWithoutTheLight) {
    Scene scene = sample("cornell");
    addLights(scene);
    const Camera camera = chooseCamera(scene, {});
    const ConvergedLight lit = light(scene, &bakeOfCornellBox());
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
        SCOPED_TRACE(scene.lights[l].name);
        Scene without = scene;
        without.lights.erase(without.lights.begin() + l);
        const std::vector<glm::vec3> shown =
            picture(light(without, lit.prepared.data.get()), camera);
        for (const Pixel p : randomPixels(30)) {
            SCOPED_TRACE(testing::Message() << "pixel " << p.x << ", " << p.y);
            expectSame(lightWithout(lit, questionOf(camera, p), {.lights = {l}}), shown[p.index()],
                       0.01, meanOf(shown), "without");
        }
    }
}

/// The mixed room with its lamp near the floor, so that the block's sides have light from nearby.
Scene roomWithALowLamp() {
    Scene scene = mixedRoom(LinkStorage::Rtp, 3, 0);
    scene.lights[0].position = {2.5f, 0.6f, 2.5f};
    return scene;
}

// Few samples of a pixel meet a near surface, or find light that the field lacks.
constexpr std::uint32_t kNear = 4, kNearSamples = 16, kGatheredSamples = 8;

std::vector<glm::vec3> pictureWithNearLight(const ConvergedLight& lit) {
    FieldRenderOptions options = pictureOf(inMixedRoom(), View::Lit);
    options.nearRays = kNear;
    options.samplesPerPixel = kNearSamples;
    return renderField(*lit.trace, lit.field(), *lit.layout, options).rgb;
}

PixelQuestion questionWithNearLight(Pixel p) {
    PixelQuestion question = questionOf(inMixedRoom(), p);
    question.nearRays = kNear;
    question.samples = kNearSamples;
    return question;
}

TEST(ExplainPixel, SumsToThePictureWithLightFromNearSurfaces) {
    const ConvergedLight lit = light(roomWithALowLamp(), &bakeOfMixedRoom());
    const std::vector<glm::vec3> shown = pictureWithNearLight(lit);
    const double mean = meanOf(shown);
    std::size_t near = 0;
    for (const Pixel p : randomPixels(160)) {
        SCOPED_TRACE(testing::Message() << "pixel " << p.x << ", " << p.y);
        const PixelExplanation e = explainPixel(lit, questionWithNearLight(p));
        expectSame(totalOf(e.tables.byOrigin), shown[p.index()], 0.01, mean, "by origin");
        expectSame(totalOf(e.tables.bySender), shown[p.index()], 0.01, mean, "by sender");
        expectRowsSum(e.tables.byOrigin, mean);
        expectRowsSum(e.tables.bySender, mean);
        near += rowOf(e.tables.byOrigin, LightRowKind::Light, 0,
                      "Direct light that near surfaces reflect")
                    ? 1U
                    : 0U;
    }
    EXPECT_GT(near, 10U);
}

FieldRenderOptions gathered(const ConvergedLight& lit, View view) {
    FieldRenderOptions options = pictureOf(inMixedRoom(), view);
    options.nearRays = kNear;
    options.samplesPerPixel = kGatheredSamples;
    options.gatherRays = 4;
    options.emitted = lit.lighting->emittedField(*lit.scene);
    return options;
}

PixelQuestion gatheredQuestion(Pixel p, PixelLight light) {
    PixelQuestion question = questionWithNearLight(p);
    question.samples = kGatheredSamples;
    question.gatherRays = 4;
    question.light = light;
    return question;
}

TEST(ExplainPixel, SumsToThePictureThatIsGathered) {
    for (const std::uint32_t bands : {3U, 4U}) {
        Scene scene = mixedRoom(LinkStorage::Rtp, bands, 0);
        const ConvergedLight lit = bands == 3 ? light(scene, &bakeOfMixedRoom()) : light(scene);
        const ImageF shown = renderField(*lit.trace, lit.field(), *lit.layout,
                                         gathered(lit, View::Irradiance)),
                     seen = renderField(*lit.trace, lit.field(), *lit.layout,
                                        gathered(lit, View::Lit));
        std::size_t emitted = 0, bounced = 0;
        for (const Pixel p : randomPixels(kSanitized ? 10 : 40)) {
            SCOPED_TRACE(testing::Message() << "pixel " << p.x << ", " << p.y);
            const PixelExplanation arrives = explainPixel(
                                       lit, gatheredQuestion(p, PixelLight::Irradiance)),
                                   leaves =
                                       explainPixel(lit, gatheredQuestion(p, PixelLight::Radiance));
            const double mean = meanOf(shown.rgb);
            for (const auto* rows : {&arrives.tables.byOrigin, &arrives.tables.bySender}) {
                glm::vec3 indirect = totalOf(*rows); // the picture shows no direct light
                for (const LightRow& row : *rows)
                    if (row.label == "Direct" && row.parent == LightRow::kNone)
                        indirect -= row.value;
                expectSame(indirect, shown.rgb[p.index()], 0.01, mean, "E");
            }
            expectSame(totalOf(leaves.tables.byOrigin), seen.rgb[p.index()], 0.01, meanOf(seen.rgb),
                       "L");
            expectRowsSum(arrives.tables.byOrigin, mean);
            expectRowsSum(arrives.tables.bySender, mean);
            emitted += rowOf(arrives.tables.byOrigin, LightRowKind::Sky, LightRow::kNone,
                             "Emitted light from sky and surfaces")
                           ? 1U
                           : 0U;
            bounced +=
                rowOf(arrives.tables.byOrigin, LightRowKind::Light, 0, "Gathered bounced light")
                    ? 1U
                    : 0U;
        }
        EXPECT_GT(emitted, kSanitized ? 0U : 10U);
        EXPECT_GT(bounced, kSanitized ? 0U : 10U);
    }
}

TEST(ExplainPixel, WithoutALightNearSurfacesLackItToo) {
    const Scene scene = roomWithALowLamp();
    const ConvergedLight lit = light(scene, &bakeOfMixedRoom());
    Scene without = scene;
    without.lights.clear();
    const std::vector<glm::vec3> shown =
        pictureWithNearLight(light(without, lit.prepared.data.get()));
    const double mean = meanOf(pictureWithNearLight(lit));
    for (const Pixel p : randomPixels(30)) {
        SCOPED_TRACE(testing::Message() << "pixel " << p.x << ", " << p.y);
        expectSame(lightWithout(lit, questionWithNearLight(p), {.lights = {0}}), shown[p.index()],
                   0.01, mean, "without");
    }
}

TEST(ExplainPixel, WithoutTheSkyItIsThePictureWithoutTheSky) {
    const Scene scene = mixedRoom(LinkStorage::Rtp, 3, 0);
    const ConvergedLight lit = light(scene, &bakeOfMixedRoom());
    Scene without = scene;
    without.sky = {};
    const std::vector<glm::vec3> shown =
        picture(light(without, lit.prepared.data.get()), inMixedRoom());
    for (const Pixel p : randomPixels(30)) {
        SCOPED_TRACE(testing::Message() << "pixel " << p.x << ", " << p.y);
        expectSame(lightWithout(lit, questionOf(inMixedRoom(), p), {.sky = true}), shown[p.index()],
                   0.01, meanOf(shown), "without");
    }
}

TEST(ExplainPixel, WithABlackObjectItIsThePictureWithThatObjectBlack) {
    Scene scene = sample("cornell");
    const Camera camera = chooseCamera(scene, {});
    const ConvergedLight lit = light(scene, &bakeOfCornellBox());
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "instance " << i);
        Scene black = scene;
        black.materials.push_back(scene.materials[scene.instances[i].material]);
        black.materials.back().baseColor = {0, 0, 0, 1};
        black.instances[i].material = std::uint32_t(black.materials.size() - 1);
        const std::vector<glm::vec3> shown = picture(light(black, lit.prepared.data.get()), camera);
        for (const Pixel p : randomPixels(30)) {
            SCOPED_TRACE(testing::Message() << "pixel " << p.x << ", " << p.y);
            expectSame(lightWithout(lit, questionOf(camera, p), {.surfaces = {i}}),
                       shown[p.index()], 0.01, meanOf(shown), "without");
        }
    }
}

TEST(ExplainPixel, IsTheSameForAnyNumberOfThreads) {
    const ConvergedLight lit = light(mixedRoom(LinkStorage::Rtp, 3, 0), &bakeOfMixedRoom());
    const PixelQuestion question = questionOf(inMixedRoom(), {20, 27});
    const PixelExplanation all = explainPixel(lit, question);
    const ThreadLimit one(1);
    const PixelExplanation same = explainPixel(lit, question);
    ASSERT_EQ(all.tables.byOrigin.size(), same.tables.byOrigin.size());
    for (std::size_t k = 0; k < all.tables.byOrigin.size(); ++k)
        EXPECT_EQ(all.tables.byOrigin[k].value, same.tables.byOrigin[k].value);
}

TEST(ExplainPixel, AmbientLightIsOneRow) {
    Scene scene = mixedRoom(LinkStorage::Rtp, 3, 0);
    scene.technique.technique = "ambient";
    const ConvergedLight lit = light(scene);
    expectPicture(lit, inMixedRoom());
    const PixelExplanation e = explainPixel(lit, questionOf(inMixedRoom(), {20, 27}));
    const LightRow* sky = rowOf(e.tables.bySender, LightRowKind::Sky, LightRow::kNone, "Indirect");
    ASSERT_TRUE(sky);
    EXPECT_GT(sky->value.y, 0);
}

TEST(ExplainPixel, SumsToThePictureOfMarchedReflections) {
    Scene scene = sample("cornell");
    addLights(scene);
    scene.materials[scene.instances[0].material].metallic = 1;
    scene.materials[scene.instances[0].material].roughness = 0.2f;
    scene.technique = {"probes",
                       {{"probes.count", 64}, {"probes.side", 24}, {"probes.bounces", 1}}};
    const ConvergedLight lit = light(scene);
    ASSERT_TRUE(reflectingPart(lit.field()));
    expectPicture(lit, chooseCamera(scene, {}));
}

TEST(ExplainPixel, WhereNothingIsSeenTheSkyBehindIsAll) {
    Scene scene = mixedRoom(LinkStorage::Rtp, 3, 0);
    Camera away = inMixedRoom();
    away.eye = {10, 10, 10};
    away.target = {20, 20, 20};
    const ConvergedLight lit = light(scene, &bakeOfMixedRoom());
    const PixelExplanation e = explainPixel(lit, questionOf(away, {20, 15}));
    EXPECT_TRUE(e.seen.empty());
    ASSERT_FALSE(e.tables.byOrigin.empty());
    EXPECT_EQ(e.tables.byOrigin[0].kind, LightRowKind::Sky);
    EXPECT_EQ(e.total, e.tables.byOrigin[0].value);
    EXPECT_GT(e.total.z, e.total.x);
}

} // namespace
} // namespace limn::explain_pixel_test
