// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_part.h"
#include "engine/techniques/light_skin/light_caches.h"
#include "engine/techniques/light_skin/proxy_lights.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Where the mean place of proxies lies nearer to a point than this share of their mean distance
/// from their caches, it lights the point as from there. Such places lie between proxies in
/// different directions, where no light is; the paper has no bound, and bright dots there.
inline constexpr float kNearestProxy = 0.5f;

/// The caches that light a surface point, with weights whose sum is 1.
struct SkinWeights {
    std::size_t count = 0;
    std::array<std::uint32_t, NearestCaches::kLength> cache{};
    std::array<float, NearestCaches::kLength> weight{};
};

/// (1 - |x - c| / d_max) sqrt((n . n_c)+) for a cache c of the list, d_max being the distance of
/// the farthest; of a mesh with fewer caches than a list has, twice that. Bischoff, Schwandt,
/// Broll. 2017, equation 8.
SkinWeights skinWeights(const LightCaches& caches, std::span<const std::uint32_t> list,
                        glm::vec3 position, glm::vec3 normal);
/// The same with the ways from the eye, mirrored at both surfaces, in place of normals.
SkinWeights glossyWeights(const LightCaches& caches, std::span<const std::uint32_t> list,
                          glm::vec3 position, glm::vec3 normal, glm::vec3 eye);

/// Light that is kept on objects, as a part of a field. It stores the flux of each cache's diffuse
/// proxy, and after those that of the glossy ones; lookups are linear in the fluxes, given the
/// positions.
class SkinPart : public FieldPart {
public:
    struct Light {
        std::shared_ptr<const LightCaches> caches;
        std::vector<CacheProxies> proxies;
        std::vector<glm::vec3> flux;  ///< of the diffuse proxies, then of the glossy ones
        std::optional<glm::vec3> eye; ///< for which there are glossy proxies
    };
    explicit SkinPart(Light light) : m_light(std::move(light)) {}

    const char* name() const override { return "light on objects"; }
    const Light& light() const { return m_light; }

    void irradianceTaps(const FieldPoint& point, FieldTaps& taps) const override;
    /// As if the irradiance came from all directions alike.
    void radianceTaps(const FieldPoint& point, glm::vec3 direction, FieldTaps& taps) const override;
    /// Ignores direction and factors: the lobe is that of the point's roughness about the way from
    /// the eye, mirrored.
    void lobeTaps(const FieldPoint& point, glm::vec3 direction, int bands,
                  const std::array<float, kMaxBands>& factors, FieldTaps& taps) const override;
    glm::vec3 sum(std::span<const FieldTap> taps) const override;
    bool equals(const FieldPart& other) const override;

private:
    Light m_light;
};

} // namespace limn
