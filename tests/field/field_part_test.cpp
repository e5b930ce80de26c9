// SPDX-License-Identifier: MIT
#include "engine/field/field_reading.h"
#include "tests/field/second_grid.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include <glm/geometric.hpp>

namespace limn::field_part_test {
namespace {

/// A grid of 3 x 2 x 2 cells around the origin with light that is positive nearly everywhere.
IndirectField randomGrid(unsigned seed, std::uint32_t bands = 4) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-0.1f, 0.1f);
    IndirectField field;
    field.bands = bands;
    field.gridSize = {3, 2, 2};
    field.gridBounds = {glm::vec3(-1), glm::vec3(1)};
    for (std::size_t k = 0; k < field.coefficients() * field.cells(); ++k) {
        const glm::vec3 value(uniform(random), uniform(random), uniform(random));
        field.grid.emplace_back(k < field.cells() ? value + 1.f : value, 0);
    }
    return field;
}

/// Points in the grid, of a scene without lightmap.
struct Points {
    LightmapLayout layout;
    Scene scene;
    std::mt19937 random{3};

    glm::vec3 vector() {
        std::uniform_real_distribution<float> uniform(-1, 1);
        return {uniform(random), uniform(random), uniform(random)};
    }
    FieldPoint next(const IndirectField& field) {
        return {field, layout,      scene, 0, 0, 0, 0, vector(), glm::normalize(vector()),
                false, glm::vec3(0)};
    }
};

void expectNear(glm::vec3 a, glm::vec3 b, float share) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], share * std::abs(b[c]) + 1e-6f) << "colour " << c;
}

std::array<float, kMaxBands> lobeFactors() {
    return {1, 0.8f, 0.5f, 0.2f};
}

/// Compares all three lookups of two fields, the second of which is multiplied by a factor.
void expectSameLight(const IndirectField& a, const IndirectField& b, float factor) {
    Points points;
    for (int k = 0; k < 50; ++k) {
        const FieldPoint inA = points.next(a);
        const FieldPoint inB{b, points.layout, points.scene, 0, 0, 0, 0, inA.position, inA.normal};
        const glm::vec3 d = inA.normal;
        expectNear(sampleIrradiance(inA), factor * sampleIrradiance(inB), 1e-5f);
        expectNear(sampleRadiance(inA, d), factor * sampleRadiance(inB, d), 1e-5f);
        expectNear(sampleLobe(inA, d, 4, lobeFactors()),
                   factor * sampleLobe(inB, d, 4, lobeFactors()), 1e-5f);
    }
}

TEST(FieldPart, ASecondGridLightsAsTheFieldsOwnDoes) {
    const IndirectField own = randomGrid(1);
    IndirectField part;
    EXPECT_TRUE(part.empty());
    part.parts = {std::make_shared<SecondGrid>(own)};
    EXPECT_FALSE(part.empty());
    expectSameLight(part, own, 1);
    IndirectField twice = own;
    twice.parts = part.parts;
    expectSameLight(twice, own, 2);
    twice.parts.push_back(part.parts[0]);
    expectSameLight(twice, own, 3);
}

TEST(FieldPart, TheSumIsClampedNotTheParts) {
    IndirectField field = randomGrid(1), negative = field;
    for (glm::vec4& c : negative.grid)
        c *= -0.5f;
    const IndirectField whole = field;
    field.parts = {std::make_shared<SecondGrid>(negative)};
    expectSameLight(field, whole, 0.5f);
    for (glm::vec4& c : negative.grid)
        c *= 4.f;
    field.parts = {std::make_shared<SecondGrid>(negative)};
    Points points;
    EXPECT_EQ(sampleIrradiance(points.next(field)), glm::vec3(0));
}

TEST(FieldPart, AReadingHasTheValueOfTheLookupsInAnyLight) {
    IndirectField field = randomGrid(1), other = randomGrid(2);
    field.parts = {std::make_shared<SecondGrid>(randomGrid(3)),
                   std::make_shared<SecondGrid>(randomGrid(4, 2))};
    other.parts = {std::make_shared<SecondGrid>(randomGrid(5)),
                   std::make_shared<SecondGrid>(randomGrid(6, 2))};
    Points points;
    FieldReading reading;
    glm::vec3 inField(0), inOther(0);
    const glm::vec3 weight(0.5f, 1, 2);
    for (int k = 0; k < 20; ++k) {
        const FieldPoint p = points.next(field);
        const FieldPoint q{other, points.layout, points.scene, 0, 0, 0, 0, p.position, p.normal};
        const glm::vec3 d = p.normal;
        addIrradiance(p, weight, reading);
        addRadiance(p, d, weight, reading);
        addLobe(p, d, 3, lobeFactors(), weight, reading);
        inField += weight * (sampleIrradiance(p) + sampleRadiance(p, d) +
                             sampleLobe(p, d, 3, lobeFactors()));
        inOther += weight * (sampleIrradiance(q) + sampleRadiance(q, d) +
                             sampleLobe(q, d, 3, lobeFactors()));
    }
    expectNear(valueOf(reading, field), inField, 1e-5f);
    expectNear(valueOf(reading, other), inOther, 1e-5f);
    // 9 coefficients of 12 cells, and 4 of the grid with two bands: each number once.
    EXPECT_LE(reading.partNumbers.size(), 12U * (9 + 4));
    field.parts.clear();
    EXPECT_LT(valueOf({.entries = reading.entries}, field).y, 0.5f * inField.y);
}

TEST(FieldPart, FieldsAreEqualIfTheirPartsAre) {
    IndirectField a = randomGrid(1), b = a;
    a.parts = {std::make_shared<SecondGrid>(randomGrid(2))};
    EXPECT_FALSE(a == b);
    b.parts = {std::make_shared<SecondGrid>(randomGrid(2))};
    EXPECT_TRUE(a == b);
    b.parts = {std::make_shared<SecondGrid>(randomGrid(3))};
    EXPECT_FALSE(a == b);
}

} // namespace
} // namespace limn::field_part_test
