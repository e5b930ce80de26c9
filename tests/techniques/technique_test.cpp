// SPDX-License-Identifier: MIT
#include "engine/techniques/technique_table.h"

#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/texel_points.h"
#include "tests/core/temporary_folder.h"
#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace limn::technique_test {
namespace {

/// A technique with what it needs to light a scene.
struct Lit {
    Scene scene;
    std::shared_ptr<const TraceScene> trace;
    LightmapLayout layout;
    std::unique_ptr<Lighting> lighting;

    Lit(const Technique& technique, const Scene& of) : scene(of) {
        scene.technique.technique = technique.name;
        trace = std::make_shared<const TraceScene>(scene);
        Prepared prepared;
        layout = layoutWithoutLightmap(scene);
        if (technique.precomputation) {
            prepared = {*technique.precomputation->prepare(*trace, {}, {}),
                        std::make_shared<const Scene>(scene)};
            layout = prepared.data->layout();
        }
        lighting = technique.light(prepared);
    }
    LightingReport update(std::uint32_t bounces = 64) {
        return lighting->update({.scene = scene, .trace = trace.get(), .bounces = bounces}, {});
    }
    /// At the middle of each triangle of the first instance, on its front.
    std::vector<glm::vec3> irradiance() const {
        std::vector<glm::vec3> all;
        const Instance& instance = scene.instances[0];
        const Mesh& mesh = scene.meshOf(instance);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            const WorldPoint at = worldPoint(scene, instance, {t, glm::vec2(1 / 3.f)});
            all.push_back(sampleIrradiance({.field = *lighting->field(),
                                            .layout = layout,
                                            .scene = scene,
                                            .instance = 0,
                                            .triangle = t,
                                            .u = 1 / 3.f,
                                            .v = 1 / 3.f,
                                            .position = at.position,
                                            .normal = at.normal}));
        }
        return all;
    }
};

TEST(Techniques, AreNamedOnceAndExplained) {
    std::set<std::string> names, labels;
    ASSERT_GE(techniques().size(), 2U);
    for (const Technique* t : techniques()) {
        EXPECT_TRUE(names.insert(t->name).second) << t->name;
        EXPECT_TRUE(labels.insert(t->label).second) << t->label;
        EXPECT_GT(std::string(t->summary).size(), 20U) << t->name;
        EXPECT_EQ(findTechnique(t->name), t);
        for (const TechniqueSetting& s : t->settings) {
            EXPECT_TRUE(std::string(s.setting.key).starts_with(std::string(t->name) + "."));
            EXPECT_TRUE(s.usual >= s.range.lower && s.usual <= s.range.upper) << s.setting.key;
        }
    }
    EXPECT_EQ(findTechnique("magic"), nullptr);
    EXPECT_EQ(techniques()[0]->name, TechniqueChoice{}.technique) << "the default comes first";
}

TEST(Techniques, AChoiceOfNoneOrOfUnknownSettingsIsADefect) {
    EXPECT_EQ(choiceDefect({}), "");
    EXPECT_EQ(choiceDefect({"ambient", {{"ambient.radiance", 3}}}), "");
    EXPECT_NE(choiceDefect({"magic", {}}).find("\"magic\" is not " + techniqueNames()),
              std::string::npos);
    EXPECT_NE(choiceDefect({"ambient", {{"ambient.glow", 3}}}).find("ambient.glow"),
              std::string::npos);
}

/// A room that every technique bakes in a moment.
Scene smallRoom() {
    Scene scene = *litRoom(300, 400);
    scene.sky.radiance = glm::vec3(0.5f, 1, 2);
    return scene;
}

TEST(Techniques, DataIsForWhoeverPrecomputesAndTheChosenComeFirst) {
    for (const Technique* t : techniques()) {
        const Technique& preparing = precomputingTechnique({t->name, {}});
        EXPECT_TRUE(preparing.precomputation);
        EXPECT_TRUE(&preparing == t || !t->precomputation);
    }
    EXPECT_TRUE(precomputingTechnique({"magic", {}}).precomputation);
}

TEST(Techniques, OverlaysAreNamedOnceAndFoundAgain) {
    std::set<std::string> names;
    for (const OverlayKind* kind : overlayKinds()) {
        EXPECT_TRUE(names.insert(kind->name).second) << kind->name;
        EXPECT_GT(std::string(kind->tooltip).size(), 10U) << kind->name;
    }
    EXPECT_FALSE(names.contains("none")) << "that is the program's own";
}

// What holds of all precomputed data.
TEST(Techniques, PrecomputedDataIsReadAsItWasWrittenAndKnowsItsScene) {
    const Scene scene = smallRoom();
    const TraceScene trace(scene);
    const std::string path = testing::TempDir() + "limn_technique_test.limnbake";
    for (const Technique* technique : techniques()) {
        const Precomputation* p = technique->precomputation;
        if (!p)
            continue;
        SCOPED_TRACE(technique->name);
        const auto made = p->prepare(trace, {}, {});
        ASSERT_TRUE(made) << made.error().message;
        const Precomputed& data = **made;
        EXPECT_EQ(&data.technique(), technique);
        EXPECT_EQ(data.settings(), scene.bake);
        EXPECT_EQ(data.inputHash(), p->inputHash(scene));
        EXPECT_EQ(data.defect(scene), "");
        ASSERT_TRUE(data.write(path));
        const auto read = readPrecomputed(path);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ((*read)->hash(), data.hash());
        EXPECT_EQ((*read)->report().counts.size(), data.report().counts.size());
        Scene other = scene;
        other.instances[0].toWorld[3].x += 1;
        EXPECT_NE(p->inputHash(other), data.inputHash());
        BakeSettings fewer = scene.bake;
        fewer.lightmapCaches /= 2;
        const auto coarse = p->prepare(trace, {.settings = &fewer}, {});
        ASSERT_TRUE(coarse) << coarse.error().message;
        EXPECT_EQ((*coarse)->settings().lightmapCaches, fewer.lightmapCaches);
        EXPECT_NE((*coarse)->hash(), data.hash());
        const auto tooLarge = p->prepare(trace, {.memory = {.maxBytes = 1}}, {});
        EXPECT_FALSE(tooLarge);
        EXPECT_GT(p->predict(scene, false).working, 1U);
    }
}

TEST(Techniques, EveryOverlayHasALegendAndItsPicksAreDescribed) {
    const Scene scene = smallRoom();
    const auto trace = std::make_shared<const TraceScene>(scene);
    for (const Technique* technique : techniques()) {
        if (technique->overlays.empty())
            continue;
        SCOPED_TRACE(technique->name);
        Prepared prepared;
        if (technique->precomputation)
            prepared = {*technique->precomputation->prepare(*trace, {}, {}),
                        std::make_shared<const Scene>(scene)};
        const auto lighting = technique->light(prepared);
        lighting->update({.scene = scene, .trace = trace.get()}, {});
        const auto light = lighting->snapshot();
        const OverlaySource* source = prepared.data.get();
        if (!source)
            source = light.get();
        ASSERT_TRUE(source);
        EXPECT_EQ(&source->technique(), technique);
        for (const OverlayKind& kind : technique->overlays) {
            EXPECT_EQ(&techniqueOf(kind), technique) << kind.name;
            EXPECT_TRUE(isMadeOf(kind, source)) << kind.name;
            EXPECT_FALSE(isMadeOf(kind, nullptr)) << kind.name;
            EXPECT_TRUE(technique->precomputation || kind.showsLight) << kind.name;
            const bool picks = kind.pick != OverlayPick::None;
            ASSERT_TRUE(!picks || source->pickCount() > 0) << kind.name;
            for (const std::uint32_t pick : {0U, ~0U}) {
                if (pick == ~0U && kind.pick == OverlayPick::Required)
                    continue;
                const OverlayData data =
                    source->overlay({.kind = &kind, .pick = picks ? pick : ~0U}, scene,
                                    kind.showsLight ? light.get() : nullptr);
                EXPECT_FALSE(data.legend.title.empty()) << kind.name;
                EXPECT_FALSE(data.marks.empty() && data.texels.empty()) << kind.name;
            }
            if (!kind.describesPick)
                continue;
            const std::vector<OverlayLine> lines = source->describePick(scene, 0);
            EXPECT_FALSE(lines.empty()) << kind.name;
            for (const OverlayLine& line : lines)
                EXPECT_EQ(line.text.empty(), line.style == OverlayLine::Style::Separator);
        }
        const std::uint32_t count = source->pickCount();
        EXPECT_TRUE(count == 0 || source->nearestPick(*source, count / 2));
    }
}

// What holds of every technique.
TEST(Techniques, LightIsFiniteAndDoublesWithWhatShinesAndIsKeptWhileNothingChanges) {
    Scene scene = smallRoom();
    scene.materials[0].baseColor = glm::vec4(glm::vec3(0.5f), 1);
    for (const Technique* technique : techniques()) {
        SCOPED_TRACE(technique->name);
        Lit lit(*technique, scene);
        const LightingReport first = lit.update();
        EXPECT_FALSE(first.skipped);
        EXPECT_TRUE(first.whole);
        EXPECT_FALSE(first.steps.empty());
        double steps = 0;
        for (const LightingStep& step : first.steps) {
            EXPECT_TRUE(step.label && step.tooltip);
            EXPECT_GE(step.ms, 0) << step.id;
            steps += step.ms;
        }
        EXPECT_LE(steps, first.totalMs * 1.001 + 0.01);
        const std::vector<glm::vec3> once = lit.irradiance();
        for (const glm::vec3 e : once)
            for (int c = 0; c < 3; ++c)
                EXPECT_TRUE(std::isfinite(e[c]) && e[c] >= 0);
        EXPECT_GT(once[0].x, 0);
        EXPECT_TRUE(first.converged);
        EXPECT_TRUE(lit.update().skipped) << "nothing changed";
        EXPECT_EQ(lit.irradiance(), once);
        lit.scene.sky.radiance *= 2;
        lit.scene.lights[0].strength *= 2;
        lit.update();
        const std::vector<glm::vec3> twice = lit.irradiance();
        for (std::size_t i = 0; i < once.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(twice[i][c], 2 * once[i][c], 2e-3f * (once[i][c] + 1e-3f));
    }
}

TEST(Ambient, IsPiTimesTheMeanOfTheSkyOnEverySurface) {
    Scene scene = *litRoom(300, 400);
    scene.sky = {.kind = SkyKind::Gradient,
                 .radiance = glm::vec3(3),
                 .horizon = glm::vec3(1),
                 .ground = glm::vec3(2)};
    Lit lit(*findTechnique("ambient"), scene);
    lit.update();
    // Linear in the sine of the elevation, which is uniform over the sphere: means of both halves.
    const double mean = (0.5 * (3 + 1) + 0.5 * (2 + 1)) / 2;
    for (const glm::vec3 e : lit.irradiance())
        EXPECT_NEAR(e.x, std::numbers::pi * mean, 1e-3);
    lit.scene.technique.settings = {{"ambient.constant", 1}, {"ambient.radiance", 0.25}};
    lit.update();
    for (const glm::vec3 e : lit.irradiance())
        EXPECT_NEAR(e.y, std::numbers::pi * 0.25, 1e-5);
    lit.scene.technique.settings["ambient.radiance"] = -7;
    lit.update();
    for (const glm::vec3 e : lit.irradiance())
        EXPECT_EQ(e, glm::vec3(0)) << "values are kept to their range";
}

/// A pipe would make a reader wait for ever.
TEST(Techniques, APipeIsNotReadAsAFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo(folder.file("pipe.limnbake").c_str(), 0600), 0);
    const auto read = readPrecomputed(folder.file("pipe.limnbake"));
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("not a regular file"), std::string::npos)
        << read.error().message;
}

} // namespace
} // namespace limn::technique_test
