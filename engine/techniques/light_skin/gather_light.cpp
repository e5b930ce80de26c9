// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/gather_light.h"

#include "engine/core/parallel.h"
#include "engine/techniques/light_skin/lanes.h"

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kGatherPi = std::numbers::pi_v<float>;

/// Squares of distances count as at least this [m^2]; that to the fourth power is still a float.
constexpr float kMinDistance2 = 1e-18f;

/// ProxySums of each lane.
struct LaneSums {
    std::array<Lanes, 3> light{}, first{}, second{};
    Lanes weight{};

    ProxySums sums() const {
        ProxySums all{.weight = float(sumOf(weight))};
        for (std::size_t k = 0; k < 3; ++k) {
            all.light[int(k)] = float(sumOf(light[k]));
            all.first[int(k)] = float(sumOf(first[k]));
            all.second[int(k)] = float(sumOf(second[k]));
        }
        return all;
    }
    void add(const std::array<Lanes, 3>& flux, Lanes transfer, Lanes w,
             const std::array<Lanes, 3>& way) {
        weight += w;
        for (std::size_t k = 0; k < 3; ++k) {
            light[k] += flux[k] * transfer;
            const Lanes moment = w * way[k];
            first[k] += moment;
            second[k] += moment * way[k];
        }
    }
};

Lanes dot(const std::array<Lanes, 3>& a, glm::vec3 b) {
    return a[0] * b.x + a[1] * b.y + a[2] * b.z;
}

} // namespace

GatheringLights gatheringLights(const VirtualLights& lights, const ChosenLights& chosen,
                                float diagonal) {
    const double epsilon =
        double(kProxyEpsilon) / std::max(double(diagonal) * double(diagonal), 1e-30);
    GatheringLights from;
    const std::size_t padded = (chosen.light.size() + kSkinLanes - 1) / kSkinLanes * kSkinLanes;
    from.area.assign(padded, 0);
    from.weight.assign(padded, 0);
    for (std::size_t k = 0; k < 3; ++k)
        for (auto* values : {&from.position[k], &from.normal[k], &from.flux[k]})
            values->assign(padded, 0);
    for (std::size_t i = 0; i < chosen.light.size(); ++i) {
        const std::uint32_t light = chosen.light[i];
        from.area[i] = lights.area[light];
        from.weight[i] = chosen.weight[i];
        for (std::size_t k = 0; k < 3; ++k) {
            from.position[k][i] = lights.position[k][light];
            from.normal[k][i] = lights.normal[k][light];
            from.flux[k][i] = lights.flux[k][light] * chosen.weight[i];
        }
        const glm::dvec3 x(lights.positionOf(light));
        const double weight = double(chosen.weight[i]) * double(lights.area[light]) * epsilon;
        from.allWeight += weight;
        from.allFirst += weight * x;
        from.allSecond += weight * x * x;
    }
    return from;
}

/// Adds g epsilon A / D^2 of all lights, whether they light the cache or not: sums of powers of x -
/// c follow from those of x.
static void addEpsilon(const GatheringLights& from, const GatheringCache& cache, ProxySums& sums) {
    const glm::dvec3 c(cache.position);
    sums.weight = float(double(sums.weight) + from.allWeight);
    sums.first = glm::vec3(glm::dvec3(sums.first) + from.allFirst - c * from.allWeight);
    sums.second = glm::vec3(glm::dvec3(sums.second) + from.allSecond - 2. * c * from.allFirst +
                            c * c * from.allWeight);
}

CacheSums gatherLight(const GatheringLights& from, const GatheringCache& cache) {
    LaneSums diffuse, glossy;
    const bool glosses = cache.mirrored != glm::vec3(0);
    for (std::size_t i = 0; i < from.weight.size(); i += kSkinLanes) {
        std::array<Lanes, 3> way, flux;
        Lanes leaving{};
        for (std::size_t k = 0; k < 3; ++k) {
            way[k] = loadLanes(from.position[k], i, kSkinLanes) - cache.position[int(k)];
            leaving -= loadLanes(from.normal[k], i, kSkinLanes) * way[k];
        }
        const Lanes cosines = positive(leaving) * positive(dot(way, cache.normal));
        if (!anyAbove0(cosines))
            continue;
        for (std::size_t k = 0; k < 3; ++k)
            flux[k] = loadLanes(from.flux[k], i, kSkinLanes);
        const Lanes area = loadLanes(from.area, i, kSkinLanes);
        const Lanes r2 =
            notBelow(way[0] * way[0] + way[1] * way[1] + way[2] * way[2], kMinDistance2);
        const Lanes transfer = cosines / (r2 * (area + kGatherPi * r2));
        const Lanes factor = loadLanes(from.weight, i, kSkinLanes) * area * transfer;
        diffuse.add(flux, transfer, factor, way);
        if (!glosses)
            continue;
        const Lanes along = positive(dot(way, cache.mirrored));
        if (!anyAbove0(along))
            continue;
        const Lanes lobe = powerOf(along * along / r2, cache.exponent / 2);
        glossy.add(flux, transfer * lobe, factor * lobe, way);
    }
    CacheSums all{diffuse.sums(), {}};
    addEpsilon(from, cache, all.diffuse);
    if (glosses) {
        all.glossy = glossy.sums();
        addEpsilon(from, cache, all.glossy);
        all.glossy.light *= (cache.exponent + 2) / (2 * kGatherPi);
    }
    return all;
}

glm::vec3 mirroredWay(glm::vec3 position, glm::vec3 normal, glm::vec3 eye) {
    const glm::vec3 way = position - eye;
    const float length = glm::length(way);
    return length > 0 ? glm::reflect(way / length, normal) : normal;
}

GatheringCache gatheringCache(const LightCaches& caches, std::span<const float> exponents,
                              const glm::vec3* eye, std::size_t c) {
    GatheringCache cache{.position = caches.position[c], .normal = caches.normal[c]};
    if (eye) {
        cache.mirrored = mirroredWay(cache.position, cache.normal, *eye);
        cache.exponent = exponents[c];
    }
    return cache;
}

void gatherLights(const LightCaches& caches, std::span<const float> exponents,
                  const GatheringLights& from, const glm::vec3* eye, std::vector<CacheSums>& sums,
                  const Progress& progress) {
    sums.resize(caches.size());
    parallelRanges(caches.size(), 16, progress, "light caches",
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t c = begin; c < end; ++c)
                           sums[c] = gatherLight(from, gatheringCache(caches, exponents, eye, c));
                   });
}

} // namespace limn
