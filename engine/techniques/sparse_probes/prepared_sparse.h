// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/precomputed.h"
#include "engine/techniques/sparse_probes/sparse_bake.h"
#include "engine/techniques/sparse_probes/sparse_overlay.h"

#include <memory>
#include <utility>

namespace limn {

/// A SparseBake as the rest of the program knows it.
class PreparedSparse : public Precomputed {
public:
    /// `bake` is not null.
    explicit PreparedSparse(std::shared_ptr<const SparseBake> bake) : m_bake(std::move(bake)) {}

    const std::shared_ptr<const SparseBake>& bake() const { return m_bake; }

    const Technique& technique() const override;
    const BakeSettings& settings() const override { return m_bake->settings; }
    std::uint64_t inputHash() const override { return m_bake->sceneHash; }
    std::uint64_t hash() const override { return m_bake->hash(); }
    const LightmapLayout& layout() const override { return m_bake->lightmap; }
    glm::uvec3 gridSize() const override { return m_bake->gridSize; }
    PrecomputedReport report() const override;
    std::string sizeClass() const override;
    PrecomputedCost expectedCost(const Scene& scene, const BakeSettings& wanted,
                                 const PrecomputedCost& measured) const override;
    std::string defect(const Scene& scene) const override { return sparseDefect(*m_bake, &scene); }
    Result<void> write(const std::string& path) const override {
        return writeSparse(path, *m_bake);
    }

    OverlayData overlay(const OverlayRequest& request, const Scene& scene,
                        const LightSnapshot* light) const override;
    std::uint32_t pickCount() const override { return std::uint32_t(m_bake->receivers.size()); }
    std::optional<std::uint32_t> pickAt(const Scene& scene, const Hit& hit) const override;
    std::optional<std::uint32_t> nearestPick(const OverlaySource& other,
                                             std::uint32_t pick) const override;
    std::vector<OverlayLine> describePick(const Scene& scene, std::uint32_t pick) const override {
        return describeReceiver(*m_bake, scene, pick);
    }

private:
    std::shared_ptr<const SparseBake> m_bake;
};

} // namespace limn
