// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_report.h"

#include "engine/techniques/photon_lattices/lattice_part.h"
#include "engine/techniques/photon_lattices/splat_part.h"

#include <array>

namespace limn {

namespace {

std::uint64_t bytesOf(const IndirectField& field) {
    std::uint64_t bytes = 0;
    for (std::size_t k = 0; k < field.parts.size(); ++k)
        bytes += k < kPhotonLattices
                     ? static_cast<const PhotonLatticePart&>(*field.parts[k]).cells().bytes()
                     : static_cast<const PhotonSplatPart&>(*field.parts[k]).bytes();
    return bytes;
}

/// Bytes of the lattices as dense images of halfs: three of light and one of area, RGBA each.
std::uint64_t denseBytes(const PhotonLattices& lattices) {
    std::uint64_t cells = 0;
    for (const Lattice& lattice : lattices)
        cells += lattice.cells();
    return cells * 4 * 8;
}

} // namespace

void describePhotons(const PhotonStore& store, const PhotonInputs& inputs,
                     const IndirectField& field, const PhotonUpdateCost& cost,
                     LightingReport& report) {
    std::array<std::uint64_t, kPhotonLattices + 1> stored{};
    PhotonFates fates;
    for (const ShiningSource& source : inputs.sources)
        if (const auto injected = store.of(source.source)) {
            for (const std::uint8_t place : injected->places)
                ++stored[place];
            fates.emitted += injected->map->fates.emitted;
            fates.absorbed += injected->map->fates.absorbed;
            fates.ended += injected->map->fates.ended;
            fates.lost += injected->map->fates.lost;
        }
    report.steps = {
        {"areas", "Areas in cells", "Triangles clipped to the cells of the lattices", cost.areaMs},
        {"photons", "Photons",
         "Reflective shadow maps of lights that are out of date, and the paths of their photons",
         cost.traceMs},
        {"injection", "Injection", "Photons summed in cells", cost.injectionMs},
        {"field", "Lattices", "Lights added in their colours, and the blur", cost.fieldMs}};
    report.counters = {
        {"emitted", "Photons emitted", "Paths that begin at a light", double(fates.emitted)},
        {"absorbed", "Photons absorbed", "Paths that a surface ended", double(fates.absorbed)},
        {"ended", "Photons at their limit", "Paths that ended after the last bounce allowed",
         double(fates.ended)},
        {"lost", "Photons lost", "Paths that left the scene", double(fates.lost)},
        {"stored_low", "Photons, coarse lattice", "Photons stored in the coarse lattice",
         double(stored[0])},
        {"stored_mid", "Photons, middle lattice", "Photons stored in the middle lattice",
         double(stored[1])},
        {"stored_high", "Photons, fine lattice", "Photons stored in the fine lattice",
         double(stored[2])},
        {"splats", "Splats", "Photons that light the surface around them", double(stored[3])},
        {"lights_traced", "Lights traced",
         "Lights, emissive materials and skies whose photons were traced anew",
         double(cost.traced)},
        {"rays", "Rays", "Rays cast for shadow maps and photons", double(cost.rays)},
        {"areas_clipped", "Objects clipped", "Objects whose area in cells was out of date",
         double(cost.clipped)},
        {"bytes", "Memory", "Photons, their sums, areas and the lattices",
         double(store.bytes() + bytesOf(field)), CounterUnit::Bytes},
        // A count, because all that are bytes sum to what the light takes.
        {"dense_mib", "Dense lattices (MiB)", "What the lattices would take as 3D images of halfs",
         double(denseBytes(store.lattices())) / (1 << 20)}};
}

} // namespace limn
