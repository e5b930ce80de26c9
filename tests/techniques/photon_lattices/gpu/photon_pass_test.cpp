// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/gpu/photon_pass.h"

#include "tests/render/viewport_fixture.h"
#include "tests/techniques/photon_lattices/lit_by_photons.h"

#include <algorithm>
#include <cmath>

namespace limn::photon_pass_test {
namespace {

/// A floor that the picture shows, between walls of metal and paint that it does not.
Scene court() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.6f, 0.5f}));
    b.addMaterial(mirror({0.9f, 0.7f, 0.4f}));
    b.add(simple::box({-2.5f, 0, -2.7f}, {2.3f, 1.9f, 2.4f}, true));
    b.add(simple::box({2.1f, 0, -1}, {2.2f, 1.5f, 1}, false, 1));
    // Below the floor, so that the floor lies in the faces of cells.
    b.add(simple::quad({0, -1.9f, 0}, {0, 0, 0.1f}, {0.1f, 0, 0}));
    b.scene.lights = {{.kind = LightKind::Point,
                       .position = {-1.3f, 1.4f, 0.2f},
                       .color = {1, 0.8f, 0.5f},
                       .strength = 9}};
    return b.build();
}

using PhotonPassTest = ViewportTest;

TEST_F(PhotonPassTest, DrawsTheLightOfTheCpu) {
    options.camera.eye = {0, 1.8f, 0};
    options.camera.fovY = 1.5f;
    for (const PhotonChoice& choice :
         {PhotonChoice{}, PhotonChoice{{"mode", 1}}, PhotonChoice{{"lookup", 1}},
          PhotonChoice{{"splat", 1}}, PhotonChoice{{"splat", 2}, {"splat_radius", 0.04}}}) {
        LitByPhotons lit(court(), choice);
        lit.set("high", 40);
        lit.update();
        viewport->setIndirect(*lit.lighting->field(),
                              photonPass(*device, *viewport, *lit.lighting->field()));
        const ImageF image = draw(lit.scene, View::Irradiance);
        double largest = 0, maximum = 0, squares = 0;
        for (std::uint32_t y = 0; y < options.height; ++y)
            for (std::uint32_t x = 0; x < options.width; ++x) {
                const glm::vec3 e = lit.irradiance(planePoint(options, x, y), {0, 1, 0});
                for (int c = 0; c < 3; ++c) {
                    const double difference = std::abs(double(pixel(image, x, y)[c] - e[c]));
                    largest = std::max(largest, double(e[c]));
                    maximum = std::max(maximum, difference);
                    squares += difference * difference;
                }
            }
        ASSERT_GT(largest, 0);
        const double rms = std::sqrt(squares / (3. * options.width * options.height));
        std::printf("%s: max %.1e rms %.1e of the largest\n",
                    choice.empty() ? "usual" : choice.begin()->first.c_str(), maximum / largest,
                    rms / largest);
        EXPECT_LT(maximum, 1e-5 * largest);
        EXPECT_LT(rms, 1e-6 * largest);
    }
}

TEST_F(PhotonPassTest, IsBlackWithoutLight) {
    Scene scene = court();
    scene.lights.clear();
    LitByPhotons lit(scene);
    lit.update();
    const auto pass = photonPass(*device, *viewport, *lit.lighting->field());
    EXPECT_GT(pass->bytes(), 0U);
    viewport->setIndirect(*lit.lighting->field(), pass);
    const ImageF image = draw(lit.scene, View::Irradiance);
    EXPECT_EQ(pixel(image, 9, 9), glm::vec3(0));
}

} // namespace
} // namespace limn::photon_pass_test
