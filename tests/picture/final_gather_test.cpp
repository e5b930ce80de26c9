// SPDX-License-Identifier: MIT
#include "engine/picture/final_gather_walk.h"

#include "engine/core/parallel.h"
#include "engine/measure/compare.h"
#include "engine/reference/reference.h"
#include "tests/picture/two_plates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace limn::final_gather_test {
namespace {

/// A plane of coarse texels below a black plate of 4 m, under an even sky. The field has the same
/// emitted light everywhere on the plane. Nothing reflects.
struct BelowAPlate {
    TwoPlates plates{plateAbove(1), 0};
    Scene scene;
    FieldRenderOptions options;

    /// `lamp`: the plate shines as well. `field`: the radiance that the field holds.
    explicit BelowAPlate(glm::vec3 field, glm::vec3 lamp = glm::vec3(0)) {
        plates.builder.scene.sky.radiance = {1, 2, 3};
        plates.builder.scene.materials[1].emission = lamp;
        plates.setField(0, {0, 1, 0}, field);
        scene = plates.builder.build();
        options.view = View::Irradiance;
        options.camera.eye = {3, 0.7f, 3};
        options.camera.target = {0, 0, 0};
        options.width = 36; // no multiple of the tiles
        options.height = 20;
        options.samplesPerPixel = 64;
        options.gatherRays = 1;
        options.emitted = std::make_shared<const IndirectField>(plates.field);
    }
    ImageF drawn(const FieldRenderOptions& how) const {
        return renderField(TraceScene(scene), plates.field, *plates.layout, how);
    }
    ImageF truth() const {
        ReferenceOptions r;
        r.view = options.view;
        r.camera = options.camera;
        r.width = options.width;
        r.height = options.height;
        r.samplesPerPixel = 4096;
        return renderReference(TraceScene(scene), r).image;
    }
    double error(const FieldRenderOptions& how, const ImageF& truth) const {
        return compareImages(drawn(how), truth)->nrmse;
    }
};

TEST(FinalGather, ShowsWhatRaysFindInPlaceOfTheField) {
    for (const glm::vec3 lamp : {glm::vec3(0), glm::vec3(2, 1, 0.5f)}) {
        const BelowAPlate s(glm::vec3(0.4f, 0.8f, 1.2f), lamp);
        const ImageF truth = s.truth();
        FieldRenderOptions without = s.options;
        without.gatherRays = 0;
        const double before = s.error(without, truth), after = s.error(s.options, truth);
        EXPECT_GT(before, 0.3);
        EXPECT_LT(after, 0.2 * before);
        // Four rays of a quarter of the samples are as good.
        FieldRenderOptions four = s.options;
        four.samplesPerPixel = 16;
        four.gatherRays = 4;
        EXPECT_LT(s.error(four, truth), 0.2 * before);
    }
}

/// Each sample finds exactly pi times the radiance, so a second stage has nothing to add, and
/// nothing is shrunk.
TEST(FinalGather, IsExactUnderAnOpenSky) {
    BelowAPlate s(glm::vec3(0.2f));
    s.scene.instances[1].toWorld[3].y = -2; // the plate lies below
    s.options.camera.eye = {0.3f, 0.9f, 0.3f};
    const ImageF image = s.drawn(s.options);
    for (const glm::vec3 E : image.rgb) {
        EXPECT_NEAR(E.x, glm::pi<float>(), 1e-3f);
        EXPECT_NEAR(E.z, 3 * glm::pi<float>(), 3e-3f);
    }
}

/// Root of the mean squared error of the irradiance of a floor under a roof on thin air, where the
/// field says that `radiance` comes from all sides. In truth, half of the hemisphere over each
/// point is open.
double errorBelowStripes(float radiance) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0)));
    Material grid = simple::lambert(glm::vec3(0));
    grid.alphaMode = AlphaMode::Mask;
    grid.doubleSided = true;
    b.assets->images.push_back({"holes", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    grid.baseColorTexture.image = 0;
    grid.baseColorTexture.nearest = true;
    b.addMaterial(grid);
    Mesh roof = simple::quad({-40, 1, -40}, {80, 0, 0}, {0, 0, 80}, 1);
    roof.uv0 = {{0, 0}, {4000, 0}, {4000, 1}, {0, 1}}; // stripes 1 cm wide
    b.add(simple::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    b.add(roof);
    b.scene.sky.radiance = glm::vec3(1);
    const Scene scene = b.build();
    IndirectField field;
    field.gridSize = {1, 1, 1};
    field.gridBounds = {glm::vec3(-4), glm::vec3(4)};
    field.grid.assign(9, glm::vec4(0));
    field.grid[0] = glm::vec4(std::sqrt(4 * glm::pi<float>()) * glm::vec3(radiance), 0);
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera.eye = {0.1f, 0.9f, 0.1f};
    options.camera.target = {0, 0, 0};
    options.width = 32;
    options.height = 24;
    options.samplesPerPixel = 16;
    options.gatherRays = 1;
    options.emitted = std::make_shared<const IndirectField>(field);
    const TraceScene trace(scene);
    const ImageF image = renderField(trace, field, {}, options);
    double squared = 0;
    for (const glm::vec3 E : image.rgb)
        squared += std::pow(double(E.x) - glm::pi<double>() / 2, 2) / double(image.rgb.size());
    return std::sqrt(squared);
}
// Of a pixel, whose 16 random samples are 0 or pi.
constexpr double kErrorOfSamples = glm::pi<double>() / 8;

/// Where the field is right, its light has less error than noisy samples.
TEST(FinalGather, LeavesAFieldThatIsRightAlone) {
    EXPECT_LT(errorBelowStripes(0.5f), 0.2 * kErrorOfSamples);
}

/// The mean of many pixels has so little variance that it corrects what no pixel alone could.
TEST(FinalGather, CorrectsErrorsThatAreBelowTheNoise) {
    for (const double wrong : {-0.08, 0.08}) {
        const double before = std::abs(wrong) * glm::pi<double>();
        EXPECT_LT(before, kErrorOfSamples);
        EXPECT_LT(errorBelowStripes(float(0.5 + wrong)), 0.4 * before);
    }
}

/// Irradiance in the middle of the plane, whose own field is dark, from a grey plate `height` above
/// it whose field is `light`.
double belowAGreyPlate(float height, float light) {
    TwoPlates plates(plateAbove(height));
    plates.setField(1, {0, -1, 0}, glm::vec3(light));
    plates.builder.scene.sky.radiance = glm::vec3(1e-6f); // without light there is no field
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera.eye = {0.02f, 0.2f, 0.02f};
    options.camera.target = {0, 0, 0};
    options.camera.fovY = 0.3f;
    options.width = options.height = 16;
    options.samplesPerPixel = 64;
    options.gatherRays = 16;
    IndirectField dark = plates.field;
    std::ranges::fill(dark.lightmap, glm::vec4(0));
    options.emitted = std::make_shared<const IndirectField>(dark);
    return meanOf(
        renderField(TraceScene(plates.builder.build()), plates.field, *plates.layout, options));
}

/// From a plate of 4 m to a point `h` below its middle.
double formFactorOfPlate(double h) {
    const double a = 2, r = std::sqrt(a * a + h * h);
    return 4 * a / (glm::pi<double>() * r) * std::atan(a / r);
}

// The plate's texels are 4/3 m wide, so the field is read where rays are longer than 16/3 m.
constexpr double kSent = 0.5 * glm::pi<double>() * 3; ///< albedo times irradiance

TEST(FinalGather, ReadsTheFieldWhereRaysEnd) {
    const double light = formFactorOfPlate(5.5) * kSent;
    EXPECT_NEAR(belowAGreyPlate(5.5f, 3), light, 0.03 * light);
}

/// Where the plate is 5 m away, rays to a disc in its middle are too short. They go on to the
/// plane, and not a tenth of them meets the plate again.
TEST(FinalGather, GoesOnWhereRaysAreShorterThanSomeTexels) {
    const double h = 5, toRim = 16. / 3, disc = 1 - h * h / (toRim * toRim);
    const double light = (formFactorOfPlate(h) - disc) * kSent;
    EXPECT_NEAR(belowAGreyPlate(float(h), 3), light, 0.1 * light);
    // Between the plates a ray ends in the field when less than 3 % of its light is left.
    EXPECT_NEAR(belowAGreyPlate(0.5f, 3), 0, 0.03 * kSent);
}

TEST(FinalGather, NeedsNoNearLight) {
    BelowAPlate s(glm::vec3(0.4f));
    s.options.samplesPerPixel = 16;
    const ImageF without = s.drawn(s.options);
    s.options.nearRays = 4;
    EXPECT_EQ(s.drawn(s.options).rgb, without.rgb);
}

/// Half of the picture is dark. Where that begins, the field itself is noisy.
TEST(FinalGather, TakesMoreSamplesOfTheFieldAtEdges) {
    BelowAPlate s(glm::vec3(1, 2, 3)); // as the sky's
    s.scene.instances[1].toWorld[3].y = -2;
    s.options.camera.eye = {5, 3, 0.3f};
    s.options.samplesPerPixel = 16;
    FieldRenderOptions without = s.options;
    without.gatherRays = 0;
    FieldRenderOptions finely = without;
    finely.samplesPerPixel = 4096;
    const ImageF fine = s.drawn(finely);
    const double before = compareImages(s.drawn(without), fine)->nrmse;
    EXPECT_GT(before, 0.01);
    EXPECT_LT(compareImages(s.drawn(s.options), fine)->nrmse, 0.5 * before);
}

TEST(FinalGather, DoesNothingWhereItIsNotAskedFor) {
    BelowAPlate s(glm::vec3(1));
    const auto any = [&](const FieldRenderOptions& o) {
        const TraceScene trace(s.scene);
        return FinalGather(trace, s.plates.field, *s.plates.layout, o).any();
    };
    EXPECT_TRUE(any(s.options));
    FieldRenderOptions o = s.options;
    o.gatherRays = 0;
    EXPECT_FALSE(any(o));
    o = s.options;
    o.samplesPerPixel = 1;
    EXPECT_FALSE(any(o));
    o = s.options;
    o.emitted = nullptr;
    EXPECT_FALSE(any(o));
    for (const View view : {View::Direct, View::Albedo, View::Normals}) {
        o = s.options;
        o.view = view;
        EXPECT_FALSE(any(o));
    }
    s.scene.sky = {};
    EXPECT_FALSE(any(s.options)) << "nothing shines";
    s.scene.lights.emplace_back();
    EXPECT_TRUE(any(s.options));
}

TEST(FinalGather, IsTheSameForAnyNumberOfThreadsAndPieceByPiece) {
    struct Sum {
        glm::dvec3 value{0}; // of a million terms
        static bool reflects(std::uint32_t) { return true; }
        void fieldIrradiance(const FieldPoint& point, glm::vec3 weight, GatherPart) {
            value += glm::dvec3(weight * sampleIrradiance(point));
        }
        // There is no light.
        void gatheredDirectLight(const SurfacePoint&, const LightNumbers&, glm::vec3,
                                 std::uint32_t) {}
        void rayBegins(const EmittedLightSample&) {}
        void rayEnds() {}
        void gatheredEmission(const IncidentLightSample&, glm::vec3 light, GatherPart,
                              std::uint32_t) {
            value += glm::dvec3(light);
        }
    };
    BelowAPlate s(glm::vec3(0.4f), glm::vec3(1, 0, 0));
    s.options.samplesPerPixel = 16;
    const TraceScene trace(s.scene);
    const FinalGather gather(trace, s.plates.field, *s.plates.layout, s.options);
    const ImageF black{36, 20, std::vector<glm::vec3>(720, glm::vec3(0))};
    ImageF one = black, many = black;
    {
        const ThreadLimit limit(1);
        ASSERT_TRUE(gather.addTo(one));
    }
    ASSERT_TRUE(gather.addTo(many));
    EXPECT_EQ(one.rgb, many.rgb);
    for (const std::uint32_t pixel : {0U, 100U, 377U, 719U}) {
        Sum sum;
        gather.walk(pixel % 36, pixel / 36, sum);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(sum.value[k], one.rgb[pixel][k], 1e-4f);
    }
}

TEST(FinalGather, CanBeCancelled) {
    const BelowAPlate s(glm::vec3(1));
    const TraceScene trace(s.scene);
    const FinalGather gather(trace, s.plates.field, *s.plates.layout, s.options);
    ImageF image{36, 20, std::vector<glm::vec3>(720, glm::vec3(0))};
    const std::atomic<bool> cancelled = true;
    Progress progress;
    progress.cancel = &cancelled;
    EXPECT_FALSE(gather.addTo(image, progress));
}

} // namespace
} // namespace limn::final_gather_test
