// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/fit_texels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limn::fit_texels_test {
namespace {

/// A row of texels, whose centres lie at 0, 1, 2 …, and points evenly spread between the first and
/// the last.
struct Row {
    std::size_t texels;
    TexelFitInput input;
    std::vector<float> places;

    explicit Row(std::size_t count, std::size_t perTexel = 8) : texels(count) {
        input.texels = count;
        const std::size_t points = (count - 1) * perTexel;
        for (std::size_t k = 0; k < points; ++k)
            addPoint((float(k) + 0.5f) / float(perTexel), 1 / float(perTexel));
        for (std::uint32_t t = 0; t + 1 < count; ++t)
            input.neighbours.emplace_back(t, t + 1);
    }
    static TexelLookup lookupAt(float x, std::uint32_t first = 0) {
        const auto left = std::uint32_t(x);
        return {{first + left, first + left + 1, 0, 0},
                {1 - (x - float(left)), x - float(left), 0, 0}};
    }
    void addPoint(float x, float weight) {
        places.push_back(x);
        input.points.push_back(lookupAt(x));
        input.weights.push_back(weight);
    }
    template <class Light>
    std::vector<glm::vec3> fit(const Light& lightAt) const {
        std::vector<glm::vec3> light, first(texels);
        for (const float x : places)
            light.emplace_back(lightAt(x));
        for (std::size_t t = 0; t < texels; ++t)
            first[t] = glm::vec3(lightAt(float(t)));
        return TexelFit(input).solve(light, first);
    }
};

float shownAt(const std::vector<glm::vec3>& texels, float x) {
    const TexelLookup lookup = Row::lookupAt(x);
    return texels[lookup.texel[0]].x * lookup.weight[0] +
           texels[lookup.texel[1]].x * lookup.weight[1];
}

template <class Light>
double squaredError(const std::vector<glm::vec3>& texels, const Row& row, const Light& lightAt) {
    double sum = 0;
    for (const float x : row.places)
        sum += std::pow(double(shownAt(texels, x) - lightAt(x)), 2);
    return sum / double(row.places.size());
}

TEST(TexelFit, KeepsWhatIsLinear) {
    const Row row(9);
    const auto light = [](float x) { return 2 + 3 * x; };
    const std::vector<glm::vec3> fitted = row.fit(light);
    for (std::size_t t = 0; t < row.texels; ++t)
        EXPECT_NEAR(fitted[t].x, light(float(t)), 1e-3f) << t;
}

TEST(TexelFit, HasLessErrorThanValuesAtCentres) {
    const Row row(17);
    const auto ramp = [](float x) { return std::clamp((x - 7.3f) / 1.5f, 0.f, 1.f); };
    std::vector<glm::vec3> atCentres;
    for (std::size_t t = 0; t < row.texels; ++t)
        atCentres.emplace_back(ramp(float(t)));
    EXPECT_LT(squaredError(row.fit(ramp), row, ramp), 0.6 * squaredError(atCentres, row, ramp));
}

/// The normal equations of hat functions of width 1: the mass matrix (1/6, 4/6, 1/6), whose inverse
/// rings by the factor sqrt(3) - 2 from texel to texel beside an edge.
TEST(TexelFit, RingsBesideAnEdgeAsTheMassMatrixSays) {
    Row row(33, 64);
    const auto edge = [](float x) { return x < 16 ? 0.f : 1.f; };
    row.input.neighbours.clear();
    const std::vector<glm::vec3> fitted = row.fit(edge);
    const float ratio = std::sqrt(3.f) - 2;
    EXPECT_NEAR(fitted[16].x, 0.5f, 1e-3f);
    EXPECT_NEAR((fitted[19].x - 1) / (fitted[18].x - 1), ratio, 0.01f);
    EXPECT_NEAR(fitted[13].x / fitted[14].x, ratio, 0.01f);
}

TEST(TexelFit, DefinesTexelsThatNoPointReads) {
    Row row(6);
    row.input.texels = 8; // the last two are beyond all points
    row.input.neighbours.emplace_back(5, 6);
    row.input.neighbours.emplace_back(6, 7);
    std::vector<glm::vec3> light(row.places.size(), glm::vec3(5)), first(8, glm::vec3(5));
    for (const glm::vec3& value : TexelFit(row.input).solve(light, first))
        EXPECT_NEAR(value.x, 5, 1e-3f);
}

TEST(TexelFit, PullsBothSidesOfASeamTogether) {
    // Two rows of light 1 and 2 that meet at the end of one and the start of the other.
    TexelFitInput input;
    input.texels = 8;
    std::vector<glm::vec3> light;
    for (const std::uint32_t first : {0U, 4U})
        for (int k = 0; k < 24; ++k) {
            input.points.push_back(Row::lookupAt((float(k) + 0.5f) / 8, first));
            input.weights.push_back(1 / 8.f);
            light.emplace_back(first == 0 ? 1.f : 2.f);
        }
    const std::vector<glm::vec3> first(light.begin(), light.begin() + 8);
    const std::vector<glm::vec3> apart = TexelFit(input).solve(light, first);
    input.seams.push_back({{{3, 0, 0, 0}, {1, 0, 0, 0}}, {{4, 0, 0, 0}, {1, 0, 0, 0}}, 1});
    const std::vector<glm::vec3> tied = TexelFit(input).solve(light, first);
    EXPECT_NEAR(apart[4].x - apart[3].x, 1, 1e-2f);
    EXPECT_LT(tied[4].x - tied[3].x, 0.2f);
    EXPECT_NEAR(tied[0].x, 1, 0.1f);
    EXPECT_NEAR(tied[7].x, 2, 0.1f);
}

} // namespace
} // namespace limn::fit_texels_test
