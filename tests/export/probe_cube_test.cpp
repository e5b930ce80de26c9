// SPDX-License-Identifier: MIT
// Reflected light against closed forms.
#include "engine/export/probe_cube.h"

#include "engine/export/engine_formats.h"
#include "engine/files/image_file.h"
#include "tests/core/temporary_folder.h"
#include "tests/export/known_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace limn::probe_cube_test {
namespace {

constexpr float kHalf = 0.5f, kSlope = 0.4f;

std::array<glm::vec3, 9> constantLight(glm::vec3) {
    return KnownLight::probe(0);
}

/// Radiance kHalf + kSlope y from direction (x, y, z).
Sky gradient() {
    return {.kind = SkyKind::Gradient,
            .radiance = glm::vec3(kHalf + kSlope),
            .horizon = glm::vec3(kHalf),
            .ground = glm::vec3(kHalf - kSlope)};
}

/// The sky alone: the scene's surfaces are too far away to be seen.
CubeMap skyOf(const Sky& sky, std::uint32_t size) {
    KnownLight light(constantLight);
    light.scene.sky = sky;
    return cubeSeenFrom(light.view(), {0, 0, 1e5f}, size, {});
}

TEST(ProbeCube, TexelsAndDirectionsAreInverse) {
    for (const std::uint32_t size : {1U, 4U})
        for (std::size_t t = 0; t < std::size_t(6) * size * size; ++t) {
            EXPECT_NEAR(glm::length(cubeDirection(size, t)), 1, 1e-6f);
            EXPECT_EQ(cubeTexel(size, cubeDirection(size, t)), t);
        }
    // As OpenGL has it: the first texel of +X lies up and towards +Z, that of +Y towards -X and -Z.
    EXPECT_LT(glm::distance(cubeDirection(64, 0), glm::normalize(glm::vec3(1, 1, 1))), 0.03f);
    EXPECT_LT(glm::distance(cubeDirection(64, 2 * 64 * 64), glm::normalize(glm::vec3(-1, 1, -1))),
              0.03f);
}

TEST(ProbeCube, ShowsTheSkyInEachDirection) {
    const CubeMap cube = skyOf(gradient(), 16);
    for (std::size_t t = 0; t < cube.texels(); ++t)
        EXPECT_NEAR(cube.rgb[t].y, kHalf + kSlope * cubeDirection(16, t).y, 1e-5f);
}

TEST(ProbeCube, OfAUniformSkyIsTheSameAtEveryRoughness) {
    const CubeMap cube = skyOf({.radiance = {1, 2, 3}}, 16);
    for (const float alpha : {1 / 64.f, 0.25f, 1.f})
        for (const glm::vec3& v : prefiltered(cube, alpha, 8).rgb)
            EXPECT_LT(glm::distance(v, glm::vec3(1, 2, 3)), 1e-4f) << alpha;
}

// With alpha = 1, D is the same for all half vectors, so that the lobe is a cosine, whose mean of
// cosines is 2/3.
TEST(ProbeCube, OfALinearSkyAtFullRoughnessHasTwoThirdsOfItsSlope) {
    const CubeMap rough = prefiltered(skyOf(gradient(), 32), 1, 4);
    for (std::size_t t = 0; t < rough.texels(); ++t)
        EXPECT_NEAR(rough.rgb[t].x, kHalf + 2 / 3.f * kSlope * cubeDirection(4, t).y, 1e-3f);
}

TEST(ProbeCube, SurfacesSendTheirAlbedoOfTheirIrradiance) {
    const KnownLight light(constantLight); // a white ball in radiance 1 from everywhere
    const CubeMap cube = cubeSeenFrom(light.view(), {0, 0, 1.5f}, 15, {});
    const glm::vec3 ball = cube.rgb[cubeTexel(15, {0, 0, -1})];
    const Material& white = light.scene.materials[1];
    EXPECT_NEAR(ball.x, white.baseColor.x * (1 - white.metallic), 0.02f);
    EXPECT_EQ(cube.rgb[cubeTexel(15, {0, 0, 1})].x, 0); // the sky is black
}

TEST(ProbeCube, AProbeDoesNotStandInsideOfThings) {
    const KnownLight light(constantLight);
    const glm::vec3 p = probePosition(light.view());
    EXPECT_GT(glm::length(p), 1.f) << "inside the ball";
    EXPECT_GE(p.z, 0.f) << "behind the quad, whose back is black";
}

// The extension's faces are upside down: their first row looks down.
TEST(ProbeCube, ImagesOfAnExportShowTheSkyTheRightWayUp) {
    KnownLight light(constantLight);
    light.scene.sky = gradient();
    const auto files = kIblFormat.write(light.view(), {}, "room.gltf", {});
    ASSERT_TRUE(files) << files.error().message;
    const TemporaryFolder folder;
    for (const char* name : {"room.gltf", "room-right-handed.gltf"}) {
        const auto file = [&](const std::string& wanted) {
            return std::ranges::find(*files, wanted, &ExportFile::name)->bytes;
        };
        const auto gltf = nlohmann::json::parse(file(name));
        const auto& ibl = gltf["extensions"]["EXT_lights_image_based"]["lights"][0];
        EXPECT_EQ(ibl["intensity"], 1);
        EXPECT_EQ(ibl["specularImages"].size(), 4U);
        const auto& faces = ibl["specularImages"][0];
        const std::size_t awayFromBall = name == std::string("room.gltf") ? 4 : 5; // mirrored at z
        const auto& view =
            gltf["bufferViews"][gltf["images"][faces[awayFromBall].get<std::size_t>()]["bufferView"]
                                    .get<std::size_t>()];
        const std::string bytes = file(gltf["buffers"][view["buffer"].get<std::size_t>()]["uri"]);
        writeFile(folder.file("face.png"), bytes.substr(view["byteOffset"], view["byteLength"]));
        const Result<Image> face = readPng(folder.file("face.png"));
        ASSERT_TRUE(face) << face.error().message;
        ASSERT_EQ(face->width, 64U);
        const auto value = [&](std::size_t row) {
            const std::size_t at = 4 * (row * 64 + 32);
            return std::pow(face->rgba[at] / 255.f, 2.2f) / (face->rgba[at + 3] / 255.f);
        };
        EXPECT_NEAR(value(0), kHalf - kSlope * std::sqrt(0.5f), 0.02f) << name;
        EXPECT_NEAR(value(63), kHalf + kSlope * std::sqrt(0.5f), 0.02f) << name;
    }
}

} // namespace
} // namespace limn::probe_cube_test
