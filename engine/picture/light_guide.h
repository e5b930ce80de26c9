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

/// What a ray from a surface, whose direction followed the cosine, has brought.
struct RayLight {
    glm::vec3 direction{0}; ///< unit
    float pdf = 0;          ///< of the direction [sr^-1]
    float light = 0;        ///< in any unit that is the same for all rays
};

/// Where light comes from that the surfaces of a small part of a picture find by chance alone, as
/// learned from rays: the sky through windows, surfaces in the sun. It knows how much arrives
/// from each of some hundred cells of equal solid angle, and aims rays there.
///
/// Vorba, Karlik, Sik, Ritschel, Krivanek. On-line Learning of Parametric Mixture Models for Light
/// Transport Simulation. 2014 learn directions likewise; a table suffices for one bounce.
class LightGuide {
public:
    /// Adds light that arrives from a unit direction, in any unit that is the same for all.
    void add(glm::vec3 direction, float light) {
        m_upTo[cellOf(direction)] += std::max(light, 0.f);
    }

    /// Ends learning, and sets share(); that is 0 if no light was added.
    void finish(float share) {
        for (std::size_t i = 1; i < kCells; ++i)
            m_upTo[i] += m_upTo[i - 1];
        m_share = m_upTo.back() > 0 ? share : 0;
    }

    /// Share of the directions that are to be sampled by the guide, in [0, 1). The others follow
    /// the cosine.
    float share() const { return m_share; }

    /// Samples a direction. Precondition: share() > 0. `u` in [0, 1)^2.
    glm::vec3 sample(glm::vec2 u) const {
        const float sum = u.x * m_upTo.back();
        const auto found = std::upper_bound(m_upTo.begin(), m_upTo.end() - 1, sum);
        const auto cell = std::size_t(found - m_upTo.begin());
        const float within = std::clamp((sum - before(cell)) / lightOf(cell), 0.f, 1.f);
        const float height = 2 * (float(cell / kSectors) + within) / kBands - 1;
        const float angle = kTurn * (float(cell % kSectors) + u.y) / kSectors;
        const float radius = std::sqrt(std::max(0.f, 1 - height * height));
        return {radius * std::cos(angle), height, radius * std::sin(angle)};
    }
    /// Density of sample() [sr^-1]. Precondition: share() > 0.
    float pdf(glm::vec3 direction) const {
        return lightOf(cellOf(direction)) / m_upTo.back() * float(kCells) / (2 * kTurn);
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
    float before(std::size_t cell) const { return cell > 0 ? m_upTo[cell - 1] : 0; }
    float lightOf(std::size_t cell) const { return m_upTo[cell] - before(cell); }

    std::array<float, kCells> m_upTo{}; ///< light of a cell; after finish(), of all up to it
    float m_share = 0;
};

/// A guide that aims as many rays as leave the least noise, up to three quarters, so that no
/// direction has less than a quarter of the density that it would have without the guide. Takes
/// rays from two halves of the pixels. What one half teaches is tried on the other, because light
/// that is near arrives from a different side at each pixel, and what few rays have found is noise.
LightGuide learnGuide(std::span<const RayLight> half, std::span<const RayLight> otherHalf);

} // namespace limn
