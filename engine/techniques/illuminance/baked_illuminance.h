// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/precomputed.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <memory>

namespace limn {

/// A bake as the rest of the program knows it.
class BakedIlluminance : public Precomputed {
public:
    /// `bake` is not null.
    explicit BakedIlluminance(std::shared_ptr<const Bake> bake) : m_bake(std::move(bake)) {}

    const std::shared_ptr<const Bake>& bake() const { return m_bake; }

    const Technique& technique() const override;
    const BakeSettings& settings() const override { return m_bake->settings; }
    std::uint64_t inputHash() const override { return m_bake->sceneHash; }
    std::uint64_t hash() const override { return m_bake->hash(); }
    const LightmapLayout& layout() const override { return m_bake->lightmap; }
    glm::uvec3 gridSize() const override;
    PrecomputedReport report() const override;
    std::string sizeClass() const override;
    PrecomputedCost expectedCost(const Scene& scene, const BakeSettings& wanted,
                                 const PrecomputedCost& measured) const override;
    std::string defect(const Scene& scene) const override;
    Result<void> write(const std::string& path) const override;

    OverlayData overlay(const OverlayRequest& request, const Scene& scene,
                        const LightSnapshot* light) const override;
    std::uint32_t maxOverlayDepth() const override;
    std::uint32_t pickCount() const override { return std::uint32_t(m_bake->caches.size()); }
    std::optional<std::uint32_t> pickAt(const Scene& scene, const Hit& hit) const override;
    std::optional<std::uint32_t> nearestPick(const OverlaySource& other,
                                             std::uint32_t pick) const override;
    std::vector<OverlayLine> describePick(const Scene& scene, std::uint32_t pick) const override;
    std::vector<OverlayLine> describeAt(const OverlayRequest& request, const Scene& scene,
                                        const Hit& hit, const LightSnapshot* light) const override;

private:
    std::shared_ptr<const Bake> m_bake;
};

/// The bake in precomputed data of kIlluminanceTechnique.
const std::shared_ptr<const Bake>& bakeOf(const Precomputed& data);

/// predictBake() in the form that every technique reports.
Prediction predictIlluminance(const Scene& scene, bool stored);

/// Settings of a preview bake: few rays, links and surfels, and the same texels.
BakeSettings previewSettings(BakeSettings settings);

} // namespace limn
