// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/explain_illuminance.h"

#include "engine/techniques/illuminance/relight/adjoint.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

namespace {

using Weights = std::vector<glm::vec3>;

std::vector<CacheWeight> cachesOf(const Caches& caches,
                                  const std::vector<FieldReading::Entry>& entries) {
    std::map<std::pair<bool, std::uint32_t>, const FieldReading::Entry*> wanted;
    for (const FieldReading::Entry& entry : entries)
        wanted[{entry.grid, entry.index}] = &entry;
    std::vector<CacheWeight> weights;
    for (std::uint32_t c = 0; c < caches.size(); ++c)
        if (const auto found = wanted.find({c >= caches.lightmapCount, caches.texel[c]});
            found != wanted.end())
            weights.push_back({c, found->second->weight});
    return validCaches(caches, weights);
}

/// The weights of one reading. Bands in colour keep the colours of light apart, so weights of all
/// three fit in one pass. Grey bands mix them, and each colour of the reading takes a pass of its
/// own.
class Passes {
public:
    Passes(const RelightState& state, const std::vector<CacheWeight>& read) {
        const bool mixes = state.chroma < state.bands || state.inner.chroma < state.inner.luma;
        for (int k = 0; k < (mixes ? 3 : 1); ++k) {
            m_caches.push_back(read);
            for (CacheWeight& w : m_caches.back()) {
                if (mixes)
                    for (glm::vec3& c : w.coefficient)
                        c *= glm::vec3(k == 0, k == 1, k == 2);
                weighGrey(state.bands, state.chroma, w.coefficient);
            }
        }
    }
    std::size_t size() const { return m_caches.size(); }
    const std::vector<CacheWeight>& caches(std::size_t pass) const { return m_caches[pass]; }

    /// What light of some colour adds to the reading, given its weight in each pass.
    template <class WeightIn>
    glm::vec3 value(const WeightIn& weightIn, glm::vec3 light) const {
        if (size() == 1)
            return weightIn(std::size_t(0)) * light;
        return {glm::dot(weightIn(std::size_t(0)), light),
                glm::dot(weightIn(std::size_t(1)), light),
                glm::dot(weightIn(std::size_t(2)), light)};
    }

private:
    std::vector<std::vector<CacheWeight>> m_caches;
};

/// The weights of a reading in all passes.
struct ReadingWeights {
    Passes passes;
    std::vector<Weights> linked;  ///< of nodes, as links' senders
    std::vector<Weights> direct;  ///< of leaves, which light the reading directly
    std::vector<Weights> bounced; ///< of leaves, over all bounces after that
    /// Of what nodes and leaves emit, in the reading of the emitted field.
    std::vector<Weights> linkedEmitted, directEmitted;
    glm::vec3 remainder{0};    ///< value of the bounces that were not followed
    std::uint32_t bounces = 1; ///< followed

    glm::vec3 value(const std::vector<Weights>& weightsOfPass, std::uint32_t node,
                    glm::vec3 light) const {
        return passes.value([&](std::size_t p) { return weightsOfPass[p][node]; }, light);
    }
};

/// The weights of the irradiance that surfels read, given those of the radiosity that they send.
Weights irradianceWeights(const RelightState& state, const Weights& leaves,
                          const std::vector<std::uint8_t>& black) {
    Weights weights(state.albedo.size(), glm::vec3(0));
    for (std::size_t s = 0; s < weights.size(); ++s)
        if (black.empty() || black[s] == 0)
            for (int k = 0; k < 3; ++k) // irradiance clamped to 0 does not change
                weights[s][k] = state.indirect[s][k] > 0 ? leaves[s][k] * state.albedo[s][k] : 0;
    return weights;
}

float absoluteSum(glm::vec3 v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// `black`: per surfel, whether it reflects nothing; empty: all reflect.
ReadingWeights weigh(const RelightState& state, const FieldReading& reading, double tolerance,
                     const std::vector<std::uint8_t>& black) {
    const ClusterTree& tree = state.bake.tree;
    ReadingWeights w{Passes(state, cachesOf(state.bake.caches, reading.entries))};
    const Passes emitted(state, cachesOf(state.bake.caches, reading.emitted));
    glm::vec3 all(0);
    for (std::size_t p = 0; p < w.passes.size(); ++p) {
        w.linked.push_back(linkedNodes(state, w.passes.caches(p)));
        w.direct.push_back(w.linked.back());
        pushWeights(tree, w.direct.back());
        w.direct.back().resize(tree.leaves());
        w.bounced.emplace_back(tree.leaves(), glm::vec3(0));
        w.linkedEmitted.push_back(linkedNodes(state, emitted.caches(p)));
        w.directEmitted.push_back(w.linkedEmitted.back());
        pushWeights(tree, w.directEmitted.back());
    }
    for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf)
        all += w.value(w.direct, leaf, state.radiosity[leaf]);
    const BounceAdjoint back(state);
    std::vector<Weights> latest = w.direct;
    for (; w.bounces < state.maxBounces; ++w.bounces) {
        for (Weights& leaves : latest)
            leaves = irradianceWeights(state, leaves, black);
        w.remainder = glm::vec3(0);
        for (std::uint32_t s = 0; s < tree.surfels; ++s)
            w.remainder += w.value(latest, s, state.indirect[s]);
        if (absoluteSum(w.remainder) <= tolerance * absoluteSum(all))
            return w;
        for (std::size_t p = 0; p < latest.size(); ++p) {
            latest[p] = back(latest[p]);
            for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf)
                w.bounced[p][leaf] += latest[p][leaf];
        }
    }
    w.remainder = glm::vec3(0); // relighting ended here as well
    return w;
}

// By origin.

using ObjectValues = std::map<std::uint32_t, glm::vec3>; ///< by index of the instance

struct OriginTable {
    const RelightState& state;
    const Scene& scene;
    const ReadingWeights& weights;
    const std::vector<std::uint8_t>& black;
    std::vector<LightRow> rows;

    bool reflects(std::uint32_t s) const { return black.empty() || black[s] == 0; }

    void addLights() {
        const DirectIrradiance& direct = state.direct;
        const std::uint32_t surfels = state.bake.tree.surfels;
        std::vector<Weights> reflected(weights.passes.size());
        for (std::size_t p = 0; p < reflected.size(); ++p) {
            reflected[p].resize(surfels);
            for (std::uint32_t s = 0; s < surfels; ++s)
                if (reflects(s))
                    reflected[p][s] =
                        (weights.direct[p][s] + weights.bounced[p][s]) * state.albedo[s];
        }
        std::size_t traced = 0; // DirectIrradiance holds the lights that shine and reach surfels
        for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
            const Light& light = scene.lights[l];
            if (!shines(light) || !reaches(light, direct.bounds))
                continue;
            const std::vector<float>& share = direct.lights[traced++].share;
            const glm::vec3 strength = light.color * light.strength;
            glm::dvec3 sum(0);
            for (std::uint32_t s = 0; s < surfels; ++s)
                if (share[s] > 0)
                    sum += glm::dvec3(
                        weights.value(reflected, s, glm::min(strength * share[s], kMaxIrradiance)));
            addRow(rows, {.kind = LightRowKind::Light,
                          .label = light.name,
                          .index = l,
                          .value = glm::vec3(sum)});
        }
    }

    /// A row with what arrives as it was emitted and what has bounced.
    void addSplit(LightRow row, glm::vec3 emitted, glm::vec3 bounced) {
        row.value = emitted + bounced;
        const std::uint32_t parent = addRow(rows, std::move(row));
        addRow(rows, {.label = "emitted", .parent = parent, .value = emitted});
        addRow(rows, {.label = "bounced", .parent = parent, .value = bounced});
    }

    void addSky() {
        const ClusterTree& tree = state.bake.tree;
        glm::vec3 emitted(0), bounced(0);
        for (std::uint32_t n = tree.surfels; n < tree.leaves(); ++n) {
            emitted += weights.value(weights.direct, n, state.radiosity[n]) +
                       weights.value(weights.directEmitted, n, state.radiosity[n]);
            bounced += weights.value(weights.bounced, n, state.radiosity[n]);
        }
        if (absoluteSum(emitted) + absoluteSum(bounced) > 0)
            addSplit({.kind = LightRowKind::Sky, .label = "Sky"}, emitted, bounced);
    }

    void addEmitters() {
        ObjectValues emitted, bounced;
        for (std::uint32_t s = 0; s < state.emitted.size(); ++s)
            if (state.emitted[s] != glm::vec3(0)) {
                const std::uint32_t object = state.bake.surfels.instance[s];
                emitted[object] += weights.value(weights.direct, s, state.emitted[s]) +
                                   weights.value(weights.directEmitted, s, state.emitted[s]);
                bounced[object] += weights.value(weights.bounced, s, state.emitted[s]);
            }
        for (const auto& [object, value] : emitted)
            addSplit({.kind = LightRowKind::Surface,
                      .label = objectLabel(scene, object),
                      .index = object},
                     value, bounced[object]);
    }

    void addRemainder() {
        if (absoluteSum(weights.remainder) > 0)
            addRow(rows, {.kind = LightRowKind::Remainder,
                          .label = fmt::format("After more than {} bounces", weights.bounces),
                          .value = weights.remainder});
    }
};

// By sender.

struct SenderTable {
    const RelightState& state;
    const Scene& scene;
    const ReadingWeights& weights;
    std::size_t maxRows;
    std::vector<LightRow> rows;

    /// The surfels of a cluster, or of a link to one, by object.
    struct LinkPart {
        std::uint32_t node = 0;
        glm::vec3 value{0};
        std::vector<std::pair<std::uint32_t, glm::vec3>> surfels;
    };
    std::map<std::uint32_t, std::vector<LinkPart>> linksOf; ///< by instance

    /// Calls f(leaf, share) for the leaves below a node.
    template <class F>
    void forEachLeaf(std::uint32_t node, const F& f) const {
        const ClusterTree& tree = state.bake.tree;
        std::vector<std::pair<std::uint32_t, float>> stack{{node, 1.f}};
        while (!stack.empty()) {
            const auto [current, share] = stack.back();
            stack.pop_back();
            if (current < tree.leaves()) {
                f(current, share);
                continue;
            }
            const std::uint32_t inner = current - tree.leaves();
            stack.emplace_back(tree.right[inner], share * (1 - tree.leftWeight[inner]));
            stack.emplace_back(tree.left[inner], share * tree.leftWeight[inner]);
        }
    }

    void findLinks() {
        const ClusterTree& tree = state.bake.tree;
        for (std::uint32_t node = 0; node < tree.size(); ++node) {
            const auto isZero = [&](const Weights& w) { return w[node] == glm::vec3(0); };
            if (std::ranges::all_of(weights.linked, isZero) &&
                std::ranges::all_of(weights.linkedEmitted, isZero))
                continue;
            std::map<std::uint32_t, LinkPart> parts;
            forEachLeaf(node, [&](std::uint32_t leaf, float share) {
                if (leaf >= tree.surfels)
                    return;
                LinkPart& part = parts[state.bake.surfels.instance[leaf]];
                glm::vec3 value =
                    share * weights.value(weights.linked, node, state.radiosity[leaf]);
                if (!state.emitted.empty())
                    value +=
                        share * weights.value(weights.linkedEmitted, node, state.emitted[leaf]);
                part.value += value;
                part.surfels.emplace_back(leaf, value);
            });
            for (auto& [object, part] : parts) {
                part.node = node;
                linksOf[object].push_back(std::move(part));
            }
        }
    }

    static LightRow surfelRow(std::uint32_t surfel, glm::vec3 value, std::uint32_t parent) {
        return {.kind = LightRowKind::Surfel,
                .label = fmt::format("Surfel {}", surfel),
                .index = surfel,
                .parent = parent,
                .value = value};
    }

    void addLinks(std::vector<LinkPart>& links, std::uint32_t parent) {
        std::ranges::stable_sort(links, isStronger, &LinkPart::value);
        std::vector<LightRow> found;
        for (const LinkPart& link : links)
            found.push_back(
                link.surfels.size() == 1
                    ? surfelRow(link.surfels[0].first, link.value, parent)
                    : LightRow{.kind = LightRowKind::Cluster,
                               .label = fmt::format("Cluster of {} surfels", link.surfels.size()),
                               .index = link.node,
                               .parent = parent,
                               .value = link.value});
        const std::vector<LightRow> listed = strongest(std::move(found), maxRows);
        for (std::size_t k = 0; k < listed.size(); ++k) {
            const std::uint32_t clusterRow = addRow(rows, listed[k]);
            if (listed[k].kind != LightRowKind::Cluster)
                continue;
            std::vector<LightRow> surfels;
            for (const auto& [surfel, value] : links[k].surfels)
                surfels.push_back(surfelRow(surfel, value, clusterRow));
            for (LightRow& row : strongest(std::move(surfels), maxRows))
                addRow(rows, std::move(row));
        }
    }

    void addObjects() {
        findLinks();
        std::vector<LightRow> objects;
        for (const auto& [object, links] : linksOf) {
            LightRow row{.kind = LightRowKind::Surface,
                         .label = objectLabel(scene, object),
                         .index = object};
            for (const LinkPart& link : links)
                row.value += link.value;
            objects.push_back(std::move(row));
        }
        for (LightRow& row : strongest(std::move(objects), maxRows)) {
            const std::uint32_t object = row.index;
            const bool listed = row.kind == LightRowKind::Surface;
            const std::uint32_t objectRow = addRow(rows, std::move(row));
            if (listed)
                addLinks(linksOf[object], objectRow);
        }
    }

    void addSky() {
        const ClusterTree& tree = state.bake.tree;
        LightRow sky{.kind = LightRowKind::Sky, .label = "Sky"};
        std::vector<LightRow> cells;
        for (std::uint32_t n = tree.surfels; n < tree.leaves(); ++n) {
            const glm::vec3 value = weights.value(weights.direct, n, state.radiosity[n]) +
                                    weights.value(weights.directEmitted, n, state.radiosity[n]);
            if (value == glm::vec3(0))
                continue;
            const glm::vec3 d = tree.skyDirection[n - tree.surfels];
            cells.push_back(
                {.kind = LightRowKind::SkyCell,
                 .label = fmt::format("{:.0f}\u00b0 up, {:.0f}\u00b0 around",
                                      glm::degrees(std::asin(std::clamp(d.y, -1.f, 1.f))),
                                      glm::degrees(std::atan2(d.x, -d.z))),
                 .index = n - tree.surfels,
                 .parent = std::uint32_t(rows.size()),
                 .value = value});
            sky.value += value;
        }
        if (cells.empty())
            return;
        addRow(rows, std::move(sky));
        for (LightRow& row : strongest(std::move(cells), maxRows))
            addRow(rows, std::move(row));
    }
};

/// Per surfel, whether its instance is one of `instances`; empty where none is.
std::vector<std::uint8_t> surfelsOf(const Surfels& surfels,
                                    const std::vector<std::uint32_t>& instances) {
    std::vector<std::uint8_t> found;
    if (!instances.empty())
        for (const std::uint32_t instance : surfels.instance)
            found.push_back(std::ranges::count(instances, instance) > 0 ? 1 : 0);
    return found;
}

} // namespace

Explanation explainIlluminance(const Relighter& relighter, const Scene& scene,
                               const FieldReading& reading, const ExplainOptions& options) {
    const RelightState state = relighter.state();
    const std::vector<std::uint8_t> black = surfelsOf(state.bake.surfels, options.black);
    const ReadingWeights weights = weigh(state, reading, options.tolerance, black);
    OriginTable origins{state, scene, weights, black};
    origins.addLights();
    origins.addSky();
    origins.addEmitters();
    origins.addRemainder();
    SenderTable senders{state, scene, weights, options.rows};
    if (black.empty()) {
        senders.addObjects();
        senders.addSky();
    }
    return {std::move(origins.rows), std::move(senders.rows), weights.bounces};
}

} // namespace limn
