// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/prepared_sparse.h"

#include "engine/techniques/sparse_probes/sparse_probes.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace limn {

const Technique& PreparedSparse::technique() const {
    return kSparseProbesTechnique;
}

PrecomputedReport PreparedSparse::report() const {
    const SparseBake& b = *m_bake;
    const std::vector<float>& unseen = b.transport.unseen;
    const double share = std::accumulate(unseen.begin(), unseen.end(), 0.) /
                         double(std::max<std::size_t>(unseen.size(), 1));
    std::vector<LightingCounter> bytes = sparseBytes(b.receivers.size(), b.sparse, b.probes.size());
    bytes.back().value = transportBytes(b);
    return {.counts = {{"triangles", "Triangles", "Of the scene", double(b.triangles)},
                       {"caches", "Receivers", "Lightmap texels", double(b.receivers.size())},
                       {"probes", "Probes", "In the open air", double(b.probes.size())},
                       {"unseen", "Unseen",
                        "Share of the receivers' views that none of their probes sees", share,
                        CounterUnit::Share},
                       {"rays", "Rays", "Traced by the last bake", double(b.rays)}},
            .bytes = std::move(bytes),
            .seconds = b.seconds,
            .keptStages = b.keptStages,
            .notes = {}};
}

// The power of four that the bytes of the transport reach.
std::string PreparedSparse::sizeClass() const {
    return fmt::format("transport 4^{}",
                       std::bit_width(std::uint64_t(transportBytes(*m_bake))) / 2);
}

// Charts and updates take time in proportion to the texels, transport to texels and rays.
PrecomputedCost PreparedSparse::expectedCost(const Scene& scene, const BakeSettings& wanted,
                                             const PrecomputedCost& measured) const {
    const BakeSettings& made = m_bake->settings;
    if (wanted == made)
        return measured; // without the rounding of what follows
    Scene with = scene;
    with.bake = made;
    const double before = wantedTexels(with);
    with.bake = wanted;
    const double texels = wantedTexels(with) / std::max(before, 1.),
                 rays = double(wanted.rays) / double(made.rays);
    PrecomputedCost cost = measured;
    for (auto& [stage, seconds] : cost.seconds)
        seconds *= stage == "transport" ? texels * rays : stage == "charts" ? texels : 1;
    cost.updateMs = 0;
    for (LightingStep& step : cost.update)
        cost.updateMs += step.ms *= std::string_view(step.id) == "sparse_probes" ? 1 : texels;
    cost.bytes *= texels;
    return cost;
}

OverlayData PreparedSparse::overlay(const OverlayRequest& request, const Scene& scene,
                                    const LightSnapshot* light) const {
    const auto* snapshot = static_cast<const SparseSnapshot*>(light);
    const bool fits =
        snapshot && snapshot->probes().size() == m_bake->probes.size() * 3 * m_bake->coefficients();
    return sparseOverlay(*m_bake, request, scene, fits ? &snapshot->probes() : nullptr);
}

std::optional<std::uint32_t> PreparedSparse::pickAt(const Scene& scene, const Hit& hit) const {
    if (hit.instance >= std::min(scene.instances.size(), m_bake->lightmap.instances.size()))
        return {};
    const std::uint32_t receiver = ReceiverAt(m_bake->lightmap, m_bake->receivers)(scene, hit);
    return receiver == ReceiverAt::kNone ? std::nullopt : std::optional(receiver);
}

std::optional<std::uint32_t> PreparedSparse::nearestPick(const OverlaySource& other,
                                                         std::uint32_t pick) const {
    return nearestReceiver(*m_bake, *static_cast<const PreparedSparse&>(other).m_bake, pick);
}

} // namespace limn
