// SPDX-License-Identifier: MIT
#include "tests/core/source_path.h"
#include "tests/golden/cornell_golden.h"

#include "engine/picture/field_render.h"
#include "engine/reference/reference.h"

namespace limn::golden_test {
namespace {

TEST(Golden, TheFieldOfTheCornellBoxIsCloseToItsPathTracedPicture) {
    const golden::LitCornell lit = golden::litCornell();
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera = lit.camera;
    options.width = options.height = 64;
    golden::expectCornellIrradiance(
        renderField(*lit.trace, lit.relighter->field(), lit.bake->lightmap, options),
        "golden_field");
}

TEST(Golden, AFewPathsOfTheCornellBoxAgreeWithinTheirOwnNoise) {
    const Result<ImportedScene> imported = openAny("cornell", sourcePath("projects"));
    ASSERT_TRUE(imported) << imported.error().message;
    const Scene scene = flatten(imported->document, imported->assets);
    ReferenceOptions options;
    options.view = View::Irradiance;
    options.camera = chooseCamera(scene, std::nullopt);
    options.width = options.height = 64;
    options.samplesPerPixel = 32;
    options.seed = 11;
    const ReferenceResult few = renderReference(TraceScene(scene), options);
    const Result<ImageF> truth = readFloatImage(sourcePath("tests/golden/cornell_irradiance.exr"));
    ASSERT_TRUE(truth) << truth.error().message;
    const Result<Comparison> error = compareImages(few.image, *truth);
    ASSERT_TRUE(error) << error.error().message;
    // 4096 independent pixels: the rms error is the noise itself, the mean's is noise / 64. Five
    // standard errors.
    EXPECT_NEAR(error->nrmse, few.noise, 0.2 * few.noise);
    EXPECT_LE(std::abs(error->bias), 5 * few.noise / 64);
}

} // namespace
} // namespace limn::golden_test
