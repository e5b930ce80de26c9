// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/lpv.h"

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/lighting/relight.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/lpv/lattice_sources.h"
#include "engine/techniques/lpv/lpv_overlay.h"
#include "engine/techniques/lpv/propagation.h"

#include <array>
#include <optional>
#include <utility>

namespace limn {

namespace {

class LpvLighting : public Lighting {
public:
    LpvLighting() { m_field.bands = 2; }

    LightingReport update(const LightingInput& input, const Progress& progress) override {
        Stopwatch whole;
        Cost cost;
        LightingReport report =
            relightUnlessSame(lpvInputsOf(input.scene), m_inputs, false, [&](const LpvInputs& now) {
                return relight(input, now, progress, cost) ? Relit::Whole : Relit::Cancelled;
            });
        describe(cost, report);
        report.lacks = sourcesLeftOut(input.scene, {.emitters = true});
        report.totalMs = whole.lap();
        return report;
    }

    const IndirectField* field() const override { return &m_field; }

    std::shared_ptr<const LightSnapshot> snapshot() const override {
        if (!m_inputs)
            return nullptr;
        LitLattice lit = m_sources.lit(m_inputs->sources, m_inputs->settings.rounds);
        const std::size_t count = lit.lattice.cells();
        lit.sum.resize(count);
        for (std::size_t c = 0; c < count; ++c)
            for (std::size_t i = 0; i < lit.sum[c].size(); ++i)
                lit.sum[c][i] = glm::vec3(m_field.grid[i * count + c]) / m_factors[i > 0];
        return std::make_shared<const LpvSnapshot>(std::move(lit));
    }

    /// Each light's row is what that light gives alone. Cells whose lobes point away from each
    /// other lose less to the clamp together, so the sum of these may differ from the light of all.
    Explanation explain(const Scene& scene, const FieldReading& reading,
                        const ExplainOptions& options) const override {
        Explanation e;
        if (!m_inputs)
            return e;
        const Lattice& lattice = m_sources.lattice();
        IndirectField alone = m_field;
        const auto valueAlone = [&](const CellLight& cells) {
            writeField(propagate(cells, &m_sources.blockers(), m_inputs->settings.rounds), alone);
            return valueOf(reading, alone);
        };
        CellLight together(lattice.size);
        addInjected(m_sources.emitters(), glm::vec3(1), lattice, {}, together);
        if (!m_sources.emitters().empty())
            addRow(e.byOrigin, {.kind = LightRowKind::Others,
                                .label = "Emissive surfaces",
                                .value = valueAlone(together)});
        for (const RsmSource& source : m_inputs->sources) {
            CellLight cells(lattice.size);
            for (CellLight* sum : {&cells, &together})
                addInjected(m_sources.injectionOf(source.shape)->parts, source.colour, lattice,
                            options.black, *sum);
            addRow(e.byOrigin, {.kind = LightRowKind::Light,
                                .label = scene.lights[source.index].name,
                                .index = source.index,
                                .value = valueAlone(cells)});
        }
        const glm::vec3 all = valueAlone(together);
        if (e.byOrigin.size() > 1)
            addRow(e.byOrigin, {.kind = LightRowKind::Remainder,
                                .label = "Lights together, beyond each alone",
                                .value = all - totalOf(e.byOrigin)});
        if (options.black.empty())
            addRow(e.bySender, {.kind = LightRowKind::Others,
                                .label = "All surfaces (cells do not tell them apart)",
                                .value = all});
        e.bounces = 1;
        return e;
    }

private:
    struct Cost : LpvSourceCost {
        double propagationMs = 0, fieldMs = 0;
        std::uint64_t rounds = 0;
    };

    /// False if cancelled.
    bool relight(const LightingInput& input, const LpvInputs& now, const Progress& progress,
                 Cost& cost) {
        const auto trace = [&]() -> const TraceScene& { return *input.trace; };
        m_sources.followSurfaces(input.scene, now, cost);
        if (!m_sources.followLights(input.scene, now, trace, progress, cost))
            return false;
        Stopwatch clock;
        const Lattice& lattice = m_sources.lattice();
        const bool dark = now.sources.empty() && m_sources.emitters().empty();
        cost.rounds = dark ? 0 : now.settings.rounds;
        const CellLight sum = propagate(m_sources.injected(now.sources), &m_sources.blockers(),
                                        std::uint32_t(cost.rounds), progress);
        if (progress.cancelled())
            return false;
        cost.propagationMs = clock.lap();
        m_field.gridSize = lattice.size;
        m_field.gridBounds = lattice.bounds();
        m_factors = fieldFactors(now.settings.fluxLookup, lattice.cell);
        writeField(sum, m_field);
        ++m_field.version;
        cost.fieldMs = clock.lap();
        return true;
    }

    void writeField(const CellLight& sum, IndirectField& field) const {
        const glm::uvec3 size = m_sources.lattice().size;
        const std::size_t count = m_sources.lattice().cells();
        field.grid.resize(4 * count);
        parallelRanges(std::size_t(size.y) * size.z, 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row)
                for (std::uint32_t x = 0; x < size.x; ++x) {
                    const Lobe lobe = sum.lobe({x, row % size.y, row / size.y});
                    for (std::size_t i = 0; i < lobe.size(); ++i)
                        field.grid[i * count + row * size.x + x] =
                            glm::vec4(lobe[i] * m_factors[i > 0], 0);
                }
        });
    }

    void describe(const Cost& cost, LightingReport& report) const {
        describeSources(m_sources, cost, cost.rounds, report);
        report.steps.push_back({"propagation", "Propagation",
                                "Light is summed in cells and moves from cell to cell",
                                cost.propagationMs});
        report.steps.push_back({"field", "Field", "What the viewport samples", cost.fieldMs});
        const std::size_t planes = 4 * 12; // three volumes of light and the blockers
        const std::size_t bytes =
            PaddedCells{m_sources.lattice().size}.count() * planes * sizeof(float) +
            m_field.grid.size() * sizeof(glm::vec4);
        report.counters.push_back(
            {"shadow_rays", "Shadow map rays", "Rays cast for shadow maps", double(cost.rays)});
        report.counters.push_back({"bytes", "Memory",
                                   "Volumes of light and blockers, and the field", double(bytes),
                                   CounterUnit::Bytes});
    }

    IndirectField m_field;
    std::array<float, 2> m_factors{};  ///< of the field's bands
    std::optional<LpvInputs> m_inputs; ///< of the field; none before the first update
    LatticeSources m_sources;
};

} // namespace

constinit const Technique kLpvTechnique = {
    .name = "lpv",
    .label = "Light propagation volumes",
    .summary = "One bounce of lights, carried from cell to cell of a lattice. Needs no bake. The "
               "sky gives no light, and that of emissive surfaces is not reflected",
    .source = "Kaplanyan, Dachsbacher. Cascaded Light Propagation Volumes for Real-Time Indirect "
              "Illumination. 2010",
    .settings = kLpvSettings,
    .overlays = kLpvOverlays,
    .precomputation = nullptr,
    .light = [](const Prepared&) {
        return std::unique_ptr<Lighting>(std::make_unique<LpvLighting>());
    }};

} // namespace limn
