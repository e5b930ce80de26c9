// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/precomputed.h"
#include "engine/techniques/sparse_probes/sparse_bake.h"

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

private:
    std::shared_ptr<const SparseBake> m_bake;
};

} // namespace limn
