// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/convergence.h"
#include "engine/lighting/direct_irradiance.h"
#include "engine/lighting/lighting.h"
#include "engine/techniques/sparse_probes/receiver_light.h"
#include "engine/techniques/sparse_probes/sparse_gather.h"

#include <memory>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A SparseBake lit on the CPU. Each round lights the receivers, from them the probes, and from
/// these the receivers again: one more bounce.
class SparseLighting : public Lighting {
public:
    /// `scene` is the one that `bake` was made from.
    SparseLighting(std::shared_ptr<const SparseBake> bake, const Scene& scene);

    /// input.trace is not null.
    LightingReport update(const LightingInput& input, const Progress& progress) override;
    const IndirectField* field() const override { return &m_field; }
    std::shared_ptr<const LightSnapshot> snapshot() const override;
    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override;

private:
    /// Durations of an update's steps [ms].
    struct Times {
        double direct = 0, radiosity = 0, probes = 0, receivers = 0, field = 0;
    };

    void followScene(const LightingInput& input);
    RoundChange lightReceivers();
    void writeField(bool grid);
    LightingReport report(const Times& times, std::uint32_t bounces, bool skipped) const;

    std::shared_ptr<const SparseBake> m_bake;
    ReceiverPoints m_points;
    ReceiverAreas m_areas;
    std::vector<glm::vec3> m_directions;
    std::vector<float> m_basis;

    DirectIrradiance m_direct;
    ReceiverMaterials m_materials;
    Sky m_sky;
    ProbeRadiance m_skyAtProbes, m_probes;
    std::vector<glm::vec3> m_irradiance; ///< bounced, per receiver [W m^-2]
    std::vector<glm::vec3> m_radiance;   ///< that receivers send [W m^-2 sr^-1]
    Convergence m_convergence;
    bool m_started = false, m_clampParts = false;
    IndirectField m_field;
};

} // namespace limn
