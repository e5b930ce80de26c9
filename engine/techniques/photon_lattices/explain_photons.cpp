// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/explain_photons.h"

#include "engine/techniques/photon_lattices/lattice_part.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

namespace limn {

namespace {

/// Per colour, the weight of each harmonic that a photon adds to a cell.
using CellWeight = std::array<glm::dvec3, 4>;

/// Weights of a reading, of cells before the blur and of splats.
struct PhotonWeights {
    std::array<std::unordered_map<std::uint32_t, CellWeight>, kPhotonLattices> cells;
    std::unordered_map<std::uint32_t, glm::dvec3> splats; ///< by their number
};

/// Takes the reading's weights back to the cells into which photons were summed.
PhotonWeights weightsOf(const FieldReading& reading, const IndirectField& field, PhotonBlur blur) {
    PhotonWeights weights;
    const std::vector<WeightedCell> around = blurWeights(blur);
    const std::vector<WeightedCell> alone = blurWeights(PhotonBlur::None);
    for (const FieldReading::PartNumber& number : reading.partNumbers) {
        if (number.part >= kPhotonLattices) {
            weights.splats[number.index] += glm::dvec3(number.weight);
            continue;
        }
        const LitCells& lit =
            static_cast<const PhotonLatticePart&>(*field.parts[number.part]).cells();
        const glm::ivec3 middle(lit.lattice.place(lit.cellOf[number.index / 4]));
        const glm::ivec3 last(lit.lattice.size - 1U);
        const bool fine = number.part == std::uint32_t(PhotonLattice::High);
        for (const WeightedCell& w : fine ? alone : around) {
            const glm::ivec3 p = middle + w.offset;
            if (glm::clamp(p, glm::ivec3(0), last) == p)
                weights.cells[number.part][lit.lattice.index(glm::uvec3(p))][number.index % 4] +=
                    glm::dvec3(number.weight) * double(w.weight);
        }
    }
    return weights;
}

/// Whether the photon's path has no vertex on these instances, but for the place that emits it.
bool avoids(const PhotonMap& map, const Photon& photon, const std::vector<std::uint32_t>& black) {
    for (std::uint32_t v = photon.vertex; v != kNoVertex; v = map.vertices[v].previous)
        if (map.vertices[v].event != PhotonEvent::Emitted &&
            std::ranges::find(black, map.vertices[v].instance) != black.end())
            return false;
    return true;
}

/// Calls add(photon, value) for each photon of a source that contributes. `splats` counts the
/// splats of the sources so far.
template <class Add>
void forPhotons(const InjectedPhotons& source, glm::vec3 colour, const PhotonLattices& lattices,
                bool incident, const PhotonWeights& weights, std::uint32_t& splats,
                const Add& add) {
    for (std::size_t i = 0; i < source.places.size(); ++i) {
        const Photon& photon = source.map->photons[i];
        const std::uint8_t place = source.places[i];
        glm::dvec3 weight(0);
        if (place == kSplatted) {
            if (const auto it = weights.splats.find(splats++); it != weights.splats.end())
                weight = it->second;
        } else {
            const auto it =
                weights.cells[place].find(cellOf(lattices[place], photon.position, photon.normal));
            if (it == weights.cells[place].end())
                continue;
            const std::array<float, 4> y = photonHarmonics(photon, incident);
            for (std::size_t k = 0; k < 4; ++k)
                weight += it->second[k] * double(y[k]);
        }
        if (weight != glm::dvec3(0))
            add(photon, weight * glm::dvec3(photon.power * colour));
    }
}

} // namespace

Explanation explainPhotons(const Scene& scene, const PhotonStore& store, const PhotonInputs& inputs,
                           const IndirectField& field, const FieldReading& reading,
                           const ExplainOptions& options) {
    Explanation e{.byOrigin = {}, .bySender = {}, .bounces = inputs.settings.paths.bounces};
    const PhotonWeights weights = weightsOf(reading, field, inputs.settings.blur);
    std::map<std::uint32_t, glm::dvec3> senders; // by instance; kNoVertex: the sky
    glm::dvec3 emitters(0);
    std::uint32_t splats = 0;
    for (const ShiningSource& source : inputs.sources) {
        const InjectedPhotons& injected = *store.of(source.source);
        glm::dvec3 sum(0);
        forPhotons(injected, source.colour, store.lattices(), inputs.settings.injection.incident,
                   weights, splats, [&](const Photon& photon, glm::dvec3 value) {
                       if (!avoids(*injected.map, photon, options.black))
                           return;
                       sum += value;
                       senders[photon.vertex == kNoVertex
                                   ? kNoVertex
                                   : injected.map->vertices[photon.vertex].instance] += value;
                   });
        if (source.source.origin == PhotonOrigin::Light)
            addRow(e.byOrigin, {.kind = LightRowKind::Light,
                                .label = scene.lights[source.index].name,
                                .index = source.index,
                                .value = glm::vec3(sum)});
        else if (source.source.origin == PhotonOrigin::Sky)
            addRow(e.byOrigin,
                   {.kind = LightRowKind::Sky, .label = "Sky", .value = glm::vec3(sum)});
        else
            emitters += sum;
    }
    if (emitters != glm::dvec3(0))
        addRow(e.byOrigin, {.kind = LightRowKind::Others,
                            .label = "Emissive surfaces",
                            .value = glm::vec3(emitters)});
    if (!options.black.empty())
        return e;
    std::vector<LightRow> rows;
    for (const auto& [instance, value] : senders)
        rows.push_back(
            instance == kNoVertex
                ? LightRow{.kind = LightRowKind::Sky, .label = "Sky", .value = glm::vec3(value)}
                : LightRow{.kind = LightRowKind::Surface,
                           .label = objectLabel(scene, instance),
                           .index = instance,
                           .value = glm::vec3(value)});
    e.bySender = strongest(std::move(rows), options.rows);
    return e;
}

} // namespace limn
