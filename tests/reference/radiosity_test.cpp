// SPDX-License-Identifier: MIT
// A second way to the same light: radiosity of a box's patches with exact form factors. It shares
// nothing with the path tracer but the scene.
#include "engine/reference/reference.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace limn::radiosity_test {

using namespace simple;

namespace {

constexpr double kPi = 3.14159265358979;

struct Patch {
    std::array<glm::dvec3, 4> corner; ///< counter-clockwise from inside
    glm::dvec3 centre, normal;
    glm::dvec3 albedo, emission;
};

/// A room of 2 x 1.5 x 3 m, its six walls cut into n x n patches. A lamp in the ceiling's middle,
/// a red and a green wall.
struct Room {
    glm::dvec3 lower{-1, 0, -1.5}, upper{1, 1.5, 1.5};
    glm::dvec3 lampPosition{0.3, 0.4, -0.5};
    double candela = 0.7;
    std::vector<Patch> patches;

    explicit Room(int n) {
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side)
                addWall(n, axis, side);
    }

    void addWall(int n, int axis, int side) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const auto cornerAt = [&](int x, int y) {
                    glm::dvec3 p = side == 1 ? upper : lower;
                    p[u] = lower[u] + (upper[u] - lower[u]) * x / n;
                    p[v] = lower[v] + (upper[v] - lower[v]) * y / n;
                    return p;
                };
                Patch p;
                p.corner = {cornerAt(i, j), cornerAt(i + 1, j), cornerAt(i + 1, j + 1),
                            cornerAt(i, j + 1)};
                if (side == 1)
                    std::swap(p.corner[1], p.corner[3]);
                p.centre = (p.corner[0] + p.corner[2]) * 0.5;
                p.normal = glm::dvec3(0);
                p.normal[axis] = side == 1 ? -1 : 1;
                p.albedo = glm::dvec3(0.7);
                if (axis == 0)
                    p.albedo = side == 0 ? glm::dvec3(0.6, 0.1, 0.05) : glm::dvec3(0.1, 0.5, 0.1);
                const bool lamp = axis == 1 && side == 1 && 4 * i >= n && 4 * i < 3 * n &&
                                  4 * j >= n && 4 * j < 3 * n;
                p.emission = lamp ? glm::dvec3(3, 2, 1) : glm::dvec3(0);
                patches.push_back(p);
            }
    }

    glm::dvec3 directAt(glm::dvec3 x, glm::dvec3 n) const {
        const glm::dvec3 d = lampPosition - x;
        const double r = glm::length(d);
        return glm::dvec3(candela * std::max(0.0, glm::dot(d, n)) / (r * r * r));
    }

    Scene scene() const {
        SceneBuilder b;
        for (const Patch& p : patches) {
            const auto material =
                b.addMaterial(lambert(glm::vec3(p.albedo), glm::vec3(p.emission)));
            b.add(quad(glm::vec3(p.corner[0]), glm::vec3(p.corner[1] - p.corner[0]),
                       glm::vec3(p.corner[3] - p.corner[0]), material));
        }
        Light light;
        light.position = glm::vec3(lampPosition);
        light.strength = float(candela);
        b.scene.lights = {light};
        return b.build();
    }
};

/// Share of the cosine hemisphere at (x, n) that a polygon fills when it lies all on its front.
/// Lambert's formula: sum over edges of the angle they span times the tilt of their plane / 2 pi.
double pointFormFactor(glm::dvec3 x, glm::dvec3 n, const Patch& patch) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3 a = glm::normalize(patch.corner[k] - x);
        const glm::dvec3 b = glm::normalize(patch.corner[(k + 1) % 4] - x);
        const glm::dvec3 c = glm::cross(a, b);
        const double sine = glm::length(c);
        if (sine > 1e-12)
            sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(c / sine, n);
    }
    return std::abs(sum) / (2 * kPi);
}

/// Irradiance at patch centres without the point light's own: E = F B, B = albedo (E + D) + pi Le.
std::vector<glm::dvec3> solve(const Room& room) {
    const std::size_t count = room.patches.size();
    std::vector<double> F(count * count, 0.0);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
            if (room.patches[i].normal != room.patches[j].normal)
                F[i * count + j] = pointFormFactor(room.patches[i].centre, room.patches[i].normal,
                                                   room.patches[j]);
    std::vector<glm::dvec3> E(count, glm::dvec3(0)), B(count);
    for (int bounce = 0; bounce < 60; ++bounce) { // 0.7^60 < 1e-9
        for (std::size_t j = 0; j < count; ++j) {
            const Patch& p = room.patches[j];
            B[j] = p.albedo * (E[j] + room.directAt(p.centre, p.normal)) + kPi * p.emission;
        }
        for (std::size_t i = 0; i < count; ++i) {
            E[i] = glm::dvec3(0);
            for (std::size_t j = 0; j < count; ++j)
                E[i] += F[i * count + j] * B[j];
        }
    }
    return E;
}

} // namespace

TEST(Radiosity, FormFactorsFromAPointFillTheHemisphere) {
    const Room room(4);
    for (const Patch& p : room.patches) {
        double sum = 0;
        for (const Patch& q : room.patches)
            if (q.normal != p.normal)
                sum += pointFormFactor(p.centre, p.normal, q);
        EXPECT_NEAR(sum, 1, 1e-9);
    }
}

TEST(Radiosity, PathTracingAgreesWithIt) {
    constexpr int n = 12;
    const Room room(n);
    const std::vector<glm::dvec3> E = solve(room);
    const TraceScene trace(room.scene());
    // The patches' piecewise constant light errs most beside an edge: three patches or more from
    // the room's edges it is below 0.5 % (n = 12 against n = 24).
    constexpr std::uint32_t samples = 1 << 12;
    double sum = 0, exact = 0, variance = 0;
    for (std::size_t i = 0; i < E.size(); ++i) {
        const std::size_t x = i % n, y = i / n % n;
        if (x % 3 != 1 || y % 3 != 1)
            continue;
        const Patch& p = room.patches[i];
        const auto traced = [&](std::uint32_t half) {
            return glm::dvec3(referenceIrradiance(trace, glm::vec3(p.centre), glm::vec3(p.normal),
                                                  samples, 64, false, 2 * std::uint32_t(i) + half));
        };
        const glm::dvec3 a = traced(0), b = traced(1), mean = (a + b) * 0.5;
        const bool inside = x > 2 && x < n - 3 && y > 2 && y < n - 3;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean[c] / E[i][c], 1, inside ? 0.02 : 0.035) << "patch " << i;
        const double d = a.x + a.y + a.z - (b.x + b.y + b.z);
        variance += d * d / 4;
        sum += mean.x + mean.y + mean.z;
        exact += E[i].x + E[i].y + E[i].z;
    }
    const double error = std::sqrt(variance) / exact;
    EXPECT_LT(error, 1.5e-3);
    EXPECT_NEAR(sum / exact, 1, 1e-3 + 4 * error);
}

} // namespace limn::radiosity_test
