// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_overlay.h"

#include "engine/field/sample_field.h"
#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/scene/origin.h"
#include "engine/techniques/photon_lattices/photon_lattices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using Style = OverlayLine::Style;

constexpr std::uint32_t kMaxPhotons = 8192; // marks of an overlay
constexpr float kMarkShare = 0.004f;        // a mark's radius over the scene's diagonal
constexpr std::uint32_t kPathDots = 40;     // of each stretch of a path

const glm::vec3 kEmittedColor(0.95f, 0.9f, 0.3f), kDiffuseColor(0.3f, 0.7f, 1),
    kLaterColor(0.2f, 0.3f, 0.8f), kSpecularColor(1, 0.45f, 0.1f), kGlassColor(0.3f, 0.9f, 0.4f);

float diagonalOf(const LitPhotons& lit) {
    return glm::length(lit.lattices[0].bounds().size());
}

/// Number of diffuse bounces of a photon's path.
std::uint32_t diffuseBounces(const PhotonMap& map, const Photon& photon) {
    std::uint32_t count = 0;
    for (std::uint32_t v = photon.vertex; v != kNoVertex; v = map.vertices[v].previous)
        count += map.vertices[v].event == PhotonEvent::Diffuse ? 1 : 0;
    return count;
}

glm::vec3 eventColor(const PhotonMap& map, const Photon& photon) {
    if (photon.vertex == kNoVertex)
        return kEmittedColor;
    switch (map.vertices[photon.vertex].event) {
    case PhotonEvent::Emitted:
        return kEmittedColor;
    case PhotonEvent::Diffuse:
        return diffuseBounces(map, photon) > 1 ? kLaterColor : kDiffuseColor;
    case PhotonEvent::Specular:
        return kSpecularColor;
    case PhotonEvent::Transmitted:
        return kGlassColor;
    }
    return kEmittedColor;
}

/// Marks at stored photons, evenly chosen. colorOf(stored) may decline by std::nullopt.
template <class ColorOf>
OverlayData photonMarks(const PhotonSnapshot& snapshot, const ColorOf& colorOf) {
    OverlayData out;
    const std::uint32_t count = snapshot.pickCount(), shown = std::min(count, kMaxPhotons);
    const float radius = kMarkShare * diagonalOf(snapshot.lit());
    for (std::uint32_t k = 0; k < shown; ++k) {
        // One of each stretch at random: even steps would pick neighbours in shadow maps.
        const auto begin = std::uint32_t(std::uint64_t(k) * count / shown),
                   end = std::uint32_t(std::uint64_t(k + 1) * count / shown);
        const PhotonSnapshot::Stored s = snapshot.stored(begin + mixBits(k) % (end - begin));
        out.marks.push_back({.position = s.photon->position + s.photon->normal * (0.2f * radius),
                             .radius = radius,
                             .normal = s.photon->normal,
                             .color = packColor(colorOf(s))});
    }
    out.legend.notes = {fmt::format("{} of {} stored photons", shown, count)};
    return out;
}

OverlayData eventOverlay(const PhotonSnapshot& snapshot) {
    OverlayData out = photonMarks(snapshot, [](const PhotonSnapshot::Stored& s) {
        return eventColor(*s.source->injected->map, *s.photon);
    });
    out.legend.title = "Photons by their last bounce";
    out.legend.entries = {{packColor(kDiffuseColor), "diffuse, the first"},
                          {packColor(kLaterColor), "diffuse, a later one"},
                          {packColor(kSpecularColor), "metal or the face of glass"},
                          {packColor(kGlassColor), "through glass"},
                          {packColor(kEmittedColor), "none: from emissive surfaces or the sky"}};
    return out;
}

OverlayData latticeOverlay(const PhotonSnapshot& snapshot, const Scene& scene) {
    const LightmapLayout layout;
    const IndirectField& field = snapshot.lit().field;
    OverlayData out = photonMarks(snapshot, [&](const PhotonSnapshot::Stored& s) {
        const FieldPoint point{
            field, layout,      scene, 0, 0, 0, 0, s.photon->position, s.photon->normal,
            false, glm::vec3(0)};
        glm::vec3 shares(0);
        FieldTaps taps;
        for (int k = 0; k < int(kPhotonLattices); ++k) {
            taps.clear();
            field.parts[std::size_t(k)]->irradianceTaps(point, taps);
            shares[k] = std::max(luminance(field.parts[std::size_t(k)]->sum(taps)), 0.f);
        }
        const float sum = shares.x + shares.y + shares.z;
        return sum > 0 ? encodeSrgb(shares / sum) : glm::vec3(0);
    });
    out.legend.title = "Lattice that lights a surface";
    out.legend.entries = {{packColor({1, 0, 0}), "the coarse one"},
                          {packColor({0, 1, 0}), "the middle one"},
                          {packColor({0, 0, 1}), "the fine one"},
                          {packColor({0, 0, 0}), "none, as where photons are splatted"}};
    return out;
}

/// The places of a photon's path from its first vertex to where it is stored.
std::vector<glm::vec3> pathOf(const PhotonMap& map, const Photon& photon) {
    std::vector<glm::vec3> places = {photon.position};
    for (std::uint32_t v = photon.vertex; v != kNoVertex; v = map.vertices[v].previous)
        places.push_back(map.vertices[v].position);
    std::ranges::reverse(places);
    return places;
}

OverlayData pathOverlay(const PhotonSnapshot& snapshot, const Scene& scene, std::uint32_t pick) {
    OverlayData out;
    out.legend.title = fmt::format("Path of photon {}", pick);
    if (pick >= snapshot.pickCount())
        return out;
    const PhotonSnapshot::Stored s = snapshot.stored(pick);
    std::vector<glm::vec3> places = pathOf(*s.source->injected->map, *s.photon);
    const float radius = kMarkShare * diagonalOf(snapshot.lit());
    if (s.source->light != ~0U && scene.lights[s.source->light].kind != LightKind::Directional)
        places.insert(places.begin(), scene.lights[s.source->light].position);
    const auto dot = [&](glm::vec3 p, float size, glm::vec3 color) {
        out.marks.push_back({.position = p, .radius = size * radius, .color = packColor(color)});
    };
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
        for (std::uint32_t k = 1; k < kPathDots; ++k)
            dot(glm::mix(places[i], places[i + 1], float(k) / kPathDots), 0.4f, kDiffuseColor);
    for (const glm::vec3 p : places)
        dot(p, 1, p == places.back() ? kSpecularColor : kEmittedColor);
    out.legend.entries = {{packColor(kEmittedColor), "a light or a bounce"},
                          {packColor(kSpecularColor), "where the photon is stored"}};
    return out;
}

const char* eventText(PhotonEvent event) {
    switch (event) {
    case PhotonEvent::Emitted:
        return "Emitted by";
    case PhotonEvent::Diffuse:
        return "Reflected diffusely by";
    case PhotonEvent::Specular:
        return "Reflected by";
    case PhotonEvent::Transmitted:
        return "Passed through";
    }
    return "";
}

} // namespace

LitPhotons litPhotons(const PhotonStore& store, const PhotonInputs& inputs,
                      const IndirectField& field) {
    LitPhotons lit{.sources = {}, .lattices = store.lattices(), .field = field};
    for (const ShiningSource& source : inputs.sources)
        lit.sources.push_back({store.of(source.source), source.colour,
                               source.source.origin == PhotonOrigin::Light ? source.index : ~0U});
    return lit;
}

PhotonSnapshot::PhotonSnapshot(LitPhotons lit) : m_lit(std::move(lit)) {
    for (const LitPhotons::Source& source : m_lit.sources)
        m_count += std::uint32_t(source.injected->places.size());
}

const Technique& PhotonSnapshot::technique() const {
    return kPhotonTechnique;
}

PhotonSnapshot::Stored PhotonSnapshot::stored(std::uint32_t pick) const {
    auto source = m_lit.sources.begin();
    while (pick >= source->injected->places.size())
        pick -= std::uint32_t(source++->injected->places.size());
    return {&source->injected->map->photons[pick], &*source, source->injected->places[pick]};
}

OverlayData PhotonSnapshot::overlay(const OverlayRequest& request, const Scene& scene,
                                    const LightSnapshot* /*light*/) const {
    if (!request.kind)
        return {};
    switch (request.kind - kPhotonOverlays.data()) {
    case 0:
        return eventOverlay(*this);
    case 1:
        return pathOverlay(*this, scene, request.pick);
    case 2:
        return cellLobeOverlay(m_lit);
    case 3:
        return cellCountOverlay(m_lit);
    case 4:
        return latticeOverlay(*this, scene);
    case 5:
        return cellAreaOverlay(m_lit);
    default:
        return {};
    }
}

std::optional<std::uint32_t> PhotonSnapshot::closest(glm::vec3 p, glm::vec3 normal) const {
    std::optional<std::uint32_t> found;
    float minimum = std::numeric_limits<float>::infinity();
    std::uint32_t number = 0;
    for (const LitPhotons::Source& source : m_lit.sources)
        for (const Photon& photon : source.injected->map->photons) {
            const float distance = glm::distance(photon.position, p);
            // Photons of another side count as farther away.
            const float score = glm::dot(photon.normal, normal) > 0 ? distance : 4 * distance;
            if (score < minimum) {
                minimum = score;
                found = number;
            }
            ++number;
        }
    return found;
}

std::optional<std::uint32_t> PhotonSnapshot::pickAt(const Scene& /*scene*/, const Hit& hit) const {
    return closest(hit.position, hit.geometricNormal * (hit.frontFace ? 1.f : -1.f));
}

std::optional<std::uint32_t> PhotonSnapshot::nearestPick(const OverlaySource& other,
                                                         std::uint32_t pick) const {
    const Photon& before = *static_cast<const PhotonSnapshot&>(other).stored(pick).photon;
    return closest(before.position, before.normal);
}

std::vector<OverlayLine> PhotonSnapshot::describePick(const Scene& scene,
                                                      std::uint32_t pick) const {
    if (pick >= m_count)
        return {};
    const Stored s = stored(pick);
    const PhotonMap& map = *s.source->injected->map;
    const glm::vec3 power = s.photon->power * s.source->colour;
    constexpr std::array<const char*, kPhotonLattices + 1> kPlaces = {
        "In the coarse lattice", "In the middle lattice", "In the fine lattice", "Splatted"};
    std::vector<OverlayLine> lines = {
        {Style::Plain, fmt::format("Photon {} of {}", pick, m_count)},
        {Style::Plain, placeText(scene.origin, s.photon->position)},
        {Style::Plain, fmt::format("Power {:.3g} {:.3g} {:.3g} W", power.x, power.y, power.z),
         "Red, green and blue power that falls on the surface"},
        {Style::Plain, kPlaces[s.place]},
        {Style::Separator, ""},
        {Style::Heading, "Its path, backwards"}};
    for (std::uint32_t v = s.photon->vertex; v != kNoVertex; v = map.vertices[v].previous)
        lines.push_back({Style::Plain, fmt::format("{} {}", eventText(map.vertices[v].event),
                                                   objectLabel(scene, map.vertices[v].instance))});
    lines.push_back({Style::Plain, s.source->light != ~0U
                                       ? "Sent by " + scene.lights[s.source->light].name
                                   : s.photon->vertex == kNoVertex ||
                                           s.source->injected->source.origin == PhotonOrigin::Sky
                                       ? std::string("Sent by the sky")
                                       : std::string("Sent by an emissive surface")});
    return lines;
}

} // namespace limn
