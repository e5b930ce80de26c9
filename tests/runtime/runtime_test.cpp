// SPDX-License-Identifier: MIT
// What an application relies on: identities of light, what a change costs, what is refused.
#include "engine/field/sample_field.h"
#include "engine/runtime/limn_runtime.h"
#include "engine/runtime/xxhash64.h"
#include "tests/runtime/open_file.h"
#include "tests/runtime/transport_bytes.h"
#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <new>
#include <numbers>

// Counts what is allocated through new; the runtime itself must not.
static std::atomic<std::size_t> allocations = 0;
[[gnu::noinline]] void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size))
        return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace limn::runtime_test {
namespace {

/// A closed room, its bake and its file.
struct Room {
    std::shared_ptr<const Scene> scene = litRoom(900, 800);
    TraceScene trace{*scene};
    std::shared_ptr<const Bake> baked = bakeOf(trace);
    std::string bytes = fileOf(*baked, *scene);
};
const Room& room() {
    static const Room made;
    return made;
}

std::vector<float> constant(std::size_t surfels, float value) {
    return std::vector<float>(3 * surfels, value);
}

TEST(Runtime, HashesAsTheSpecificationDoes) {
    EXPECT_EQ(runtime::xxhash64("", 0), 0xef46db3751d8e999U);
    EXPECT_EQ(runtime::xxhash64("abc", 3), 0x44bc2cf5ad770999U);
    const char* text = "Nobody inspects the spammish repetition"; // 39 bytes: blocks and rest
    EXPECT_EQ(runtime::xxhash64(text, 39), 0xfbcea83c8a378bf1U);
}

// Where every surface has albedo a and emits L, every point sees the radiance L / (1 - a).
TEST(Runtime, AClosedRoomIsAFurnace) {
    const OpenFile file(room().bytes);
    const std::size_t surfels = file.counts().surfels;
    limnrt_set_lights(file, nullptr, 0);
    for (const float albedo : {0.f, 0.5f, 0.8f}) {
        ASSERT_EQ(
            limnrt_set_albedo(file, 0, std::uint32_t(surfels), constant(surfels, albedo).data()),
            1);
        ASSERT_EQ(limnrt_set_emission(file, 0, std::uint32_t(surfels), constant(surfels, 2).data()),
                  1);
        limnrt_converge(file, 1000);
        const float expected = 2 * std::numbers::pi_v<float> / (1 - albedo);
        double sum = 0, area = 0;
        for (std::size_t k = 0; k < surfels; ++k) {
            const float a = limnrt_surfel_areas(file)[k];
            sum += double(a * limnrt_radiosity(file)[4 * k]);
            area += double(a);
        }
        EXPECT_NEAR(sum / area, expected, 0.01 * expected) << "links are noisy by some tenths";
        const float middle[3] = {2, 1.5f, 4}, up[3] = {0, 1, 0};
        float rgb[3];
        ASSERT_EQ(limnrt_sample_grid(file, middle, up, rgb), 1);
        for (const float e : rgb)
            EXPECT_NEAR(e, expected, 0.02f * expected);
    }
}

TEST(Runtime, LightIsLinearInStrengthAndColours) {
    const OpenFile file(room().bytes);
    limnrt_light light = limnrt_file_lights(file)[0];
    limnrt_converge(file, 1000);
    const std::vector<float> once = file.lightmapSh();
    light.color[0] = 4;
    light.color[2] = 0;
    limnrt_set_lights(file, &light, 1);
    limnrt_reset(file);
    limnrt_converge(file, 1000);
    const std::vector<float> coloured = file.lightmapSh();
    double worst = 0, most = 0;
    for (std::size_t t = 0; t < once.size(); t += 4) {
        worst = std::max(worst, std::abs(double(coloured[t]) - 4 * double(once[t])));
        most = std::max(most, std::abs(double(once[t])));
        EXPECT_EQ(coloured[t + 2], 0);
    }
    EXPECT_LT(worst, 1e-3 * most) << "bounces end within 1e-4";
}

TEST(Runtime, AConvergedSceneIsDoneAndAChangeIsNot) {
    const OpenFile file(room().bytes);
    EXPECT_GT(limnrt_converge(file, 1000), 3U);
    EXPECT_EQ(limnrt_converged(file), 1);
    EXPECT_EQ(limnrt_converge(file, 1000), 0U);
    const limnrt_light same = limnrt_file_lights(file)[0];
    limnrt_set_lights(file, &same, 1);
    EXPECT_EQ(limnrt_converged(file), 1) << "the same light is no change";
    const float red[3] = {0.8f, 0.1f, 0.1f};
    EXPECT_EQ(limnrt_set_material_albedo(file, 0, red), 1);
    EXPECT_EQ(limnrt_converged(file), 0);
}

TEST(Runtime, ASmallerToleranceIsReachedByMoreBouncesAndComesNearer) {
    const auto lit = [](std::initializer_list<float> tolerances) {
        const OpenFile file(room().bytes);
        std::uint32_t bounces = 0;
        for (const float tolerance : tolerances) {
            EXPECT_EQ(limnrt_set_tolerance(file, tolerance), 1);
            bounces += limnrt_converge(file, 1000);
        }
        EXPECT_EQ(limnrt_converged(file), 1);
        EXPECT_EQ(limnrt_set_tolerance(file, tolerances.begin()[0]), 1);
        EXPECT_EQ(limnrt_converged(file), 1) << "a larger tolerance asks for nothing more";
        return std::pair(bounces, double(limnrt_radiosity(file)[0]));
    };
    const auto exact = lit({1e-7f}), usual = lit({1e-4f}), coarse = lit({0.1f});
    EXPECT_LT(usual.first, exact.first);
    EXPECT_LT(coarse.first, usual.first);
    EXPECT_GT(std::abs(coarse.second - exact.second), std::abs(usual.second - exact.second));
    EXPECT_EQ(lit({0.1f, 1e-4f}).first, usual.first) << "bounces go on where they ended";
    const OpenFile unchanged(room().bytes);
    EXPECT_EQ(limnrt_converge(unchanged, 1000), usual.first);
    for (const float wrong : {0.f, -1.f, 1.5f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(limnrt_set_tolerance(unchanged, wrong), 0);
    EXPECT_EQ(limnrt_converged(unchanged), 1);
}

/// The room, white, so that each bounce passes on nearly all light; lit by its own surfaces or by
/// its lamp.
struct WhiteRoom {
    OpenFile file{room().bytes};
    std::size_t surfels = file.counts().surfels;

    explicit WhiteRoom(float albedo, bool byLamp = false) {
        const auto count = std::uint32_t(surfels);
        EXPECT_EQ(limnrt_set_albedo(file, 0, count, constant(surfels, albedo).data()), 1);
        if (byLamp)
            return;
        limnrt_set_lights(file, nullptr, 0);
        EXPECT_EQ(limnrt_set_emission(file, 0, count, constant(surfels, 1).data()), 1);
    }
    double sent() const {
        double sum = 0;
        for (std::size_t k = 0; k < surfels; ++k)
            sum += double(limnrt_surfel_areas(file)[k] * limnrt_radiosity(file)[4 * k]);
        return sum;
    }
};

TEST(Runtime, LookingAheadBringsTheSameLightInAFewBounces) {
    const WhiteRoom stepped(0.97f), ahead(0.97f);
    std::uint32_t steps = 0;
    for (; limnrt_converged(stepped.file) == 0; ++steps)
        limnrt_step(stepped.file);
    EXPECT_GT(steps, 200U) << "one by one, each passes on 97 % of the change before it";
    const std::uint32_t bounces = limnrt_converge(ahead.file, 1000);
    EXPECT_EQ(limnrt_converged(ahead.file), 1);
    EXPECT_LT(bounces, 25U);
    EXPECT_NEAR(ahead.sent() / stepped.sent(), 1, 2e-4);
}

TEST(Runtime, BouncesThatEndEarlySayHowMuchIsMissing) {
    const WhiteRoom whole(0.97f, true), early(0.97f, true);
    limnrt_set_tolerance(whole.file, 1e-6f);
    limnrt_converge(whole.file, 1000);
    EXPECT_EQ(limnrt_missing(early.file), 1) << "nothing is known before a bounce";
    for (int k = 0; k < 12; ++k) {
        limnrt_converge(early.file, 1);
        const double missing = std::abs(1 - early.sent() / whole.sent()),
                     said = double(limnrt_missing(early.file));
        EXPECT_GT(1.1 * said, missing) << k;
        EXPECT_EQ(said < 1e-4, limnrt_converged(early.file) == 1) << k;
    }
    EXPECT_LT(limnrt_missing(early.file), 0.1f);
    limnrt_reset(early.file);
    EXPECT_EQ(limnrt_missing(early.file), 1) << "a change of light";
}

// Rays that are traced after the occluders were taken away meet nothing.
TEST(Runtime, ALightsColourTracesNothingAndAMovedLightItselfAlone) {
    AlignedBytes bytes(room().bytes);
    limnrt_scene* scene = limnrt_open(bytes.data(), bytes.size(), nullptr, nullptr, 0);
    ASSERT_TRUE(scene);
    limnrt_light lights[2] = {limnrt_file_lights(scene)[0], limnrt_file_lights(scene)[0]};
    lights[1].position[0] += 0.7f;
    lights[1].strength = 1;
    limnrt_set_lights(scene, lights, 2);
    limnrt_counts counts;
    limnrt_get_counts(scene, &counts);
    const auto direct = [&] {
        return std::vector<float>(limnrt_direct(scene), limnrt_direct(scene) + 4 * counts.surfels);
    };
    const std::vector<float> before = direct();
    std::vector<float> first, second;
    lights[1].strength = 0;
    limnrt_set_lights(scene, lights, 2);
    first = direct();
    // A box without extent hides all triangles from new rays.
    const std::size_t at = sectionOf(room().bytes, "OBOX").begin;
    std::memset(static_cast<char*>(const_cast<void*>(bytes.data())) + at, 0, 12);
    std::memset(static_cast<char*>(const_cast<void*>(bytes.data())) + at + 16, 0, 12);
    lights[1].strength = 2;
    limnrt_set_lights(scene, lights, 2);
    second = direct();
    for (std::size_t k = 0; k < before.size(); ++k)
        EXPECT_NEAR(second[k] - first[k], 2 * (before[k] - first[k]), 1e-3f * before[k] + 1e-6f);
    lights[1].position[0] += 0.01f; // now without shadows
    limnrt_set_lights(scene, lights, 2);
    double more = 0, firstLight = 0;
    for (std::size_t k = 0; k < before.size(); ++k)
        more += double(direct()[k] > 1.2f * second[k] + 1e-3f);
    EXPECT_GT(more, 4) << "surfels in the block's shadow";
    lights[1].strength = 0;
    limnrt_set_lights(scene, lights, 2);
    for (std::size_t k = 0; k < before.size(); ++k)
        firstLight += std::abs(double(direct()[k]) - double(first[k]));
    EXPECT_EQ(firstLight, 0) << "the light that stood still was not traced";
    limnrt_close(scene);
}

TEST(Runtime, TheCallersOwnDirectLightReplacesLights) {
    const OpenFile file(room().bytes);
    const limnrt_light light = limnrt_file_lights(file)[0];
    limnrt_converge(file, 1000);
    const std::vector<float> lit = file.lightmapSh();
    std::vector<float> direct;
    for (std::size_t k = 0; k < file.counts().surfels; ++k)
        direct.insert(direct.end(), limnrt_direct(file) + 4 * k, limnrt_direct(file) + 4 * k + 3);
    limnrt_set_lights(file, nullptr, 0);
    limnrt_reset(file);
    limnrt_converge(file, 1000);
    EXPECT_EQ(file.lightmapSh()[0], 0) << "nothing shines";
    ASSERT_EQ(limnrt_set_direct(file, direct.data()), 1);
    limnrt_reset(file);
    limnrt_converge(file, 1000);
    EXPECT_EQ(file.lightmapSh(), lit);
    limnrt_set_lights(file, &light, 1);
    limnrt_reset(file);
    limnrt_converge(file, 1000);
    EXPECT_EQ(file.lightmapSh(), lit);
}

TEST(Runtime, LightPointsAreTheBakesOrTheMiddles) {
    const Surfels& surfels = room().baked->surfels;
    std::uint32_t each = 0;
    const OpenFile file(room().bytes);
    const float* points = limnrt_light_points(file, &each);
    ASSERT_EQ(each, kLightPoints);
    EXPECT_EQ(std::memcmp(points, surfels.lightPoints.data(),
                          surfels.lightPoints.size() * sizeof(glm::vec3)),
              0);
    EXPECT_EQ(std::memcmp(limnrt_light_normals(file), surfels.lightNormals.data(),
                          surfels.lightNormals.size() * sizeof(glm::vec3)),
              0);
    const OpenFile middles(fileOf(*bakeOfMiddles(room().trace), *room().scene));
    EXPECT_EQ(limnrt_light_points(middles, &each), limnrt_surfel_positions(middles));
    EXPECT_EQ(limnrt_light_normals(middles), nullptr);
    EXPECT_EQ(each, 1U);
}

// A surfel below the edge of a shadow has the light of those of its points that are out of it. Lit
// at its middle alone, it would be all bright or all dark.
TEST(Runtime, AnEdgeOfShadowLightsPartsOfTheSurfelsBelowIt) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}));
    // It faces the floor. Its edge passes above the middle, aslant to the rows of surfels.
    b.add(simple::quad({-0.4f, 1, -1.2f}, {4.8f, 0, -3.6f}, {4.8f, 0, 6.4f}));
    b.scene.lights.resize(1);
    b.scene.lights[0].kind = LightKind::Directional;
    b.scene.lights[0].direction = {0, -1, 0};
    b.scene.lights[0].color = glm::vec3(1);
    b.scene.lights[0].strength = 1;
    b.scene.bake.surfels = 20000;
    b.scene.bake.lightmapCaches = 2000;
    b.scene.bake.rays = 256; // some for each surfel: they find its light points
    const Scene scene = b.build();
    const OpenFile file(fileOf(*bakeOf(TraceScene(scene)), scene));
    ASSERT_TRUE(file) << file.message;
    std::uint32_t each = 0;
    const float* points = limnrt_light_points(file, &each);
    int partly = 0;
    for (std::size_t k = 0; k < file.counts().surfels; ++k) {
        if (limnrt_surfel_instances(file)[k] != 0)
            continue;
        float lit = 0, nearest = 1;
        for (std::size_t i = k * each; i < (k + 1) * each; ++i) {
            const float intoShadow = 0.8f * (points[3 * i] - 2) - 0.6f * (points[3 * i + 2] - 2);
            lit += intoShadow < 0 ? 1 / float(each) : 0;
            nearest = std::min(nearest, std::abs(intoShadow));
        }
        if (nearest < 1e-4f)
            continue;
        EXPECT_NEAR(limnrt_direct(file)[4 * k], lit, 1e-6f);
        partly += lit > 0 && lit < 1;
    }
    EXPECT_GT(partly, 8);
}

TEST(Runtime, SkyLightsWhatSeesIt) {
    Scene scene = hall(LinkStorage::Rtp, 3, true);
    scene.bake.lightmapCaches = 400;
    scene.bake.rays = 64;
    const auto baked = bakeOf(TraceScene(scene));
    const OpenFile file(fileOf(*baked, scene));
    const std::size_t cells = file.counts().sky_cells;
    limnrt_converge(file, 1000);
    std::vector<float> sky(3 * cells, 1);
    ASSERT_EQ(limnrt_set_sky(file, sky.data()), 1);
    EXPECT_GT(limnrt_converge(file, 1000), 3U);
    scene.sky.radiance = glm::vec3(1);
    const TraceScene trace(scene);
    Relighter relighter(baked, LitBands::All);
    relighter.relight(scene, trace, 1000);
    const std::vector<glm::vec4>& expected = relighter.field().lightmap;
    EXPECT_LT(nrmse(file.lightmapSh().data(), expected.data(), expected.size()), 5e-5);
}

TEST(Runtime, GridIsSampledAsTheFieldIs) {
    Scene scene = *litRoom(900, 800); // its block hides points from cells
    scene.bake.grid = {4, 3, 5};
    scene.instances.push_back(scene.instances[1]); // dynamic and far away: it asks for the grid
    scene.instances.back().dynamic = true;
    scene.instances.back().toWorld[3] = glm::vec4(40, 0, 0, 1);
    scene.relight.tolerance = 0.001f; // far below what is compared
    const TraceScene trace(scene);
    const auto baked = bakeOf(trace);
    const OpenFile file(fileOf(*baked, scene));
    Relighter relighter(baked, LitBands::All);
    relighter.relight(scene, trace, 1000);
    ASSERT_EQ(limnrt_set_tolerance(file, 1e-5f), 1);
    limnrt_converge(file, 1000);
    ASSERT_EQ(limnrt_converged(file), 1);
    const LightmapLayout none;
    for (int k = 0; k < 300; ++k) {
        const glm::vec3 p(0.02f + 0.0131f * float(k), 0.05f + float(k * 7 % 29) * 0.1f,
                          4.95f - float(k * 11 % 49) * 0.1f);
        const glm::vec3 n = glm::normalize(glm::vec3(k % 3 - 1, 1, k % 5 - 2));
        const glm::vec3 expected =
            sampleIrradiance({relighter.field(), none, scene, 2, 0, 0, 0, p, n});
        float rgb[3];
        ASSERT_EQ(limnrt_sample_grid(file, &p.x, &n.x, rgb), 1);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(rgb[i], expected[i], 1e-4f * expected[i]);
    }
}

TEST(Runtime, IrradianceIsThatOfTheCoefficients) {
    const OpenFile file(room().bytes);
    limnrt_converge(file, 1000);
    const limnrt_counts c = file.counts();
    const std::size_t texels = std::size_t(c.lightmap_width) * c.lightmap_height;
    std::vector<float> own(4 * texels), given(4 * texels), normals(3 * texels, 0);
    const std::vector<float> sh = file.lightmapSh();
    std::vector<std::uint16_t> half(sh.size());
    limnrt_lightmap_irradiance(file, nullptr, own.data());
    for (std::size_t k = 0; k < c.lightmap_caches; ++k) {
        const std::uint32_t texel = room().baked->caches.texel[k];
        std::copy_n(limnrt_cache_normals(file) + 3 * k, 3, &normals[3 * texel]);
    }
    limnrt_lightmap_irradiance(file, normals.data(), given.data());
    limnrt_lightmap_sh_half(file, 1, half.data());
    for (std::size_t t = 0; t < texels; ++t) {
        if (own[4 * t + 3] == 0)
            continue;
        glm::vec3 coefficients[9];
        for (std::size_t i = 0; i < 9; ++i)
            for (int k = 0; k < 3; ++k)
                coefficients[i][k] = sh[4 * (i * texels + t) + std::size_t(k)];
        const glm::vec3 n(normals[3 * t], normals[3 * t + 1], normals[3 * t + 2]);
        const glm::vec3 e = glm::max(shIrradiance(3, coefficients, n), glm::vec3(0));
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(own[4 * t + std::size_t(k)], e[k], 1e-4f * e[k] + 1e-6f);
            EXPECT_NEAR(given[4 * t + std::size_t(k)], e[k], 1e-4f * e[k] + 1e-6f);
        }
        EXPECT_EQ(half[4 * t + 3], 0x3c00) << "1 as a half";
    }
}

TEST(Runtime, ALightmapMadeOfOthersTexelsIsTheirMean) {
    const Caches& caches = room().baked->caches;
    const std::uint32_t a = caches.texel[3], b = caches.texel[7];
    const std::vector<glm::uvec4> texel = {{a, b, a, a}, {a, a, a, a}, {0, 0, 0, 0}};
    const std::vector<glm::vec4> weight = {
        {0.25f, 0.75f, 0, 0}, {0.1f, 0.2f, 0.3f, 0.4f}, glm::vec4(0)};
    const TransportLightmap map{3, 1, texel, weight};
    const OpenFile mixed(fileOf(*room().baked, *room().scene, &map)), whole(room().bytes);
    ASSERT_TRUE(mixed) << mixed.message;
    limnrt_converge(mixed, 1000);
    limnrt_converge(whole, 1000);
    const std::vector<float> sh = mixed.lightmapSh(), own = whole.lightmapSh();
    ASSERT_EQ(sh.size(), 9 * 3 * 4U);
    const limnrt_counts c = whole.counts();
    const std::size_t texels = std::size_t(c.lightmap_width) * c.lightmap_height;
    for (std::size_t i = 0; i < 9; ++i) {
        const float ca = own[4 * (i * texels + a)], cb = own[4 * (i * texels + b)];
        const float rounding = 2e-5f * (std::abs(ca) + std::abs(cb));
        EXPECT_NEAR(sh[12 * i], 0.25f * ca + 0.75f * cb, rounding);
        EXPECT_NEAR(sh[12 * i + 4], ca, rounding);
        EXPECT_EQ(sh[12 * i + 8], 0);
        EXPECT_EQ(sh[12 * i + 3], 1);
        EXPECT_EQ(sh[12 * i + 11], 0) << "no chart";
    }
}

TEST(Runtime, AllocatesOnceThroughTheCallersFunction) {
    static int taken = 0, given = 0;
    limnrt_options options{};
    options.max_lights = 3;
    options.allocate = [](std::size_t bytes, void*) {
        ++taken;
        return std::malloc(bytes);
    };
    options.release = [](void* block, void*) {
        ++given;
        std::free(block);
    };
    {
        const OpenFile file(room().bytes, &options);
        ASSERT_TRUE(file) << file.message;
        const std::size_t texels =
            std::size_t(file.counts().lightmap_width) * file.counts().lightmap_height;
        std::vector<float> rgba(36 * texels);
        limnrt_light light = limnrt_file_lights(file)[0];
        const std::size_t before = allocations;
        for (int k = 0; k < 8; ++k) {
            light.position[0] += 0.1f;
            limnrt_set_lights(file, &light, 1);
            limnrt_step(file);
            limnrt_lightmap_sh(file, rgba.data());
        }
        EXPECT_EQ(allocations.load(), before);
        EXPECT_EQ(taken, 1);
        const std::vector<limnrt_light> four(4, light);
        EXPECT_EQ(limnrt_set_lights(file, four.data(), 4), 0) << "more than max_lights";
    }
    EXPECT_EQ(given, 1);
    options.allocate = [](std::size_t, void*) -> void* { return nullptr; };
    EXPECT_EQ(OpenFile(room().bytes, &options).message, "out of memory");
}

TEST(Runtime, RefusesNumbersThatAreNoneAndChangesNothing) {
    const OpenFile file(room().bytes);
    limnrt_converge(file, 1000);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::size_t surfels = file.counts().surfels;
    const auto count = std::uint32_t(surfels);
    std::vector<float> rgb = constant(surfels, 0.5f);
    rgb.back() = nan;
    EXPECT_EQ(limnrt_set_direct(file, rgb.data()), 0);
    EXPECT_EQ(limnrt_set_albedo(file, 0, count, rgb.data()), 0);
    EXPECT_EQ(limnrt_set_emission(file, 0, count, rgb.data()), 0);
    EXPECT_EQ(limnrt_set_albedo(file, count, 1, rgb.data()), 0);
    EXPECT_EQ(limnrt_set_albedo(file, 1, 0xffffffffU, rgb.data()), 0);
    EXPECT_EQ(limnrt_set_material_albedo(file, 0, constant(1, 1).data()), 0) << "above 0.99";
    EXPECT_EQ(limnrt_set_material_albedo(file, 99, constant(1, 0.5f).data()), 0);
    limnrt_light light = limnrt_file_lights(file)[0];
    light.position[1] = nan;
    EXPECT_EQ(limnrt_set_lights(file, &light, 1), 0);
    const float far[3] = {nan, 0, 0}, up[3] = {0, 1, 0};
    float out[3];
    EXPECT_EQ(limnrt_sample_grid(file, far, up, out), 0);
    EXPECT_EQ(limnrt_converged(file), 1);
}

TEST(Runtime, MaterialsKeepWhatTexturesVary) {
    const OpenFile file(room().bytes);
    EXPECT_STRNE(limnrt_material_name(file, 0), nullptr);
    EXPECT_EQ(limnrt_material_name(file, 1), nullptr);
    limnrt_converge(file, 1000);
    const float before = limnrt_radiosity(file)[0];
    const float one[3] = {1, 1, 1}, none[3] = {0, 0, 0};
    EXPECT_EQ(limnrt_scale_material_albedo(file, 0, none), 1);
    limnrt_converge(file, 1000);
    EXPECT_EQ(limnrt_radiosity(file)[0], 0);
    EXPECT_EQ(limnrt_scale_material_albedo(file, 0, one), 1);
    limnrt_reset(file);
    limnrt_converge(file, 1000);
    EXPECT_EQ(limnrt_radiosity(file)[0], before);
}

} // namespace
} // namespace limn::runtime_test
