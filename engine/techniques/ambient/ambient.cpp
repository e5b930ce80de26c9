// SPDX-License-Identifier: MIT
#include "engine/techniques/ambient/ambient.h"

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace limn {

namespace {

constexpr TechniqueSetting kConstant = {
    .setting = {.key = "ambient.constant",
                .label = "Constant light",
                .tooltip = "The radiance below lights everything, whatever the sky is. Off: the "
                           "sky's mean radiance does",
                .invalidates = Invalidates::Light},
    .range = {0, 1},
    .usual = 0,
    .whole = true};
constexpr TechniqueSetting kRadiance = {
    .setting = {.key = "ambient.radiance",
                .label = "Radiance (nits)",
                .tooltip = "What arrives from every direction where the light is constant [nits]",
                .invalidates = Invalidates::Light},
    .range = {0, 1e6},
    .usual = 1};
constexpr std::array kSettings = {kConstant, kRadiance};

/// The mean over all directions: the sky's cells have equal solid angles.
glm::vec3 meanRadiance(const Sky& sky) {
    glm::dvec3 sum(0);
    const std::vector<glm::vec3> cells = skyCellRadiance(sky);
    for (const glm::vec3 cell : cells)
        sum += glm::dvec3(cell);
    return glm::vec3(sum / double(cells.size()));
}

class AmbientLighting : public Lighting {
public:
    AmbientLighting() { m_field.gridSize = glm::uvec3(1); }

    LightingReport update(const LightingInput& input, const Progress&) override {
        const auto start = std::chrono::steady_clock::now();
        const Scene& scene = input.scene;
        LightingReport report;
        report.converged = true;
        Inputs inputs{scene.sky, scene.technique, scene.bounds};
        report.skipped = inputs == m_inputs;
        if (!report.skipped)
            fill(m_inputs.emplace(std::move(inputs)));
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        report.totalMs = took.count();
        report.steps = {{"ambient", "Ambient light", "The mean of the sky", report.totalMs}};
        return report;
    }

    const IndirectField* field() const override { return &m_field; }

    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions&) const override {
        const bool constant = settingOf(scene.technique, kConstant) > 0;
        const LightRow row{.kind = LightRowKind::Sky,
                           .label = constant ? kConstant.setting.label : "Sky",
                           .value = valueOf(reading, m_field)};
        return {.byOrigin = {row}, .bySender = {row}};
    }

private:
    /// Everything that the field depends on.
    struct Inputs {
        Sky sky;
        TechniqueChoice choice;
        Bounds bounds;
        bool operator==(const Inputs&) const = default;
    };

    /// Of a constant radiance L only the first harmonic is not 0: L times the integral of
    /// Y_00 = 1 / sqrt(4 pi) over the sphere.
    void fill(const Inputs& in) {
        const glm::vec3 radiance = settingOf(in.choice, kConstant) > 0
                                       ? glm::vec3(float(settingOf(in.choice, kRadiance)))
                                       : meanRadiance(in.sky);
        m_field.gridBounds = in.bounds;
        m_field.grid.assign(m_field.coefficients(), glm::vec4(0));
        m_field.grid[0] = glm::vec4(radiance * (2 * std::sqrt(std::numbers::pi_v<float>)), 0);
        ++m_field.version;
    }

    IndirectField m_field;
    std::optional<Inputs> m_inputs; ///< of the field; none before the first update
};

} // namespace

constinit const Technique kAmbientTechnique = {
    .name = "ambient",
    .label = "Ambient",
    .summary = "The sky's mean radiance, or a constant, from everywhere. Needs no bake",
    .source = "",
    .settings = kSettings,
    .overlays = {},
    .precomputation = nullptr,
    .light = [](const Prepared&) {
        return std::unique_ptr<Lighting>(std::make_unique<AmbientLighting>());
    }};

} // namespace limn
