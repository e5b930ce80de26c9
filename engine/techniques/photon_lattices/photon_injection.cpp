// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_injection.h"

#include "engine/core/parallel.h"
#include "engine/math/sh.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

/// What makes of the two bands of a clamped cosine those of photonHarmonics().
std::array<float, 2> bandFactors(bool incident) {
    return incident ? std::array{1 / glm::pi<float>(), 1.5f / glm::pi<float>()}
                    : std::array{2.f, 1.f};
}

glm::vec3 axisOf(const Photon& photon, bool incident) {
    return incident ? -photon.direction : photon.normal;
}

std::array<float, 4> harmonicsAbout(glm::vec3 axis, bool incident) {
    const std::array<float, 2> factors = bandFactors(incident);
    const float slope = factors[1] * kCosineSlope;
    return {factors[0] * kCosineMean, slope * axis.y, slope * axis.z, slope * axis.x};
}

/// Number of photons in the 27 cells around each cell.
std::vector<std::uint32_t> countAround(const Lattice& lattice,
                                       const std::vector<std::uint32_t>& counts) {
    std::vector<std::uint32_t> around(counts.size());
    const glm::ivec3 size(lattice.size);
    for (std::uint32_t c = 0; c < counts.size(); ++c) {
        const glm::ivec3 middle(lattice.place(c));
        const glm::ivec3 lower = glm::max(middle - 1, 0), upper = glm::min(middle + 1, size - 1);
        for (int z = lower.z; z <= upper.z; ++z)
            for (int y = lower.y; y <= upper.y; ++y)
                for (int x = lower.x; x <= upper.x; ++x)
                    around[c] += counts[lattice.index(glm::uvec3(x, y, z))];
    }
    return around;
}

} // namespace

PhotonLattices photonLattices(const Bounds& bounds, const InjectionSettings& settings) {
    return {latticeOver(bounds, settings.low), latticeOver(bounds, settings.mid),
            latticeOver(bounds, settings.high)};
}

std::array<float, 4> photonHarmonics(const Photon& photon, bool incident) {
    return harmonicsAbout(axisOf(photon, incident), incident);
}

std::array<float, 4> facingHarmonics(glm::vec3 n) {
    return harmonicsAbout(n, false);
}

std::vector<std::uint8_t> choosePlaces(const PhotonMap& map, const Lattice& mid,
                                       const InjectionSettings& settings) {
    std::vector<std::uint8_t> places(map.photons.size());
    std::vector<std::uint32_t> counts(mid.cells());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Photon& photon = map.photons[i];
        const bool narrow = photon.vertex != kNoVertex && map.vertices[photon.vertex].narrow;
        places[i] = std::uint8_t(narrow ? PhotonLattice::High : PhotonLattice::Mid);
        if (!narrow)
            ++counts[cellOf(mid, photon.position, photon.normal)];
    }
    const std::vector<std::uint32_t> around = countAround(mid, counts);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Photon& photon = map.photons[i];
        if (settings.splats == PhotonSplats::All ||
            (settings.splats == PhotonSplats::Caustics &&
             places[i] == std::uint8_t(PhotonLattice::High)))
            places[i] = kSplatted;
        else if (places[i] == std::uint8_t(PhotonLattice::Mid) &&
                 around[cellOf(mid, photon.position, photon.normal)] < settings.few)
            places[i] = std::uint8_t(PhotonLattice::Low);
    }
    return places;
}

PhotonSums injectPhotons(const PhotonMap& map, const std::vector<std::uint8_t>& places,
                         const PhotonLattices& lattices, bool incident) {
    const std::array<float, 2> factors = bandFactors(incident);
    PhotonSums sums;
    parallelRanges(kPhotonLattices, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            std::vector<LobeSample> samples;
            for (std::size_t i = 0; i < places.size(); ++i)
                if (const Photon& photon = map.photons[i]; places[i] == k)
                    samples.push_back({cellOf(lattices[k], photon.position, photon.normal),
                                       axisOf(photon, incident), photon.power});
            if (!samples.empty())
                sums[k] = sumByCell(samples, lattices[k].cells());
            for (CellLobe& cell : sums[k])
                for (std::size_t i = 0; i < cell.lobe.size(); ++i)
                    cell.lobe[i] *= factors[i > 0];
        }
    });
    return sums;
}

} // namespace limn
