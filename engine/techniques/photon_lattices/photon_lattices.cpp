// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_lattices.h"

#include "engine/techniques/photon_lattices/live_photons.h"
#include "engine/techniques/photon_lattices/photon_overlay.h"
#include "engine/techniques/photon_lattices/photon_sources.h"

#include <memory>

namespace limn {

namespace {

class PhotonLighting : public Lighting {
public:
    LightingReport update(const LightingInput& input, const Progress& progress) override {
        const auto trace = [&](const PhotonSource& source, const PathSettings& settings,
                               const Progress& reported) {
            return tracePhotons({*input.trace, input.scene, settings}, source, reported);
        };
        return m_live.update(input.scene, trace, progress);
    }

    const IndirectField* field() const override { return &m_live.field(); }
    std::shared_ptr<const LightSnapshot> snapshot() const override { return m_live.snapshot(); }
    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override {
        return m_live.explain(scene, reading, options);
    }

private:
    LivePhotons m_live;
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
