// SPDX-License-Identifier: MIT
#include "engine/scene/tone_map.h"
#include "tests/render/viewport_fixture.h"

namespace limn::tonemap_test {

class ViewportTonemap : public ViewportTest {
protected:
    /// The display value of a sky of radiance `L`.
    glm::ivec3 shown(glm::vec3 L, Tonemap curve, float exposureEv = 0) {
        Scene scene;
        scene.assets = std::make_shared<Assets>();
        scene.sky.radiance = L;
        viewport->setScene(scene, nullptr);
        options.view = View::Lit;
        options.tonemap = curve;
        options.exposureEv = exposureEv;
        options.width = options.height = 2;
        viewport->render(options);
        const Image image = viewport->readTonemapped();
        EXPECT_EQ(image.rgba[3], 255);
        return {image.rgba[0], image.rgba[1], image.rgba[2]};
    }
};

static int srgb(float linear) {
    const float c =
        linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
    return int(std::lround(255 * std::min(c, 1.f)));
}

static void expectClose(glm::ivec3 shown, glm::ivec3 expected) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(shown[c], expected[c], 1) << "channel " << c;
}

TEST_F(ViewportTonemap, NoneIsTheSrgbCurveCutAtOne) {
    expectClose(shown({0.001f, 0.18f, 0.5f}, Tonemap::None),
                {srgb(0.001f), srgb(0.18f), srgb(0.5f)});
    expectClose(shown({0, 1, 7}, Tonemap::None), {0, 255, 255});
}

TEST_F(ViewportTonemap, ExposureIsAFactorOfTwoPerStop) {
    for (Tonemap curve : {Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::PbrNeutral}) {
        const glm::vec3 L(0.1f, 0.2f, 0.3f);
        EXPECT_EQ(shown(L, curve, 2), shown(4.f * L, curve)) << kTonemapNames[std::size_t(curve)];
        EXPECT_EQ(shown(L, curve, -3), shown(L / 8.f, curve));
    }
}

TEST_F(ViewportTonemap, EveryCurveTakesBlackToBlackNeverFallsAndEndsNearWhite) {
    for (Tonemap curve : {Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::PbrNeutral}) {
        EXPECT_EQ(shown(glm::vec3(0), curve), glm::ivec3(0)) << kTonemapNames[std::size_t(curve)];
        int last = 0;
        for (float L = 1e-4f; L < 1e9f; L *= 3) {
            const glm::ivec3 s = shown(glm::vec3(L), curve);
            EXPECT_GE(s.g, last) << kTonemapNames[std::size_t(curve)] << " at " << L;
            EXPECT_LE(std::abs(s.r - s.g) + std::abs(s.b - s.g), 4) << "grey stays grey";
            last = s.g;
        }
        EXPECT_GE(last, 250) << kTonemapNames[std::size_t(curve)];
    }
}

TEST_F(ViewportTonemap, NeutralKeepsColoursBelowItsKneeButForTheToe) {
    // Khronos: colours whose peak is below 0.76 + 0.04 lose the offset 0.04 when their least
    // channel is above 0.08.
    expectClose(shown({0.3f, 0.5f, 0.7f}, Tonemap::PbrNeutral),
                {srgb(0.26f), srgb(0.46f), srgb(0.66f)});
    // Above: peak 2 - 0.04 becomes 1 - 0.24^2 / (1.96 + 0.24 - 0.76).
    const float peak = 1 - 0.24f * 0.24f / (1.96f + 0.24f - 0.76f);
    EXPECT_NEAR(shown(glm::vec3(2), Tonemap::PbrNeutral).r, srgb(peak), 1);
}

TEST_F(ViewportTonemap, AcesIsHillsFit) {
    // Grey stays grey through both matrices (rows sum to 1 within 1e-4), so the fit alone is seen.
    const float L = 0.5f;
    const float fit =
        (L * (L + 0.0245786f) - 0.000090537f) / (L * (0.983729f * L + 0.4329510f) + 0.238081f);
    EXPECT_NEAR(shown(glm::vec3(L), Tonemap::Aces).g, srgb(fit), 1);
}

TEST_F(ViewportTonemap, AgxPutsMiddleGreyNearTheMiddle) {
    // AgX's log encoding puts 0.18 at 10 / 16.5 of its range; the contrast curve takes that to
    // about half, and the result is raised to 2.2 before the sRGB curve: display value 0.46 to
    // 0.52.
    const int grey = shown(glm::vec3(0.18f), Tonemap::Agx).g;
    EXPECT_GE(grey, 117);
    EXPECT_LE(grey, 133);
}

TEST_F(ViewportTonemap, IsTheSameOnTheCpu) {
    for (Tonemap curve : {Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::PbrNeutral})
        for (glm::vec3 L : {glm::vec3(0), glm::vec3(0.02f, 0.3f, 0.1f), glm::vec3(0.9f, 0.1f, 0.5f),
                            glm::vec3(3, 0.2f, 1), glm::vec3(40, 70, 3), glm::vec3(1e8f)}) {
            const Image cpu = toneMappedImage({1, 1, {L}}, curve, 0.5f);
            expectClose(shown(L, curve, 0.5f), {cpu.rgba[0], cpu.rgba[1], cpu.rgba[2]});
        }
}

TEST_F(ViewportTonemap, DataViewsAreShownAsTheyAre) {
    simple::SceneBuilder b = plane();
    viewport->setScene(b.build(), nullptr);
    options.view = View::Albedo;
    options.tonemap = Tonemap::Agx;
    options.exposureEv = 5;
    viewport->render(options);
    const Image image = viewport->readTonemapped();
    expectClose({image.rgba[0], image.rgba[1], image.rgba[2]},
                {srgb(0.2f), srgb(0.4f), srgb(0.8f)});
}

} // namespace limn::tonemap_test
