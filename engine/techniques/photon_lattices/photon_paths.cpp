// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_paths.h"

#include "engine/core/parallel.h"
#include "engine/shading/sampler.h"
#include "engine/shading/surface_point.h"
#include "engine/techniques/photon_lattices/photon_surface.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

namespace {

enum class Fate { Absorbed, Ended, Lost };

void finish(PhotonFates& fates, Fate fate, glm::vec3 power) {
    const auto sum = double(channelSum(power));
    switch (fate) {
    case Fate::Absorbed:
        ++fates.absorbed, fates.absorbedPower += sum;
        break;
    case Fate::Ended:
        ++fates.ended, fates.endedPower += sum;
        break;
    case Fate::Lost:
        ++fates.lost, fates.lostPower += sum;
        break;
    }
}

/// Lets the surface scatter the photon. Returns false where the path is over.
bool bounce(const PhotonScene& scene, const PhotonSurface& surface, std::uint32_t instance,
            const Sampler& sampler, Flight& flight, PhotonMap& map) {
    const std::uint32_t dimension =
        kStartPairs + kScatterPairs * (flight.diffuse + flight.specular);
    const auto scattered = scatter(surface, flight.direction, flight.power, sampler, dimension);
    if (!scattered) {
        finish(map.fates, Fate::Absorbed, flight.power);
        return false;
    }
    const bool diffuse = scattered->event == PhotonEvent::Diffuse;
    std::uint32_t& bounces = diffuse ? flight.diffuse : flight.specular;
    if (bounces == (diffuse ? scene.settings.bounces : scene.settings.specular)) {
        finish(map.fates, Fate::Ended, flight.power);
        return false;
    }
    ++bounces;
    map.vertices.push_back({.position = surface.position,
                            .instance = instance,
                            .previous = flight.vertex,
                            .event = scattered->event,
                            .narrow = scattered->narrow});
    flight.vertex = std::uint32_t(map.vertices.size() - 1);
    const float side = glm::dot(scattered->direction, surface.geometricNormal) > 0 ? 1.f : -1.f;
    flight.origin = scene.trace.clearOf(surface.position, side * surface.geometricNormal);
    // In a corner, rounding may have put the point behind the other wall, but the way to it was
    // free.
    if (side > 0)
        flight.origin -= flight.direction * scene.trace.epsilonAt(surface.position);
    flight.direction = scattered->direction;
    flight.power = scattered->power;
    return true;
}

/// Follows a photon to its end.
void follow(const PhotonScene& scene, Flight flight, const Sampler& sampler, PhotonMap& map) {
    for (;;) {
        ++map.fates.rays;
        const Hit hit = scene.trace.closestHit({flight.origin, flight.direction}, TraceMask::Seen);
        if (!hit)
            return finish(map.fates, Fate::Lost, flight.power);
        const auto surface = photonSurface(
            scene.scene, {.instance = hit.instance,
                          .triangle = hit.triangle,
                          .u = hit.u,
                          .v = hit.v,
                          .position = hit.position,
                          .normal = hit.geometricNormal * (hit.frontFace ? 1.f : -1.f),
                          .front = hit.frontFace});
        if (!surface)
            return finish(map.fates, Fate::Absorbed, flight.power);
        if (surface->diffuse != glm::vec3(0))
            map.photons.push_back({.power = flight.power,
                                   .position = surface->position,
                                   .normal = surface->geometricNormal,
                                   .direction = flight.direction,
                                   .vertex = flight.vertex});
        if (!bounce(scene, *surface, hit.instance, sampler, flight, map))
            return;
    }
}

/// Appends the photons of later paths.
void append(const PhotonMap& more, PhotonMap& map) {
    const auto first = std::uint32_t(map.vertices.size());
    const auto moved = [&](std::uint32_t vertex) {
        return vertex == kNoVertex ? vertex : vertex + first;
    };
    for (Photon photon : more.photons) {
        photon.vertex = moved(photon.vertex);
        map.photons.push_back(photon);
    }
    for (PhotonVertex vertex : more.vertices) {
        vertex.previous = moved(vertex.previous);
        map.vertices.push_back(vertex);
    }
    map.fates.emitted += more.fates.emitted;
    map.fates.absorbed += more.fates.absorbed;
    map.fates.ended += more.fates.ended;
    map.fates.lost += more.fates.lost;
    map.fates.rays += more.fates.rays;
    map.fates.emittedPower += more.fates.emittedPower;
    map.fates.absorbedPower += more.fates.absorbedPower;
    map.fates.endedPower += more.fates.endedPower;
    map.fates.lostPower += more.fates.lostPower;
}

} // namespace

PhotonMap tracePaths(const PhotonScene& scene, std::uint32_t count, const PathOf& start,
                     const Progress& progress) {
    constexpr std::uint32_t kBatch = 512; // paths; sums are made batch by batch
    std::vector<PhotonMap> batches((count + kBatch - 1) / kBatch);
    parallelRanges(batches.size(), 1, progress, "photons", [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            PhotonMap& map = batches[b];
            const auto first = std::uint32_t(b * kBatch);
            for (std::uint32_t path = first; path < std::min(first + kBatch, count); ++path)
                if (const std::optional<PathStart> begun = start(path, map)) {
                    Flight flight = begun->flight;
                    ++map.fates.emitted;
                    map.fates.emittedPower += double(channelSum(flight.power));
                    const Sampler sampler{0, begun->sample};
                    if (!begun->surface ||
                        bounce(scene, *begun->surface, begun->instance, sampler, flight, map))
                        follow(scene, flight, sampler, map);
                }
        }
    });
    PhotonMap map;
    std::size_t photons = 0, vertices = 0;
    for (const PhotonMap& batch : batches) {
        photons += batch.photons.size();
        vertices += batch.vertices.size();
    }
    map.photons.reserve(photons);
    map.vertices.reserve(vertices);
    for (PhotonMap& batch : batches) {
        append(batch, map);
        batch = {};
    }
    return map;
}

} // namespace limn
