// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"
#include "engine/techniques/illuminance/relight/left_out_space.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"
#include "engine/techniques/illuminance/relight/source_solver.h"

#include <memory>

namespace limn {

/// A bake lit on the CPU.
class CpuIlluminance : public Lighting {
public:
    /// `baked` is the scene that `bake` was made from.
    CpuIlluminance(std::shared_ptr<const Bake> bake, std::shared_ptr<const Scene> baked)
        : m_relighter(bake), m_solver(bake), m_bake(std::move(bake)), m_baked(std::move(baked)) {}

    /// input.trace is not null.
    LightingReport update(const LightingInput& input, const Progress& progress) override;

    bool solveSources(const LightingInput& input, const Progress& progress) override;
    const IndirectField* field() const override { return &m_relighter.field(); }
    std::shared_ptr<const IndirectField> emittedField(const Scene& scene) const override;
    std::shared_ptr<const LightSnapshot> snapshot() const override;
    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override;

private:
    Relighter m_relighter;
    SourceSolver m_solver;
    std::shared_ptr<const Bake> m_bake;
    std::shared_ptr<const Scene> m_baked;
    SeenFrom m_seen;
    LeftOutSpace m_leftOut;
};

} // namespace limn
