// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_lattices.h"

#include "engine/core/stopwatch.h"
#include "engine/techniques/photon_lattices/explain_photons.h"
#include "engine/techniques/photon_lattices/photon_light.h"
#include "engine/techniques/photon_lattices/photon_overlay.h"
#include "engine/techniques/photon_lattices/photon_report.h"
#include "engine/techniques/photon_lattices/photon_sources.h"

#include <optional>
#include <utility>

namespace limn {

namespace {

class PhotonLighting : public Lighting {
public:
    LightingReport update(const LightingInput& input, const Progress& progress) override {
        Stopwatch whole;
        PhotonInputs now = photonInputsOf(input.scene);
        const std::uint32_t still = now.settings.still;
        const bool same = m_inputs == now;
        LightingReport report{.converged = true};
        report.skipped = same && (m_rested || still == 0);
        PhotonCost cost;
        double fieldMs = 0;
        if (!report.skipped) {
            // The first light, and that of a scene at rest, may take longer.
            m_rested = still > 0 && (same || !m_everLit);
            m_inputs.reset(); // a cancelled update starts anew
            m_lit = now;
            if (m_rested)
                m_lit.settings.paths.photons = still;
            if (relight(input, progress, cost, fieldMs)) {
                m_inputs = std::move(now);
                m_everLit = true;
                report.bounces = m_lit.settings.paths.bounces;
                report.converged = m_rested || still == 0;
            } else {
                report.converged = report.whole = false;
            }
        }
        describePhotons(m_store, m_lit, m_field, {cost, fieldMs}, report);
        report.totalMs = whole.lap();
        return report;
    }

    const IndirectField* field() const override { return &m_field; }

    std::shared_ptr<const LightSnapshot> snapshot() const override {
        return m_inputs
                   ? std::make_shared<const PhotonSnapshot>(litPhotons(m_store, m_lit, m_field))
                   : nullptr;
    }

    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override {
        return m_inputs ? explainPhotons(scene, m_store, m_lit, m_field, reading, options)
                        : Explanation{};
    }

private:
    /// False if cancelled; the field then stays as it was.
    bool relight(const LightingInput& input, const Progress& progress, PhotonCost& cost,
                 double& fieldMs) {
        const auto trace = [&](const PhotonSource& source, const Progress& reported) {
            return tracePhotons({*input.trace, input.scene, m_lit.settings.paths}, source,
                                reported);
        };
        if (!m_store.follow(input.scene, m_lit, trace, progress, cost))
            return false;
        Stopwatch clock;
        m_field.parts = photonParts(m_store, m_lit);
        ++m_field.version;
        fieldMs = clock.lap();
        return true;
    }

    IndirectField m_field;
    std::optional<PhotonInputs> m_inputs; ///< of the field; none before the first update
    PhotonInputs m_lit;                   ///< the same with the number of photons that was traced
    bool m_rested = false;                ///< whether that is the number of photons at rest
    bool m_everLit = false;
    PhotonStore m_store;
};

} // namespace

constinit const Technique kPhotonTechnique = {
    .name = "photon-lattices",
    .label = "Photon lattices",
    .summary = "Photons of lights and emissive surfaces, traced on the CPU and summed in lattices "
               "of three sizes, from soft light to caustics. Needs no bake",
    .source = "Norén, Sjölin. Image Space Light Lattice Photon Mapping with Spherical Harmonics. "
              "2010",
    .settings = kPhotonSettings,
    .overlays = kPhotonOverlays,
    .precomputation = nullptr,
    .light = [](const Prepared&) {
        return std::unique_ptr<Lighting>(std::make_unique<PhotonLighting>());
    }};

} // namespace limn
