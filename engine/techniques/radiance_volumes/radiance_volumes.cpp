// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/radiance_volumes.h"

#include "engine/core/stopwatch.h"
#include "engine/lighting/relight.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/radiance_volumes/lit_volume.h"
#include "engine/techniques/radiance_volumes/volume_overlay.h"
#include "engine/techniques/radiance_volumes/volume_report.h"
#include "engine/techniques/radiance_volumes/volume_sources.h"

#include <optional>
#include <utility>

namespace limn {

namespace {

class VolumeLighting : public Lighting {
public:
    VolumeLighting() { m_field.bands = 2; }

    LightingReport update(const LightingInput& input, const Progress& progress) override {
        Stopwatch whole;
        VolumeCost cost;
        LightingReport report =
            relightUnlessSame(volumeInputsOf(input, m_sources.inputs()), m_inputs,
                              m_sources.fading(), [&](const VolumeInputs& now) {
                                  if (!relight(input, now, progress, cost))
                                      return Relit::Cancelled;
                                  return m_sources.fading() ? Relit::InPart : Relit::Whole;
                              });
        describeVolume(m_lit, cost, report);
        report.lacks = sourcesLeftOut(input.scene, {});
        report.totalMs = whole.lap();
        return report;
    }

    const IndirectField* field() const override { return &m_field; }
    bool isOfView() const override { return true; }

    std::shared_ptr<const LightSnapshot> snapshot() const override {
        return m_inputs ? std::make_shared<const VolumeSnapshot>(m_lit) : nullptr;
    }

    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override {
        return m_inputs ? explainVolume(m_lit, scene, reading, options) : Explanation();
    }

private:
    /// False if cancelled.
    bool relight(const LightingInput& input, const VolumeInputs& now, const Progress& progress,
                 VolumeCost& cost) {
        if (!m_sources.follow(*input.trace, input.scene, now, progress, cost))
            return false;
        Stopwatch clock;
        const VolumeSettings& settings = now.settings;
        LitVolume lit{.settings = settings,
                      .voxels = m_sources.sharedVoxels(),
                      .sources = now.sources,
                      .lights = m_sources.areaLights(now.sources)};
        auto part = std::make_shared<VolumePart>();
        part->caches = m_sources.sharedCaches();
        part->bands = settings.bands;
        part->clamped = settings.clamp;
        if (settings.glossy && now.view) {
            part->glossy = GlossyMapShape{settings.tile, settings.fill, settings.microfacet};
            part->eye = now.view->camera.eye;
        }
        lit.part = part;
        const std::vector<LitAreaLights> coloured = lit.coloured();
        part->light = lightCaches(part->caches->places, lit.input(coloured), progress);
        if (progress.cancelled())
            return false;
        cost.cones = part->light.cones;
        cost.lightMs = clock.lap();
        m_lit = std::move(lit);
        m_field.bands = settings.bands;
        m_field.parts = {m_lit.part};
        ++m_field.version;
        return true;
    }

    VolumeSources m_sources;
    LitVolume m_lit;
    IndirectField m_field;
    std::optional<VolumeInputs> m_inputs; ///< of the field; none before the first update
};

} // namespace

constinit const Technique kRadianceVolumesTechnique = {
    .name = "radiance-volumes",
    .label = "Dynamic radiance volumes",
    .summary = "One bounce of lights, gathered by caches around what the view shows, with shadows "
               "from cones through voxels. Needs no bake. Sky and emissive surfaces give no light",
    .source = "Reich. Realtime Global Illumination using Dynamic Radiance Volumes. 2015",
    .settings = kVolumeSettings,
    .overlays = kVolumeOverlays,
    .precomputation = nullptr,
    .light = [](const Prepared&) {
        return std::unique_ptr<Lighting>(std::make_unique<VolumeLighting>());
    }};

} // namespace limn
