// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_lattices.h"

#include "engine/core/parallel.h"
#include "engine/field/field_reading.h"
#include "engine/lighting/direct_irradiance.h"
#include "tests/techniques/lit_ceiling.h"
#include "tests/techniques/photon_lattices/lit_by_photons.h"
#include "tests/techniques/two_lamps.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

namespace limn::photon_lattices_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A room with a block of metal and two lamps of different colours.
Scene room(float scale = 1) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.addMaterial(mirror({0.9f, 0.8f, 0.5f}));
    b.scene.materials[1].roughness = 0.2f;
    b.add(simple::box(glm::vec3(0), scale * glm::vec3(4, 3, 5), true));
    b.add(simple::box(scale * glm::vec3(1, 0, 1), scale * glm::vec3(1.8f, 1.2f, 1.6f), false, 1));
    b.scene.lights = twoLamps(scale);
    return b.build();
}

const PhotonChoice kFew = {{"photons", 3000}, {"high", 32}};

/// On floor, ceiling and walls, not in the faces of cells.
std::vector<std::pair<glm::vec3, glm::vec3>> places(float scale = 1) {
    return {{scale * glm::vec3(3.1f, 0, 3.3f), {0, 1, 0}},
            {scale * glm::vec3(2.2f, 3, 2.1f), {0, -1, 0}},
            {scale * glm::vec3(0, 1.2f, 2.7f), {1, 0, 0}},
            {scale * glm::vec3(2.6f, 0, 1.2f), {0, 1, 0}}};
}

std::vector<glm::vec3> irradiances(const LitByPhotons& lit, float scale = 1) {
    std::vector<glm::vec3> all;
    for (const auto& [p, n] : places(scale))
        all.push_back(lit.irradiance(p, n));
    return all;
}

/// Error of the irradiance in a sphere against `truth`, over its area.
struct SphereError {
    double mean = 0, rms = 0; ///< over the truth
};
SphereError sphereError(const LitByPhotons& lit, double truth) {
    const Mesh& mesh = lit.scene.meshOf(lit.scene.instances[0]);
    SphereError error;
    double area = 0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto k = mesh.triangle(t);
        const glm::vec3 a = mesh.positions[k[0]], b = mesh.positions[k[1]],
                        c = mesh.positions[k[2]], middle = (a + b + c) / 3.f;
        const double weight = double(glm::length(glm::cross(b - a, c - a)));
        const double e = double(lit.irradiance(middle, -glm::normalize(middle)).x) / truth - 1;
        area += weight;
        error.mean += weight * e;
        error.rms += weight * e * e;
    }
    return {error.mean / area, std::sqrt(error.rms / area)};
}

// A lamp of intensity I in the middle: a bounce brings rho I / R^2 everywhere, all bounces
// rho / (1 - rho) I / R^2. With n photons stored, cells that touch the sphere hold n / M of them,
// so that the error is their root; 1.15 allows for slivers. The mean is as good as their number is.
TEST(PhotonLattices, LightASphereEvenly) {
    constexpr float kRadius = 2, kIntensity = 10, kAlbedo = 0.5f;
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(kAlbedo)));
    b.add(simple::sphere(kRadius, 4, true));
    b.scene.lights = {{.kind = LightKind::Point, .strength = kIntensity}};
    LitByPhotons lit(b.build(), {{"blur", 0}, {"photons", 20000}});
    const double truth = double(kAlbedo * kIntensity / (kRadius * kRadius));
    for (const auto& [side, touched] : {std::pair{4, 56}, std::pair{8, 272}}) {
        lit.set("low", side);
        lit.set("mid", side);
        const LightingReport report = lit.update();
        const double stored = counterOf(report, "stored_mid"),
                     emitted = counterOf(report, "emitted");
        EXPECT_NEAR(stored, 1e4, 100);
        const SphereError error = sphereError(lit, truth);
        const double root = std::sqrt(touched / stored);
        std::printf("sphere, %d cells: nRMSE %.4f, root %.4f, mean %.4f\n", side, error.rms, root,
                    error.mean);
        EXPECT_LT(error.rms, 1.15 * root);
        EXPECT_NEAR(error.mean, 0, 3 * std::sqrt((1 - kAlbedo) / (double(kAlbedo) * emitted)));
    }
    lit.set("bounces", 64);
    lit.update();
    const SphereError all = sphereError(lit, truth / (1 - double(kAlbedo)));
    std::printf("sphere, all bounces: nRMSE %.4f, mean %.4f\n", all.rms, all.mean);
    EXPECT_NEAR(all.mean, 0, 0.02);
    for (const char* key : {"mode", "blur", "lookup"}) {
        lit.set(key, key == std::string("blur") ? 3 : 1);
        lit.update();
        EXPECT_NEAR(sphereError(lit, truth / (1 - double(kAlbedo))).mean, 0, 0.06) << key;
    }
}

// Where everything has radiance L, irradiance is pi L: walls that emit (1 - rho) L and reflect the
// rest. First hits are stored; without them the direct light of emitters would be missing.
TEST(PhotonLattices, FillAFurnace) {
    constexpr float kAlbedo = 0.6f, kRadiance = 2;
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(kAlbedo), glm::vec3((1 - kAlbedo) * kRadiance)));
    b.add(simple::sphere(2, 4, true));
    LitByPhotons lit(b.build(), {{"bounces", 64}, {"blur", 0}});
    lit.update();
    const SphereError error = sphereError(lit, double(kPi * kRadiance));
    std::printf("furnace: mean %.4f, nRMSE %.4f\n", error.mean, error.rms);
    EXPECT_NEAR(error.mean, 0, 0.02);
}

/// A ring of radius 1 about +Y that faces its axis, with smooth normals or those of its facets.
Mesh ringOf(std::uint32_t sides, float height, bool isSmooth, std::uint32_t material) {
    Mesh ring;
    ring.material = material;
    const auto out = [&](float side) {
        const float angle = 2 * kPi * side / float(sides);
        return glm::vec3(std::cos(angle), 0, std::sin(angle));
    };
    for (std::uint32_t i = 0; i < sides; ++i) {
        const float side = float(i);
        for (const float edge : {side, side + 1})
            for (const float y : {0.f, height}) {
                ring.positions.push_back(out(edge) + glm::vec3(0, y, 0));
                ring.normals.push_back(-out(isSmooth ? edge : side + 0.5f));
            }
        const std::uint32_t a = 4 * i;
        ring.indices.insert(ring.indices.end(), {a, a + 2, a + 1, a + 2, a + 3, a + 1});
    }
    return ring;
}

/// The floor's brightest place in the light that such a ring casts.
struct Caustic {
    glm::vec3 focus{0}, brightest{0}; ///< focus: half-way from the axis to the far side
    float irradiance = 0, sun = 0, cell = 0;
};
Caustic causticOf(bool isSmooth, double specular) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.addMaterial(mirror(glm::vec3(0.95f)));
    b.add(simple::quad({-1.6f, 0, -1.6f}, {0, 0, 3.2f}, {3.2f, 0, 0}));
    b.add(ringOf(24, 0.6f, isSmooth, 1));
    const float high = 38 * kPi / 180, turn = 0.4f;
    const glm::vec3 along(std::cos(turn), 0, std::sin(turn));
    b.scene.lights = {{.kind = LightKind::Directional,
                       .direction = along * std::cos(high) - glm::vec3(0, std::sin(high), 0),
                       .strength = 5}};
    LitByPhotons lit(b.build(), {{"photons", 200000}, {"high", 64}, {"specular", specular}});
    lit.update();
    const float cell = lit.part(PhotonLattice::High).cells().lattice.cell;
    Caustic caustic{.focus = 0.5f * along, .sun = 5 * std::sin(high), .cell = cell};
    for (float x = -1.6f + cell / 2; x < 1.6f; x += cell)
        for (float z = -1.6f + cell / 2; z < 1.6f; z += cell)
            if (const float e = lit.irradiance({x, 0, z}, {0, 1, 0}).x; e > caustic.irradiance) {
                caustic.irradiance = e;
                caustic.brightest = {x, 0, z};
            }
    return caustic;
}

// A mirror ring of radius R focuses the sun on the floor half-way from the axis to its far side. A
// ring of few sides does so by its interpolated normals; its facets alone cast strips.
TEST(PhotonLattices, CastTheCausticOfARing) {
    for (const bool isSmooth : {true, false}) {
        const Caustic c = causticOf(isSmooth, 8);
        const float off = glm::distance(c.brightest, c.focus) / c.cell;
        std::printf("%s ring: brightest %.2f cells from the focus\n",
                    isSmooth ? "smooth" : "faceted", double(off));
        EXPECT_EQ(off < 2, isSmooth);
        EXPECT_GT(c.irradiance, c.sun) << "brighter than the sun alone";
    }
    EXPECT_EQ(causticOf(true, 0).irradiance, 0);
}

// A wall between two rooms, in cells of 0.53 m of the middle lattice. Light leaks where a cell, or
// one that is blurred into it, holds surfaces of both rooms that face alike: at the wall's foot.
TEST(PhotonLattices, LeakAtTheFootOfAThinWall) {
    for (const double blur : {0., 3.}) {
        float before = 1;
        for (const float cells : {0.05f, 0.25f, 1.f, 2.f}) {
            const float half = cells * 0.53f / 2;
            simple::SceneBuilder b;
            b.addMaterial(simple::lambert(glm::vec3(0.5f)));
            b.add(simple::box({-2.24f, 0, 0}, {-half, 2, 2}, true));
            b.add(simple::box({half, 0, 0}, {2, 2, 2}, true));
            b.scene.lights = {
                {.kind = LightKind::Point, .position = glm::vec3(-1.1f, 1, 1), .strength = 10}};
            LitByPhotons lit(b.build(), {{"blur", blur}});
            lit.update();
            float dark = 0, bright = 0;
            for (const float z : {0.3f, 0.8f, 1.3f, 1.8f})
                for (const float x : {0.05f, 0.5f, 1.f, 1.4f}) {
                    dark += lit.irradiance({half + x, 0, z}, {0, 1, 0}).x;
                    bright += lit.irradiance({-half - x, 0, z}, {0, 1, 0}).x;
                }
            const float leak = dark / bright;
            std::printf("wall of %.2f cells, blur %g: leak %.4f\n", double(cells), blur,
                        double(leak));
            EXPECT_LE(leak, before);
            before = leak;
        }
        EXPECT_EQ(before, 0) << "no cell reaches across two cells";
    }
}

/// Irradiance of points that face up under the lit ceiling, of one bounce, summed over a grid of
/// the ceiling.
std::vector<double> truthUnderCeiling(const Scene& scene, const std::vector<glm::vec3>& points) {
    constexpr int kSide = 200;
    std::vector<glm::vec3> ceiling;
    for (int i = 0; i < kSide * kSide; ++i)
        ceiling.emplace_back((float(i % kSide) + 0.5f) * 4 / kSide - 2, 3,
                             (float(i / kSide) + 0.5f) * 4 / kSide - 2);
    const TraceScene trace(scene);
    DirectIrradiance direct;
    const std::vector<glm::vec3> down(ceiling.size(), {0, -1, 0});
    updateDirectIrradiance(ceiling, down, scene, trace, direct);
    std::vector<double> all;
    for (const glm::vec3 p : points) {
        double sum = 0;
        for (std::size_t i = 0; i < ceiling.size(); ++i) {
            const glm::vec3 way = ceiling[i] - p;
            const double r2 = double(glm::dot(way, way));
            if (direct.irradiance[i].x > 0 &&
                !trace.blocked(trace.clearOf(p, {0, 1, 0}), trace.clearOf(ceiling[i], down[i])))
                sum += 0.5 / double(kPi) * double(direct.irradiance[i].x) * double(way.y * way.y) /
                       (r2 * r2) * 16 / (kSide * kSide);
        }
        all.push_back(sum);
    }
    return all;
}

// The indirect shadow of an object is as sharp as a cell and its blur are.
TEST(PhotonLattices, CastIndirectShadows) {
    const std::vector<glm::vec3> floor = {
        {0, 0, 0}, {0.7f, 0, 0}, {1, 0, 0}, {1.3f, 0, 0}, {1.8f, 0, 0}};
    const Scene scene = litCeiling(true);
    const std::vector<double> truth = truthUnderCeiling(scene, floor);
    const auto print = [&](const char* what, const std::vector<double>& values) {
        std::printf("%-26s", what);
        for (const double e : values)
            std::printf(" %6.3f", e);
        std::printf("\n");
        return values;
    };
    print("truth without the box", truthUnderCeiling(litCeiling(false), floor));
    print("truth", truth);
    const auto lit = [&](const char* what, const PhotonChoice& choice) {
        LitByPhotons photons(scene, choice);
        photons.update();
        std::vector<double> values;
        for (const glm::vec3 p : floor)
            values.push_back(double(photons.irradiance(p + glm::vec3(0, 0, 0.01f), {0, 1, 0}).x));
        return print(what, values);
    };
    lit("20 000, usual", {});
    lit("20 000, no blur", {{"blur", 0}});
    const std::vector<double> fine =
        lit("1e6, 16 cells, no blur",
            {{"photons", 1e6}, {"low", 8}, {"mid", 16}, {"blur", 0}, {"high", 8}});
    EXPECT_LT(fine[0], 0.05 * truth[4]);
    EXPECT_NEAR(fine[4], truth[4], 0.15 * truth[4]);
}

TEST(PhotonLattices, AreTheSameAtEveryScale) {
    LitByPhotons lit(room(), kFew);
    lit.update();
    const std::vector<glm::vec3> one = irradiances(lit);
    for (const float scale : {1e-3f, 0.1f, 10.f, 1e3f}) {
        LitByPhotons scaled(room(scale), kFew);
        scaled.update();
        const std::vector<glm::vec3> e = irradiances(scaled, scale);
        for (std::size_t i = 0; i < one.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e[i][c], one[i][c], 0.03f * one[i][c]) << scale;
    }
}

TEST(PhotonLattices, DoubleWithTheLightsAndAddThem) {
    LitByPhotons lit(room(), kFew);
    lit.update();
    const std::vector<glm::vec3> both = irradiances(lit);
    for (Light& light : lit.scene.lights)
        light.strength *= 2;
    lit.update();
    const std::vector<glm::vec3> twice = irradiances(lit);
    for (std::size_t i = 0; i < both.size(); ++i)
        EXPECT_EQ(twice[i], 2.f * both[i]);
    std::vector<glm::vec3> sum(both.size(), glm::vec3(0));
    for (const std::size_t off : {0U, 1U}) {
        lit.scene.lights = room().lights;
        lit.scene.lights[off].enabled = false;
        lit.update();
        const std::vector<glm::vec3> alone = irradiances(lit);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += alone[i];
    }
    for (std::size_t i = 0; i < both.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[i][c], both[i][c], 1e-5f * both[i][c]);
}

TEST(PhotonLattices, HaveTheSameBitsForAnyNumberOfThreads) {
    LitByPhotons many(room());
    many.update();
    const ThreadLimit one(1);
    LitByPhotons single(room());
    single.update();
    EXPECT_TRUE(single.sameLight(many));
}

TEST(PhotonLattices, TraceOnlyWhatChanged) {
    LitByPhotons lit(room(), kFew);
    const LightingReport first = lit.update();
    EXPECT_EQ(counterOf(first, "lights_traced"), 2);
    EXPECT_EQ(counterOf(first, "areas_clipped"), 2);
    EXPECT_EQ(counterOf(first, "absorbed") + counterOf(first, "ended") + counterOf(first, "lost"),
              counterOf(first, "emitted"));
    const std::uint64_t version = lit.lighting->field()->version;
    LightingReport report = lit.update();
    EXPECT_TRUE(report.skipped);
    EXPECT_EQ(lit.lighting->field()->version, version);
    EXPECT_EQ(counterOf(report, "rays"), 0);

    const auto changed = [&](double traced, const char* what) {
        const PhotonParts before = lit.lighting->field()->parts;
        report = lit.update();
        EXPECT_FALSE(report.skipped) << what;
        EXPECT_EQ(counterOf(report, "lights_traced"), traced) << what;
        EXPECT_EQ(counterOf(report, "rays") > 0, traced > 0) << what;
        EXPECT_FALSE(samePartsOf(lit.lighting->field()->parts, before)) << what;
        EXPECT_TRUE(lit.update().skipped) << what;
        LitByPhotons anew(lit.scene);
        anew.scene.technique = lit.scene.technique;
        anew.update();
        EXPECT_TRUE(anew.sameLight(lit)) << what;
    };
    lit.scene.lights[0].color = glm::vec3(0, 1, 0);
    changed(0, "colour");
    lit.scene.lights[1].strength *= 3;
    changed(0, "strength");
    lit.scene.lights[1].enabled = false;
    changed(0, "off");
    lit.scene.lights[1].enabled = true;
    changed(0, "on again");
    lit.scene.lights[0].position.y -= 0.3f;
    changed(1, "a light moved");
    for (const auto& [key, value] :
         {std::pair{"mode", 1.}, std::pair{"blur", 1.}, std::pair{"lookup", 1.},
          std::pair{"low", 5.}, std::pair{"mid", 9.}, std::pair{"high", 40.}, std::pair{"few", 30.},
          std::pair{"splat", 1.}, std::pair{"splat_radius", 0.05}, std::pair{"splat", 2.}}) {
        lit.set(key, value);
        changed(0, key);
    }
    lit.set("splat", 0);
    lit.update();
    for (const auto& [key, value] :
         {std::pair{"photons", 2000.}, std::pair{"bounces", 2.}, std::pair{"specular", 1.}}) {
        lit.set(key, value);
        changed(2, key);
    }
    lit.scene.materials[0].baseColor.x *= 0.5f;
    changed(2, "albedo");
    lit.scene.materials[1].roughness = 0.6f;
    changed(2, "roughness of metal");
    lit.scene.instances[1].toWorld[3].z += 1.f;
    lit.retrace();
    changed(2, "an object moved");
    lit.scene.materials[0].emission = glm::vec3(0.1f);
    changed(1, "emission");
    lit.scene.materials[0].emission *= 3;
    changed(0, "its strength");

    lit.scene.lights[0].name = "Renamed";
    lit.scene.materials[0].roughness = 0.3f;
    EXPECT_TRUE(lit.update().skipped) << "neither changes diffuse light";
}

TEST(PhotonLattices, AreFiniteForBlackHugeAndBuriedLightsAndWithoutAny) {
    Scene scene = room();
    scene.lights[0].strength = scene.lights[1].strength = kMaxLight;
    scene.lights[0].color = glm::vec3(kMaxLight);
    scene.lights.push_back({.kind = LightKind::Point, .position = glm::vec3(1.4f, 0.5f, 1.3f)});
    scene.lights.push_back({.kind = LightKind::Spot, .position = glm::vec3(-50)});
    scene.lights.push_back({.kind = LightKind::Directional, .color = glm::vec3(0)});
    scene.sky.radiance = glm::vec3(kMaxLight);
    for (const double mode : {0., 1.}) {
        PhotonChoice choice = kFew;
        choice["mode"] = mode;
        choice["sky"] = 1;
        LitByPhotons lit(scene, choice);
        lit.update();
        for (const glm::vec3 e : irradiances(lit))
            for (int c = 0; c < 3; ++c)
                EXPECT_TRUE(std::isfinite(e[c]) && e[c] >= 0);
        lit.scene.lights.clear();
        lit.set("sky", 0);
        EXPECT_EQ(counterOf(lit.update(), "emitted"), 0);
        for (const glm::vec3 e : irradiances(lit))
            EXPECT_EQ(e, glm::vec3(0));
    }
    LitByPhotons empty{simple::SceneBuilder().build()};
    EXPECT_TRUE(empty.update().converged);
}

TEST(PhotonLattices, KeepTheirLightWhenCancelledAndCatchUp) {
    LitByPhotons lit(room(), kFew);
    lit.update();
    const PhotonParts before = lit.lighting->field()->parts;
    lit.scene.lights[0].position.x -= 1;
    const std::atomic<bool> cancel = true;
    const LightingReport report = lit.update({.report = {}, .cancel = &cancel});
    EXPECT_FALSE(report.converged || report.whole || report.skipped);
    EXPECT_TRUE(samePartsOf(lit.lighting->field()->parts, before));
    EXPECT_TRUE(lit.update().converged);
    LitByPhotons anew(lit.scene);
    anew.scene.technique = lit.scene.technique;
    anew.update();
    EXPECT_TRUE(anew.sameLight(lit));
}

// The first update, and the one after a change, when nothing moves any more.
TEST(PhotonLattices, TraceMorePhotonsOnceAtRest) {
    PhotonChoice choice = kFew;
    choice["still"] = 12000;
    LitByPhotons lit(room(), choice);
    const LightingReport first = lit.update();
    EXPECT_TRUE(first.converged);
    const double many = counterOf(first, "emitted");
    EXPECT_GT(many, 1.4 * 12000) << "half of a rectangle's texels look behind it";
    EXPECT_TRUE(lit.update().skipped);
    lit.scene.lights[0].position.y -= 0.3f;
    const LightingReport moving = lit.update();
    EXPECT_FALSE(moving.converged);
    EXPECT_EQ(moving.bounces, 0U);
    EXPECT_LT(counterOf(moving, "emitted"), 0.3 * many);
    const LightingReport resting = lit.update();
    EXPECT_TRUE(resting.converged);
    EXPECT_NEAR(counterOf(resting, "emitted"), many, 0.05 * many);
    lit.scene.lights[0].color = glm::vec3(0, 1, 0);
    const LightingReport recoloured = lit.update();
    EXPECT_TRUE(recoloured.converged);
    EXPECT_EQ(counterOf(recoloured, "lights_traced"), 0);
    EXPECT_TRUE(lit.update().skipped);
}

/// Checks an explanation against the light of parts of the scene.
void expectExact(const PhotonChoice& choice) {
    LitByPhotons lit(room(), choice);
    lit.scene.materials.push_back(simple::lambert(glm::vec3(0.4f), {0.2f, 0.1f, 0.3f}));
    lit.scene.instances[1].material = 2;
    lit.scene.sky.radiance = glm::vec3(1, 2, 3);
    lit.update();
    const auto [p, n] = places()[0];
    FieldReading reading;
    addIrradiance(lit.at(p, n), glm::vec3(1), reading);
    const Explanation e = lit.lighting->explain(lit.scene, reading, {});
    const Explanation black = lit.lighting->explain(lit.scene, reading, {.black = {1}});
    EXPECT_TRUE(black.bySender.empty());
    const glm::vec3 all = lit.irradiance(p, n);
    ASSERT_GE(e.byOrigin.size(), 3U);
    EXPECT_EQ(e.byOrigin[1].label, "Blue");
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(totalOf(e.byOrigin)[c], all[c], 1e-5f * all[c]);
        EXPECT_NEAR(totalOf(e.bySender)[c], all[c], 1e-5f * all[c]);
        EXPECT_LE(totalOf(black.byOrigin)[c], 1.00001f * all[c]);
    }
    lit.scene.lights[0].enabled = false;
    lit.set("emitters", 0);
    lit.update();
    const glm::vec3 blue = lit.irradiance(p, n);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(e.byOrigin[1].value[c], blue[c], 1e-5f * blue[c]);
}

TEST(PhotonLattices, ExplainTheirLightExactly) {
    for (const auto& [key, value] :
         {std::pair{"mode", 0.}, std::pair{"mode", 1.}, std::pair{"lookup", 1.},
          std::pair{"blur", 4.}, std::pair{"splat", 2.}, std::pair{"bounces", 5.}}) {
        SCOPED_TRACE(key);
        PhotonChoice choice = kFew;
        choice["splat_radius"] = 0.1;
        choice[key] = value;
        expectExact(choice);
    }
}

// What arrives from a surface is what is missing once it is black. Other paths do not change.
TEST(PhotonLattices, ExplainWhatASurfaceReflects) {
    Scene scene = room();
    scene.materials.push_back(simple::lambert(glm::vec3(0.6f)));
    scene.instances[1].material = 2;
    LitByPhotons lit(scene, kFew);
    lit.update();
    const auto [p, n] = places()[3];
    FieldReading reading;
    addIrradiance(lit.at(p, n), glm::vec3(1), reading);
    const Explanation e = lit.lighting->explain(lit.scene, reading, {});
    const Explanation black = lit.lighting->explain(lit.scene, reading, {.black = {1}});
    const auto block = std::ranges::find(e.bySender, 1U, &LightRow::index);
    ASSERT_NE(block, e.bySender.end());
    EXPECT_GT(block->value.x, 0);
    const glm::vec3 left = totalOf(e.byOrigin) - block->value;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(totalOf(black.byOrigin)[c], left[c], 1e-5f * left[c]);
}

} // namespace
} // namespace limn::photon_lattices_test
