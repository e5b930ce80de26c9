// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/light_skin.h"

#include "engine/core/stopwatch.h"
#include "engine/lighting/relight.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/light_skin/explain_skin.h"
#include "engine/techniques/light_skin/skin_overlay.h"
#include "engine/techniques/light_skin/skin_part.h"
#include "engine/techniques/light_skin/skin_report.h"
#include "engine/techniques/light_skin/skin_state.h"

#include <memory>
#include <optional>
#include <utility>

namespace limn {

namespace {

class SkinLighting : public Lighting {
public:
    SkinLighting() { m_field.bands = 2; }

    LightingReport update(const LightingInput& input, const Progress& progress) override {
        Stopwatch whole;
        SkinCost cost;
        double fieldMs = 0;
        const auto trace = [&]() -> const TraceScene& { return *input.trace; };
        LightingReport report =
            relightUnlessSame(skinInputsOf(input.scene, input.view), m_inputs, m_state.isRenewing(),
                              [&](const SkinInputs& now) {
                                  if (!m_state.follow(input.scene, now, trace, progress, cost))
                                      return Relit::Cancelled;
                                  fieldMs = writeField(now);
                                  return m_state.isRenewing() ? Relit::InPart : Relit::Whole;
                              });
        describeSkin(m_state.objects(), m_state.bytes(), cost, report);
        report.steps.push_back(
            {"field", "Field", "Flux of the proxy lights in the lights' colours", fieldMs});
        report.lacks = sourcesLeftOut(input.scene, {});
        report.totalMs = whole.lap();
        return report;
    }

    const IndirectField* field() const override { return &m_field; }
    bool isOfView() const override { return true; }

    std::shared_ptr<const LightSnapshot> snapshot() const override {
        if (!m_inputs)
            return nullptr;
        return std::make_shared<const SkinSnapshot>(litSkinOf(m_state, *m_inputs));
    }

    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override {
        if (!m_inputs)
            return {};
        return explainSkin(m_state, *m_inputs, scene, reading, options);
    }

private:
    /// Returns the milliseconds that it took.
    double writeField(const SkinInputs& now) {
        Stopwatch clock;
        const SkinObjects& objects = m_state.objects();
        SkinPart::Light light{
            objects.caches(), objects.proxies(), objects.fluxes(m_state.gathered(now.sources)), {}};
        if (const glm::vec3* eye = now.eye())
            light.eye = *eye;
        m_field.parts = {std::make_shared<const SkinPart>(std::move(light))};
        ++m_field.version;
        return clock.lap();
    }

    IndirectField m_field;
    std::optional<SkinInputs> m_inputs; ///< of the field; none before the first update
    SkinState m_state;
};

} // namespace

constinit const Technique kLightSkinTechnique = {
    .name = "light-skin",
    .label = "LightSkin",
    .summary = "One bounce of lights, gathered at caches on the objects into proxy lights. Needs "
               "no bake. Sky and emissive surfaces give no light",
    .source = "Bischoff, Schwandt, Broll. A Real-Time Global Illumination Approach for High "
              "Resolution Reflective Shadow Maps in Open World Scenes. 2017",
    .settings = kSkinSettings,
    .overlays = kSkinOverlays,
    .precomputation = nullptr,
    .light = [](const Prepared&) {
        return std::unique_ptr<Lighting>(std::make_unique<SkinLighting>());
    }};

} // namespace limn
