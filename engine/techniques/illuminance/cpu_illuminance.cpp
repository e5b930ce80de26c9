// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/cpu_illuminance.h"

#include "engine/techniques/illuminance/explain_illuminance.h"
#include "engine/techniques/illuminance/illuminance_snapshot.h"
#include "engine/techniques/illuminance/relight/emitted_field.h"
#include "engine/techniques/illuminance/relight/relight_report.h"

namespace limn {

LightingReport CpuIlluminance::update(const LightingInput& input, const Progress& progress) {
    const CacheFlags* seen =
        input.view ? &seenFrom(m_seen, *m_baked, *m_bake, *input.view) : nullptr;
    m_relighter.lightUnreadGrid(input.unread);
    LightingReport report =
        reportOf(m_relighter.relight(input.scene, *input.trace, input.bounces, progress, seen));
    report.lacks = m_leftOut.lackOf(*m_bake, *m_baked, input.scene);
    return report;
}

bool CpuIlluminance::solveSources(const LightingInput& input, const Progress& progress) {
    return m_solver.solve(m_relighter, input.scene, *input.trace, input.unread, progress);
}

std::shared_ptr<const IndirectField> CpuIlluminance::emittedField(const Scene& scene) const {
    return std::make_shared<const IndirectField>(limn::emittedField(m_bake, scene));
}

std::shared_ptr<const LightSnapshot> CpuIlluminance::snapshot() const {
    const Relighter& r = m_relighter;
    return std::make_shared<const IlluminanceSnapshot>(
        LitBake{r.radiosity(), r.cacheSh(), int(r.field().bands)});
}

Explanation CpuIlluminance::explain(const Scene& scene, const FieldReading& reading,
                                    const ExplainOptions& options) const {
    return explainIlluminance(m_relighter, scene, reading, options);
}

} // namespace limn
