// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_light.h"

#include "engine/core/stopwatch.h"
#include "engine/lattice/cell_lobes.h"
#include "engine/scene/light/unit_light.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/photon_lattices/lattice_part.h"
#include "engine/techniques/photon_lattices/splat_part.h"

#include <algorithm>
#include <utility>

namespace limn {

namespace {

/// What paths of photons depend on besides sources and settings.
RsmSurfaces surfacesOf(const Scene& scene) {
    RsmSurfaces s = rsmSurfacesOf(scene);
    for (std::size_t m = 0; m < s.materials.size(); ++m)
        if (s.materials[m].metallic != 0 || s.materials[m].transmission != 0)
            s.materials[m].roughness = scene.materials[m].roughness;
    return s;
}

std::vector<ShiningSource> sourcesOf(const Scene& scene, const PhotonSettings& settings) {
    std::vector<ShiningSource> sources;
    for (const RsmSource& light : rsmSourcesOf(scene))
        sources.push_back(
            {.source = {.shape = light.shape}, .colour = light.colour, .index = light.index});
    for (std::uint32_t m = 0; m < scene.materials.size() && settings.emitters; ++m)
        if (const Material& material = scene.materials[m]; emits(material))
            sources.push_back({.source = {.origin = PhotonOrigin::Emitters,
                                          .shape = {},
                                          .material = m,
                                          .emission = material.emissiveTexture},
                               .colour = material.emission});
    if (settings.sky)
        sources.push_back({.source = {.origin = PhotonOrigin::Sky, .shape = {}, .sky = scene.sky}});
    return sources;
}

/// Adds the light of cells in a colour. Both lists are in the order of the cells.
std::vector<CellLobe> sumOf(const std::vector<CellLobe>& light, const std::vector<CellLobe>& more,
                            glm::vec3 colour) {
    std::vector<CellLobe> sum;
    sum.reserve(light.size() + more.size());
    std::size_t j = 0;
    for (const CellLobe& cell : more) {
        for (; j < light.size() && light[j].cell < cell.cell; ++j)
            sum.push_back(light[j]);
        sum.push_back(j < light.size() && light[j].cell == cell.cell ? light[j++]
                                                                     : CellLobe{.cell = cell.cell});
        for (std::size_t i = 0; i < cell.lobe.size(); ++i)
            sum.back().lobe[i] += cell.lobe[i] * colour;
    }
    sum.insert(sum.end(), light.begin() + std::ptrdiff_t(j), light.end());
    return sum;
}

/// Sum over the sources in one lattice, in the order of the cells.
std::vector<CellLobe> lightIn(std::size_t k, const PhotonStore& store, const PhotonInputs& inputs) {
    std::vector<CellLobe> light;
    for (const ShiningSource& source : inputs.sources)
        light = sumOf(light, store.of(source.source)->sums[k], source.colour);
    return light;
}

std::vector<Splat> splatsOf(const PhotonStore& store, const PhotonInputs& inputs) {
    std::vector<Splat> splats;
    for (const ShiningSource& source : inputs.sources) {
        const InjectedPhotons& injected = *store.of(source.source);
        for (std::size_t i = 0; i < injected.places.size(); ++i)
            if (const Photon& p = injected.map->photons[i]; injected.places[i] == kSplatted)
                splats.push_back({p.power * source.colour, p.position, p.normal});
    }
    return splats;
}

} // namespace

std::uint64_t InjectedPhotons::bytes() const {
    std::uint64_t cells = 0;
    for (const std::vector<CellLobe>& sum : sums)
        cells += sum.size();
    return map->photons.size() * sizeof(Photon) + map->vertices.size() * sizeof(PhotonVertex) +
           places.size() + cells * sizeof(CellLobe);
}

PhotonInputs photonInputsOf(const Scene& scene) {
    const PhotonSettings settings = photonSettingsOf(scene.technique);
    return {surfacesOf(scene), settings, sourcesOf(scene, settings)};
}

bool PhotonStore::follow(const Scene& scene, const PhotonInputs& now, const TracePhotons& trace,
                         const Progress& progress, PhotonCost& cost) {
    Stopwatch clock;
    m_lattices = photonLattices(scene.bounds, now.settings.injection);
    m_areas.follow(scene, m_lattices);
    cost.clipped += m_areas.clipped();
    cost.areaMs += clock.lap();
    if (m_surfaces != now.surfaces || m_paths != now.settings.paths)
        m_sources.clear();
    m_surfaces = now.surfaces;
    m_paths = now.settings.paths;
    // A light that was switched off keeps its photons; one that moved or went does not.
    const std::vector<ShiningSource>& wanted = now.sources;
    std::erase_if(m_sources, [&](const auto& kept) {
        const bool isOfLight = std::ranges::any_of(scene.lights, [&](const Light& light) {
            return kept->source.origin == PhotonOrigin::Light &&
                   unitLight(light) == kept->source.shape;
        });
        return !isOfLight &&
               std::ranges::find(wanted, kept->source, &ShiningSource::source) == wanted.end();
    });
    const bool sumAnew = m_cells != now.settings.injection;
    m_cells = now.settings.injection;
    const auto inject = [&](const PhotonSource& source, std::shared_ptr<const PhotonMap> map) {
        auto injected = std::make_shared<InjectedPhotons>();
        injected->source = source;
        injected->places = choosePlaces(*map, m_lattices[1], m_cells);
        injected->sums = injectPhotons(*map, injected->places, m_lattices, m_cells.incident);
        injected->map = std::move(map);
        return injected;
    };
    if (sumAnew)
        for (auto& kept : m_sources)
            kept = inject(kept->source, kept->map);
    cost.injectionMs += clock.lap();
    for (const ShiningSource& source : wanted) {
        if (of(source.source))
            continue;
        auto map = std::make_shared<const PhotonMap>(trace(source.source, progress));
        cost.traceMs += clock.lap();
        if (progress.cancelled())
            return false;
        cost.rays += map->fates.rays;
        ++cost.traced;
        m_sources.push_back(inject(source.source, std::move(map)));
        cost.injectionMs += clock.lap();
    }
    return true;
}

std::shared_ptr<const InjectedPhotons> PhotonStore::of(const PhotonSource& source) const {
    const auto it =
        std::ranges::find_if(m_sources, [&](const auto& kept) { return kept->source == source; });
    return it == m_sources.end() ? nullptr : *it;
}

std::uint64_t PhotonStore::bytes() const {
    std::uint64_t bytes = m_areas.bytes();
    for (const auto& source : m_sources)
        bytes += source->bytes();
    return bytes;
}

std::vector<std::shared_ptr<const FieldPart>> photonParts(const PhotonStore& store,
                                                          const PhotonInputs& inputs) {
    const PhotonSettings& settings = inputs.settings;
    std::vector<std::shared_ptr<const FieldPart>> parts;
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        const bool fine = k == std::size_t(PhotonLattice::High);
        const CellsKept kept = !fine                ? CellsKept::All
                               : settings.trilinear ? CellsKept::Around
                                                    : CellsKept::Lit;
        LitCells cells =
            litCells(store.lattices()[k], lightIn(k, store, inputs), store.areas().of(k), kept);
        if (!fine)
            cells = blurred(cells, settings.blur);
        parts.push_back(std::make_shared<const PhotonLatticePart>(
            std::move(cells), settings.injection.incident, settings.trilinear));
    }
    if (settings.injection.splats != PhotonSplats::None) {
        const glm::vec3 size = inputs.surfaces.bounds.size();
        const float longest = std::max({size.x, size.y, size.z});
        parts.push_back(std::make_shared<const PhotonSplatPart>(
            splatsOf(store, inputs), longest > 0 ? settings.splatRadius * longest : 1));
    }
    return parts;
}

} // namespace limn
