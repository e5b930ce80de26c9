// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/comparison_job.h"
#include "editor_ui/jobs/reference_job.h"
#include "editor_ui/panels/action.h"
#include "engine/files/image_file.h"
#include "engine/measure/compare.h"
#include "tests/core/source_path.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/small_session.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace limn::reference_job_test {
namespace {

constexpr std::uint32_t kWidth = 24, kHeight = 18;

std::shared_ptr<const Scene> smallScene(float lamp = 1) {
    const auto project = loadProject(sourcePath("projects/cornell/cornell.limn"));
    Document document = project->document;
    addObject(document, Light{.name = "Lamp", .position = {0, 1, 0.3f}, .strength = lamp});
    return std::make_shared<const Scene>(flatten(document, project->assets));
}

ReferenceOrder orderFor(std::shared_ptr<const Scene> scene, double noise) {
    const Camera camera = chooseCamera(*scene, {});
    return {std::move(scene), View::Irradiance, camera, kWidth, kHeight, noise};
}

/// Waits until the job rests; returns what it has then.
ReferenceProgress finished(const ReferenceJob& job) {
    for (int i = 0; i < 12000 && job.progress().running; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_FALSE(job.progress().running);
    return job.progress();
}

/// The same set rendered in the open, with as many passes.
ReferenceSet expectedSet(const ReferenceOrder& order, std::uint32_t passes) {
    const TraceScene trace(*order.scene);
    const ReferenceOptions options{.view = order.view,
                                   .camera = order.camera,
                                   .width = order.width,
                                   .height = order.height,
                                   .samplesPerPixel = 1};
    ReferenceSet set = *renderReferenceSet(trace, options);
    while (set.passes < passes)
        refine(set, trace, options);
    return set;
}

TEST(ReferenceJob, RefinesUntilTheNoiseIsThatOfTheOrder) {
    ReferenceJob job([] {});
    const ReferenceOrder order = orderFor(smallScene(), 0.2);
    job.set(order);
    const ReferenceProgress done = finished(job);
    ASSERT_TRUE(done.set);
    EXPECT_LE(done.noise, 0.2);
    const ReferenceSet expected = expectedSet(order, done.set->passes);
    EXPECT_EQ(done.set->parts, expected.parts);
    EXPECT_GT(noiseOf(expectedSet(order, done.set->passes - 1)),
              0.2); // half the samples were not enough
}

TEST(ReferenceJob, GoesOnWhereLessNoiseIsAskedFor) {
    ReferenceJob job([] {});
    ReferenceOrder order = orderFor(smallScene(), 0.4);
    job.set(order);
    const auto first = finished(job).set;
    order.noise = 0.15;
    job.set(order);
    const ReferenceProgress done = finished(job);
    EXPECT_LE(done.noise, 0.15);
    EXPECT_EQ(done.set->parts, expectedSet(order, done.set->passes).parts);
    EXPECT_GT(done.set->passes, first->passes);
}

TEST(ReferenceJob, ForgetsThePictureOfAnotherViewOrOtherLightAlone) {
    ReferenceJob job([] {});
    ReferenceOrder order = orderFor(smallScene(), 0.4);
    job.set(order);
    const auto set = finished(job).set;

    auto settings = std::make_shared<Scene>(*order.scene);
    settings->bake.surfels = 77; // a bake's settings change no ray
    order.scene = settings;
    job.set(order);
    EXPECT_EQ(job.progress().set, set);
    EXPECT_FALSE(job.progress().running);

    order.scene = smallScene(3);
    job.set(order);
    EXPECT_EQ(job.progress().set, nullptr);
    const auto brighter = finished(job).set;
    EXPECT_EQ(brighter->parts, expectedSet(order, brighter->passes).parts);
    EXPECT_NE(brighter->parts, set->parts);

    order.camera.eye.x += 0.1f;
    job.set(order);
    EXPECT_EQ(job.progress().set, nullptr);
    job.set(std::nullopt);
    EXPECT_FALSE(job.progress().running);
}

/// Seconds that the destructor takes.
double secondsToEnd(std::unique_ptr<ReferenceJob> job) {
    const auto start = std::chrono::steady_clock::now();
    job.reset();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(ReferenceJob, EndsInTheMiddleOfAPass) {
    auto job = std::make_unique<ReferenceJob>([] {});
    ReferenceOrder order = orderFor(smallScene(), 1e9); // one pass, if it is not ended
    order.width = 1600, order.height = 1200;
    job->set(order);
    ReferenceProgress begun;
    for (int i = 0; i < 12000 && begun.fraction == 0; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        begun = job->progress();
    }
    ASSERT_FALSE(begun.set);
    ASSERT_GT(begun.fraction, 0);
    const double rest = begun.seconds * (1 - begun.fraction) / begun.fraction;
    EXPECT_LT(secondsToEnd(std::move(job)), 0.25 * rest);
}

struct ComparisonTest : testing::Test {
    ReferenceOrder order = orderFor(smallScene(), 1);
    std::shared_ptr<const ReferenceSet> set =
        std::make_shared<const ReferenceSet>(expectedSet(order, 5));
    ComparisonJob job{[] {}};

    ComparedPicture compare(ComparisonOrder wanted) {
        job.set(std::move(wanted));
        for (int i = 0; i < 12000 && job.busy(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return job.result();
    }
};

TEST_F(ComparisonTest, APictureOfHalfTheLightHasABiasOfMinusFiftyPercent) {
    auto half = std::make_shared<ImageF>(meanImage(set->first(), set->second()));
    for (glm::vec3& c : half->rgb)
        c *= 0.5f;
    const ComparedPicture compared = compare({set, half, Compare::Reference, Tonemap::None, 0});
    ASSERT_TRUE(compared.image);
    ASSERT_TRUE(compared.error);
    EXPECT_NEAR(compared.error->bias, -0.5, 1e-5);
}

TEST_F(ComparisonTest, WithoutAPictureOfItsSizeTheReferenceAloneIsShown) {
    EXPECT_FALSE(compare({set, nullptr, Compare::Reference, Tonemap::Aces, 0}).error);
    EXPECT_TRUE(job.result().image);
    auto small = std::make_shared<ImageF>(ImageF{2, 2, std::vector<glm::vec3>(4)});
    EXPECT_FALSE(compare({set, small, Compare::Reference, Tonemap::Aces, 0}).error);
    EXPECT_FALSE(compare({set, small, Compare::Difference, Tonemap::Aces, 0})
                     .image); // no difference to show
}

TEST_F(ComparisonTest, TheDifferenceToItselfIsOneColour) {
    const auto same = std::make_shared<const ImageF>(meanImage(set->first(), set->second()));
    for (const Compare shown : {Compare::Difference, Compare::Flip, Compare::SquaredError}) {
        const ComparedPicture compared = compare({set, same, shown, Tonemap::Aces, 0});
        ASSERT_TRUE(compared.image);
        const auto& rgba = compared.image->rgba;
        for (std::size_t i = 0; i < rgba.size(); i += 4)
            EXPECT_TRUE(
                std::equal(rgba.begin(), rgba.begin() + 4, rgba.begin() + std::ptrdiff_t(i)));
    }
}

TEST_F(ComparisonTest, FlipShowsThePerceivedDifferenceAndNotTheSignedOne) {
    auto half = std::make_shared<ImageF>(meanImage(set->first(), set->second()));
    const ImageF mean = *half;
    for (glm::vec3& c : half->rgb)
        c *= 0.5f;
    const ComparedPicture flip = compare({set, half, Compare::Flip, Tonemap::Aces, 0});
    ASSERT_TRUE(flip.image);
    EXPECT_EQ(flip.image->rgba, flipHeatmap(*half, mean).rgba);
    const ComparedPicture difference = compare({set, half, Compare::Difference, Tonemap::Aces, 0});
    ASSERT_TRUE(difference.image);
    EXPECT_NE(flip.image->rgba, difference.image->rgba);
    const ComparedPicture squared = compare({set, half, Compare::SquaredError, Tonemap::Aces, 0});
    ASSERT_TRUE(squared.image);
    EXPECT_EQ(squared.image->rgba, squaredErrorHeatmap(*half, mean).rgba);
}

TEST(SessionReference, StandsBesideThePictureAndIsTakenAwayAgain) {
    Session session({.projectsFolder = sourcePath("projects"), .wake = [] {}, .bakeOnOpen = false});
    session.state.view.size = {float(kWidth), float(kHeight)};
    session.open(sourcePath("projects/cornell/cornell.limn"));
    ASSERT_TRUE(runUntil(session, [&] { return session.idle() && session.state.trace; }));
    session.state.compare.mode = Compare::Reference;
    session.state.compare.noise = 0.5;
    ASSERT_TRUE(runUntil(session, [&] { return session.compared().image != nullptr; }));
    EXPECT_EQ(session.compared().image->width, kWidth);
    EXPECT_FALSE(session.compared().error); // no window has drawn a picture
    LinearPicture picture{{kWidth, kHeight, std::vector<glm::vec3>(kWidth * kHeight)},
                          session.state.view.camera,
                          session.state.view.view};
    session.setPicture(std::make_shared<const LinearPicture>(picture));
    ASSERT_TRUE(
        runUntil(session, [&] { return session.state.compare.reference.error.has_value(); }));
    EXPECT_NEAR(session.state.compare.reference.error->bias, -1, 1e-6); // black

    const TemporaryFolder folder;
    ASSERT_TRUE(actionById("compare.save").enabled(session.state));
    session.state.requests.push_back({Request::Kind::SavePictures, folder.file("room.exr")});
    session.update();
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    EXPECT_FALSE(session.state.notice);
    const Result<ImageF> ours = readFloatImage(folder.file("room-limn.exr"));
    const Result<ImageF> theirs = readFloatImage(folder.file("room-reference.exr"));
    ASSERT_TRUE(ours) << ours.error().message;
    ASSERT_TRUE(theirs) << theirs.error().message;
    EXPECT_TRUE(*ours == picture.image);
    const Result<Comparison> compared = compareImages(*ours, *theirs);
    ASSERT_TRUE(compared);
    EXPECT_NEAR(compared->bias, -1, 1e-6);
    session.state.requests.push_back({Request::Kind::SavePictures, folder.file("absent/room.exr")});
    session.update();
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    ASSERT_TRUE(session.state.notice);
    EXPECT_NE(session.state.notice->text.find("absent/room-limn.exr"), std::string::npos);

    session.state.compare.mode = Compare::Off;
    session.update();
    EXPECT_FALSE(actionById("compare.save").enabled(session.state));
    EXPECT_FALSE(session.compared().image);
    EXPECT_EQ(session.state.compare.reference.samples, 0u);
}

} // namespace
} // namespace limn::reference_job_test
