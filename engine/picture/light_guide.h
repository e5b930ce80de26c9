// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Light that a ray brings to a surface. Its direction was sampled in proportion to the cosine.
struct RayLight {
    glm::vec3 direction{0}; ///< unit
    float pdf = 0;          ///< density of the direction [sr^-1]
    float light = 0;        ///< in any unit that is the same for all rays
};

/// Path guiding for a small part of a picture: learns from rays where light comes from that
/// cosine-weighted sampling finds rarely, such as the sky through windows or surfaces in the sun. A
/// histogram has the light of each of some hundred cells of equal solid angle, in proportion to
/// which directions are sampled.
///
/// Vorba, Karlik, Sik, Ritschel, Krivanek. On-line Learning of Parametric Mixture Models for Light
/// Transport Simulation. 2014. They learn mixtures of Gaussians; a histogram suffices for one
/// bounce.
class LightGuide {
public:
    /// Adds light that arrives from a unit direction, in any unit that is the same for all.
    void add(glm::vec3 direction, float light) { m_cdf[cellOf(direction)] += std::max(light, 0.f); }

    /// Ends learning, and sets probability(); that is 0 if no light was added.
    void finish(float probability) {
        for (std::size_t i = 1; i < kCells; ++i)
            m_cdf[i] += m_cdf[i - 1];
        m_probability = m_cdf.back() > 0 ? probability : 0;
    }

    /// Probability, in [0, 1), with which a direction is to be sampled by the guide. Others are
    /// sampled in proportion to the cosine.
    float probability() const { return m_probability; }

    /// Samples a direction. Precondition: probability() > 0. `u` in [0, 1)^2.
    glm::vec3 sample(glm::vec2 u) const {
        const float sum = u.x * m_cdf.back();
        const auto found = std::upper_bound(m_cdf.begin(), m_cdf.end() - 1, sum);
        const auto cell = std::size_t(found - m_cdf.begin());
        const float within = std::clamp((sum - before(cell)) / lightOf(cell), 0.f, 1.f);
        const float height = 2 * (float(cell / kSectors) + within) / kBands - 1;
        const float angle = kTurn * (float(cell % kSectors) + u.y) / kSectors;
        const float radius = std::sqrt(std::max(0.f, 1 - height * height));
        return {radius * std::cos(angle), height, radius * std::sin(angle)};
    }
    /// Density of sample() [sr^-1]. Precondition: probability() > 0.
    float pdf(glm::vec3 direction) const {
        return lightOf(cellOf(direction)) / m_cdf.back() * float(kCells) / (2 * kTurn);
    }

private:
    static constexpr std::size_t kBands = 16, kSectors = 32, kCells = kBands * kSectors;
    static constexpr float kTurn = 2 * std::numbers::pi_v<float>;

    static std::size_t cellOf(glm::vec3 d) {
        const float turns = std::atan2(d.z, d.x) / kTurn;
        const auto index = [](float x, std::size_t count) {
            return std::min(std::size_t(std::max(x, 0.f) * float(count)), count - 1);
        };
        return index((d.y + 1) / 2, kBands) * kSectors + index(turns - std::floor(turns), kSectors);
    }
    float before(std::size_t cell) const { return cell > 0 ? m_cdf[cell - 1] : 0; }
    float lightOf(std::size_t cell) const { return m_cdf[cell] - before(cell); }

    std::array<float, kCells> m_cdf{}; ///< light of each cell; after finish(), of all up to it
    float m_probability = 0;
};

/// Learns a guide from the rays of two halves of the pixels. Its probability is the one of 0, 1/4,
/// 1/2 and 3/4 that has the least variance, so that no direction has less than a quarter of the
/// density that it would have without the guide. The variance is that of each half when guided by
/// the other one (cross-validation), because light from near surfaces arrives from another side at
/// each pixel, and what few rays have found is noise.
LightGuide learnGuide(std::span<const RayLight> half, std::span<const RayLight> otherHalf);

} // namespace limn
