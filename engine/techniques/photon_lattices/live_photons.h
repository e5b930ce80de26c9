// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/field/field_reading.h"
#include "engine/field/indirect_field.h"
#include "engine/lighting/explanation.h"
#include "engine/lighting/light_snapshot.h"
#include "engine/lighting/lighting_report.h"
#include "engine/techniques/photon_lattices/photon_light.h"

#include <memory>
#include <optional>

namespace limn {

/// Light of photons, kept from one update to the next, wherever their first bounces are made.
class LivePhotons {
public:
    /// As Lighting::update(). `trace` is called only for sources that are out of date, with the
    /// settings of paths that hold now.
    using Trace = std::function<PhotonMap(const PhotonSource& source, const PathSettings& settings,
                                          const Progress& progress)>;
    LightingReport update(const Scene& scene, const Trace& trace, const Progress& progress);

    /// Of parts alone; IndirectField::version tells when they change.
    const IndirectField& field() const { return m_field; }
    std::shared_ptr<const LightSnapshot> snapshot() const;
    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const;

private:
    bool relight(const Scene& scene, const Trace& trace, const Progress& progress, PhotonCost& cost,
                 double& fieldMs);

    IndirectField m_field;
    std::optional<PhotonInputs> m_inputs; ///< of the field; none before the first update
    PhotonInputs m_lit;                   ///< the same with the number of photons that was traced
    bool m_rested = false;                ///< whether that is the number of photons at rest
    bool m_everLit = false;
    PhotonStore m_store;
};

} // namespace limn
