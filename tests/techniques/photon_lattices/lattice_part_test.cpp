// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/lattice_part.h"

#include "engine/field/sample_field.h"
#include "engine/shading/sampler.h"
#include "engine/techniques/photon_lattices/splat_part.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace limn::lattice_part_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A lattice of one cell of 2 m around surfaces near the origin.
const Lattice kOneCell{.lower = glm::vec3(-1), .cell = 2, .size = glm::uvec3(1)};

/// Photons on surfaces in the cell.
struct OneCell {
    Scene scene;
    PhotonMap map;

    explicit OneCell(simple::SceneBuilder b, bool twoSided = false) {
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.scene.materials[0].doubleSided = twoSided;
        scene = b.build();
    }
    void add(glm::vec3 power, glm::vec3 n, glm::vec3 direction) {
        map.photons.push_back(
            {.power = power, .position = glm::vec3(0.25f), .normal = n, .direction = direction});
    }
    /// Photons with the directions of Lambertian light on a surface with normal n.
    void addLambertian(float power, glm::vec3 n) {
        constexpr std::uint32_t kCount = 4096;
        for (std::uint32_t i = 0; i < kCount; ++i)
            add(glm::vec3(power / kCount), n, -sampleCosineHemisphere(n, Sampler{0, i}.pair(0)));
    }
    float irradiance(glm::vec3 n, bool incident) const {
        PhotonAreas areas;
        areas.follow(scene, {kOneCell, kOneCell, kOneCell});
        const PhotonSums sums = injectPhotons(map, std::vector<std::uint8_t>(map.photons.size(), 0),
                                              {kOneCell, kOneCell, kOneCell}, incident);
        IndirectField field;
        field.parts = {std::make_shared<const PhotonLatticePart>(
            litCells(kOneCell, sums[0], areas.of(0), CellsKept::Lit), incident, false)};
        return sampleIrradiance({field, {}, scene, 0, 0, 0, 0, glm::vec3(0.25f), n}).x;
    }
};

const glm::vec3 kUp(0, 1, 0), kRight(1, 0, 0);
Mesh floor() {
    return simple::quad(glm::vec3(0), {0, 0, 1}, {1, 0, 0});
}
Mesh wall() {
    return simple::quad(glm::vec3(0), {0, 1, 0}, {0, 0, 1});
}

// A square of 1 m^2 and 6 W. By the photons' surfaces, E = P / A whatever their directions; by
// their directions, 1/3 + cos of that.
TEST(PhotonLattice, LightsAPlaneByPowerOverArea) {
    simple::SceneBuilder b;
    b.add(floor());
    OneCell lambertian(b), headOn(b), grazing(b);
    lambertian.addLambertian(6, kUp);
    headOn.add(glm::vec3(6), kUp, -kUp);
    grazing.add(glm::vec3(6), kUp, kRight);
    for (const OneCell* cell : {&lambertian, &headOn, &grazing})
        EXPECT_NEAR(cell->irradiance(kUp, false), 6, 1e-4);
    EXPECT_NEAR(lambertian.irradiance(kUp, true), 6, 6e-3);
    EXPECT_NEAR(headOn.irradiance(kUp, true), 6 * 4 / 3.f, 1e-4);
    EXPECT_NEAR(grazing.irradiance(kUp, true), 6 / 3.f, 1e-4);
}

TEST(PhotonLattice, BleedsBetweenTwoSquaresAtRightAngles) {
    simple::SceneBuilder b;
    b.add(floor());
    b.add(wall());
    OneCell cell(b);
    cell.addLambertian(6, kUp);
    EXPECT_NEAR(cell.irradiance(kUp, false), 6 * 2 / 3.f, 1e-4);
    EXPECT_NEAR(cell.irradiance(kRight, false), 6 / 3.f, 1e-4);
    EXPECT_NEAR(cell.irradiance(kUp, true), 6 * 2 / 3.f, 5e-3);
    EXPECT_NEAR(cell.irradiance(kRight, true), 6 * 2 / 9.f, 5e-3);
}

TEST(PhotonLattice, KeepsTheBackOfALitSheetDarkByTheSurfacesThatPhotonsMeet) {
    simple::SceneBuilder b;
    b.add(floor());
    OneCell cell(b, true);
    cell.add(glm::vec3(6), kUp, kRight);
    EXPECT_NEAR(cell.irradiance(-kUp, false), 0, 1e-5);
    EXPECT_NEAR(cell.irradiance(-kUp, true), 6 / 3.f, 1e-4);
}

// A sliver of a thousandth of a face: light is divided by a twentieth instead.
TEST(PhotonLattice, DividesByATwentiethOfAFaceAtLeast) {
    simple::SceneBuilder b;
    b.add(simple::quad(glm::vec3(0), {0, 0, 0.004f}, {1, 0, 0}));
    OneCell cell(b);
    cell.add(glm::vec3(6), kUp, -kUp);
    EXPECT_NEAR(cell.irradiance(kUp, false), 6 / (4 / 20.f), 1e-3);
}

TEST(PhotonLattice, RepeatsItsSharesForRadianceAndLobes) {
    simple::SceneBuilder b;
    b.add(floor());
    OneCell cell(b);
    cell.add(glm::vec3(6, 3, 1), kUp, -kUp);
    const auto part = std::make_shared<const PhotonLatticePart>(
        litCells(kOneCell, injectPhotons(cell.map, {0}, {kOneCell, kOneCell, kOneCell}, false)[0],
                 {}, CellsKept::Lit),
        false, false);
    IndirectField field;
    field.parts = {part};
    const FieldPoint point{field, {}, cell.scene, 0, 0, 0, 0, glm::vec3(0.25f), kUp};
    const glm::vec3 e = sampleIrradiance(point);
    EXPECT_GT(e.x, 0);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sampleRadiance(point, kUp)[c], e[c] / kPi, 1e-5f * e.x);
        EXPECT_NEAR(sampleLobe(point, kUp, 3, {1, 0.5f, 0.2f})[c], e[c] / kPi, 1e-5f * e.x);
    }
    EXPECT_TRUE(part->equals(PhotonLatticePart(part->cells(), false, false)));
    EXPECT_FALSE(part->equals(PhotonLatticePart(part->cells(), true, false)));
}

// Hits on a wall in the face between two cells lie on either side of it by rounding.
TEST(PhotonLattice, PutsASurfaceInAFaceIntoTheCellThatItFaces) {
    const Lattice lattice{.lower = glm::vec3(0), .cell = 0.5f, .size = glm::uvec3(4)};
    for (const float error : {-1e-6f, 0.f, 1e-6f}) {
        const glm::vec3 p(1 + error, 0.3f, 0.3f);
        EXPECT_EQ(cellOf(lattice, p, {1, 0, 0}), 2U);
        EXPECT_EQ(cellOf(lattice, p, {-1, 0, 0}), 1U);
    }
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({1, 0.1f, 0.1f}, {0, 0.2f, 0}, {0, 0, 0.2f}));
    const auto cells = surfaceAreas(b.build(), 0, lattice);
    ASSERT_EQ(cells.size(), 1U);
    EXPECT_EQ(cells[0].cell, 2U);
}

// Seven photons within a cell and its neighbours are few; eight are not. Caustics do not count.
TEST(PhotonLattice, LeavesFewPhotonsToTheCoarseLattice) {
    const Lattice mid{.lower = glm::vec3(0), .cell = 1, .size = glm::uvec3(8)};
    PhotonMap map;
    map.vertices = {{.event = PhotonEvent::Diffuse},
                    {.event = PhotonEvent::Transmitted, .narrow = true}};
    const auto add = [&](glm::vec3 p, std::uint32_t vertex) {
        map.photons.push_back(
            {.power = glm::vec3(1), .position = p, .normal = kUp, .vertex = vertex});
    };
    for (int i = 0; i < 7; ++i)
        add({1.5f + float(i % 2), 0.5f, 1.5f}, 0);
    add({1.5f, 0.5f, 1.5f}, 1);
    const auto placesOf = [&](PhotonSplats splats) {
        return choosePlaces(map, mid, {.splats = splats, .few = 8});
    };
    const auto placed = [](PhotonLattice lattice) { return std::uint8_t(lattice); };
    std::vector<std::uint8_t> places = placesOf(PhotonSplats::None);
    EXPECT_EQ(places[0], placed(PhotonLattice::Low));
    EXPECT_EQ(places[7], placed(PhotonLattice::High));
    add({4.5f, 0.5f, 1.5f}, 0); // two cells away from some of the others, one from none
    places = placesOf(PhotonSplats::None);
    EXPECT_EQ(places[0], placed(PhotonLattice::Low));
    add({3.5f, 0.5f, 1.5f}, 0); // one away from those in the second cell
    places = placesOf(PhotonSplats::Caustics);
    EXPECT_EQ(places[0], placed(PhotonLattice::Low));
    EXPECT_EQ(places[1], placed(PhotonLattice::Mid));
    EXPECT_EQ(places[7], kSplatted);
    for (const std::uint8_t place : placesOf(PhotonSplats::All))
        EXPECT_EQ(place, kSplatted);
}

/// Light and surface in each cell of a floor of 6 x 6 cells, all alike but for noise of the light.
LitCells floorCells(float noise) {
    const Lattice lattice{.lower = glm::vec3(0), .cell = 0.5f, .size = {6, 3, 6}};
    std::vector<CellLobe> light;
    std::vector<CellArea> area;
    for (std::uint32_t c = 0; c < lattice.cells(); ++c)
        if (lattice.place(c).y == 0) {
            const std::array<float, 4> y = facingHarmonics(kUp);
            CellLobe lobe{.cell = c};
            CellArea surface{.cell = c};
            for (std::size_t i = 0; i < 4; ++i) {
                const float power = 1 + noise * (float(c % 3) - 1);
                lobe.lobe[i] = glm::vec3(power * y[i]);
                surface.harmonics[i] = 0.25f * y[i];
            }
            light.push_back(lobe);
            area.push_back(surface);
        }
    return litCells(lattice, light, area, CellsKept::All);
}

float irradianceAt(const PhotonLatticePart& part, glm::vec3 p) {
    const IndirectField field;
    const Scene scene;
    FieldTaps taps;
    part.irradianceTaps({field, {}, scene, 0, 0, 0, 0, p, kUp}, taps);
    return part.sum(taps).x;
}

// Light and area are averaged alike, so that even light stays as it is, at edges too.
TEST(PhotonBlur, LeavesEvenLightAndSmoothesTheRest) {
    for (const PhotonBlur blur :
         {PhotonBlur::None, PhotonBlur::SixNeighbours, PhotonBlur::Weighted3, PhotonBlur::Uniform3,
          PhotonBlur::Weighted5, PhotonBlur::Uniform5}) {
        float sum = 0, middle = 0;
        for (const WeightedCell& cell : blurWeights(blur)) {
            sum += cell.weight;
            middle += cell.offset == glm::ivec3(0) ? cell.weight : 0;
        }
        EXPECT_NEAR(sum, 1, 1e-5);
        // Of binomial weights, 2 of 4 and 6 of 16 along each axis.
        constexpr std::array<float, 6> kMiddle = {1,        1 / 7.f,      1 / 8.f,
                                                  1 / 27.f, 216 / 4096.f, 1 / 125.f};
        EXPECT_NEAR(middle, kMiddle[std::size_t(blur)], 1e-6);
        for (const bool trilinear : {false, true}) {
            const PhotonLatticePart even(blurred(floorCells(0), blur), false, trilinear);
            for (const float x : {0.1f, 0.9f, 1.6f, 2.95f})
                EXPECT_NEAR(irradianceAt(even, {x, 0, 1.1f}), 4, 1e-4) << int(blur);
        }
        const PhotonLatticePart noisy(blurred(floorCells(0.5f), blur), false, false);
        const float jump =
            std::abs(irradianceAt(noisy, {1.4f, 0, 1.1f}) - irradianceAt(noisy, {1.6f, 0, 1.1f}));
        if (blur == PhotonBlur::None)
            EXPECT_GT(jump, 1.9f);
        else
            EXPECT_LT(jump, 1.7f) << int(blur);
    }
}

TEST(PhotonLattice, BlendsEightCellsWhenLookedUpTrilinearly) {
    const PhotonLatticePart part(floorCells(0.5f), false, true);
    const float a = irradianceAt(part, {1.25f, 0, 1.25f}),
                b = irradianceAt(part, {1.75f, 0, 1.25f});
    EXPECT_NE(a, b);
    EXPECT_NEAR(irradianceAt(part, {1.5f, 0, 1.25f}), (a + b) / 2, 1e-4);
    EXPECT_NEAR(irradianceAt(part, {1.35f, 0, 1.25f}), 0.8f * a + 0.2f * b, 1e-4);
}

// P / (pi r^2) within r of the photon, on surfaces that face its way to 60 degrees.
TEST(PhotonSplats, LightADisc) {
    const PhotonSplatPart part({{glm::vec3(3, 2, 1), glm::vec3(-0.4f, 0, 0.3f), kUp}}, 0.5f);
    const IndirectField field;
    const Scene scene;
    const auto at = [&](glm::vec3 p, glm::vec3 n) {
        FieldTaps taps;
        part.irradianceTaps({field, {}, scene, 0, 0, 0, 0, p, n}, taps);
        return part.sum(taps);
    };
    const glm::vec3 e = at({-0.1f, 0, 0.1f}, kUp);
    EXPECT_NEAR(e.x, 3 / (kPi * 0.25f), 1e-5);
    EXPECT_NEAR(e.z, 1 / (kPi * 0.25f), 1e-5);
    EXPECT_EQ(at({0.11f, 0, 0.3f}, kUp), glm::vec3(0)) << "beyond the radius";
    const auto tilted = [](float degrees) {
        const float angle = degrees * kPi / 180;
        return glm::vec3(std::sin(angle), std::cos(angle), 0);
    };
    EXPECT_EQ(at({-0.1f, 0, 0.1f}, tilted(59)), e);
    EXPECT_EQ(at({-0.1f, 0, 0.1f}, tilted(61)), glm::vec3(0));
}

} // namespace
} // namespace limn::lattice_part_test
