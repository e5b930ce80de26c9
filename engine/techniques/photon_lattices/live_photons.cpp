// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/live_photons.h"

#include "engine/core/stopwatch.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/photon_lattices/explain_photons.h"
#include "engine/techniques/photon_lattices/photon_overlay.h"
#include "engine/techniques/photon_lattices/photon_report.h"

#include <algorithm>
#include <utility>

namespace limn {

/// Whether the photons at rest of these inputs serve others, too: a change of colours, or of how
/// photons are summed, traces none.
static bool samePaths(const PhotonInputs& a, const PhotonInputs& b) {
    PathSettings paths = a.settings.paths;
    paths.photons = b.settings.paths.photons;
    return a.surfaces == b.surfaces && paths == b.settings.paths &&
           a.settings.still == b.settings.still &&
           std::ranges::all_of(b.sources, [&](const ShiningSource& source) {
               return std::ranges::find(a.sources, source.source, &ShiningSource::source) !=
                      a.sources.end();
           });
}

LightingReport LivePhotons::update(const Scene& scene, const Trace& trace,
                                   const Progress& progress) {
    Stopwatch whole;
    PhotonInputs now = photonInputsOf(scene);
    const std::uint32_t still = now.settings.still;
    const bool same = m_inputs == now;
    LightingReport report{.converged = true};
    report.skipped = same && (m_rested || still == 0);
    PhotonCost cost;
    double fieldMs = 0;
    if (!report.skipped) {
        // The first light, and that of a scene at rest, may take longer.
        m_rested = still > 0 && (same || !m_everLit || (m_rested && samePaths(m_lit, now)));
        m_inputs.reset(); // a cancelled update starts anew
        m_lit = now;
        if (m_rested)
            m_lit.settings.paths.photons = still;
        if (relight(scene, trace, progress, cost, fieldMs)) {
            m_inputs = std::move(now);
            m_everLit = true;
            report.converged = m_rested || still == 0;
            // What few photons bring is replaced, whatever number of bounces would suffice.
            report.bounces = report.converged ? m_lit.settings.paths.bounces : 0;
        } else {
            report.converged = report.whole = false;
        }
    }
    describePhotons(m_store, m_lit, m_field, {cost, fieldMs}, report);
    report.lacks =
        sourcesLeftOut(scene, {.emitters = m_lit.settings.emitters, .sky = m_lit.settings.sky});
    report.totalMs = whole.lap();
    return report;
}

std::shared_ptr<const LightSnapshot> LivePhotons::snapshot() const {
    return m_inputs ? std::make_shared<const PhotonSnapshot>(litPhotons(m_store, m_lit, m_field))
                    : nullptr;
}

Explanation LivePhotons::explain(const Scene& scene, const FieldReading& reading,
                                 const ExplainOptions& options) const {
    return m_inputs ? explainPhotons(scene, m_store, m_lit, m_field, reading, options)
                    : Explanation{};
}

/// False if cancelled; the field then stays as it was.
bool LivePhotons::relight(const Scene& scene, const Trace& trace, const Progress& progress,
                          PhotonCost& cost, double& fieldMs) {
    const auto traceSource = [&](const PhotonSource& source, const Progress& reported) {
        return trace(source, m_lit.settings.paths, reported);
    };
    if (!m_store.follow(scene, m_lit, traceSource, progress, cost))
        return false;
    Stopwatch clock;
    m_field.parts = photonParts(m_store, m_lit);
    ++m_field.version;
    fieldMs = clock.lap();
    return true;
}

} // namespace limn
