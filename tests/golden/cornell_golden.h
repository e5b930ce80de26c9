// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "engine/measure/compare.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/core/source_path.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace limn::golden {

/// The sample project "cornell", baked smaller than its default so that a sanitizer can follow, and
/// lit to convergence.
struct LitCornell {
    Scene scene;
    Camera camera;
    std::unique_ptr<TraceScene> trace;
    std::shared_ptr<const Bake> bake;
    std::unique_ptr<Relighter> relighter;
};

inline LitCornell litCornell() {
    const Result<ImportedScene> imported = openAny("cornell", sourcePath("projects"));
    if (!imported)
        throw std::runtime_error(imported.error().message);
    LitCornell lit;
    lit.scene = flatten(imported->document, imported->assets);
    lit.scene.bake.surfels = 8192;
    lit.scene.bake.links = 192;
    lit.scene.bake.rays = 256;
    lit.scene.bake.lightmapCaches = 6000;
    lit.camera = chooseCamera(lit.scene, std::nullopt);
    lit.trace = std::make_unique<TraceScene>(lit.scene);
    Result<Bake> baked = bake(*lit.trace);
    if (!baked)
        throw std::runtime_error(baked.error().message);
    lit.bake = std::make_shared<const Bake>(std::move(*baked));
    lit.relighter = std::make_unique<Relighter>(lit.bake);
    lit.relighter->relight(lit.scene, *lit.trace, lit.scene.relight.maxBounces);
    return lit;
}

/// Compares an `irradiance` picture of 64 x 64 pixels with the path-traced one: 8192 samples per
/// pixel, standard error 0.62 % of the mean. What is allowed is what Limn promises of this scene,
/// an nRMSE of 0.10 and a bias of 3 %; the truth's own noise is a sixteenth of that and takes no
/// part. A failure leaves picture and error map behind.
inline void expectCornellIrradiance(const ImageF& picture, const std::string& name) {
    const Result<ImageF> truth = readFloatImage(sourcePath("tests/golden/cornell_irradiance.exr"));
    ASSERT_TRUE(truth) << truth.error().message;
    const Result<Comparison> error = compareImages(picture, *truth);
    ASSERT_TRUE(error) << error.error().message;
    EXPECT_EQ(error->invalidPixels, 0U);
    EXPECT_LE(error->nrmse, 0.10);
    EXPECT_LE(std::abs(error->bias), 0.03);
    if (testing::Test::HasFailure()) {
        EXPECT_TRUE(writeExr(name + ".exr", picture));
        EXPECT_TRUE(writePng(name + "_error.png", errorHeatmap(picture, *truth)));
    }
}

} // namespace limn::golden
