// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_bakes.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/stopwatch.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/techniques/illuminance/relight/source_solver.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

struct EditsBench {
    BenchBakes bakes;
    std::string output;
    std::vector<std::string> edits = {"move", "color"};
    std::vector<double> by = {0.5, 0, 0}; ///< way of the light in all frames [m]
    std::uint32_t bounces = 2;            ///< of a frame
    int frames = 100;
    bool json = false;
};

/// The first light of the scene during an edit, at `share` of it in [0, 1].
Light editedLight(const EditsBench& o, const std::string& edit, Light light, float share) {
    if (edit == "move") {
        const glm::vec3 by(o.by[0], o.by[1], o.by[2]);
        light.position += share * by;
        if (light.kind == LightKind::Directional)
            light.direction = glm::normalize(light.direction + share * by);
        return light;
    }
    const float angle = 2 * std::numbers::pi_v<float> * share;
    for (int k = 0; k < 3; ++k)
        light.color[k] *= 0.6f + 0.4f * std::cos(angle + 2 * float(k));
    light.strength *= 1.5f + std::sin(angle);
    return light;
}

/// Of the lightmaps.
double nrmseOf(const IndirectField& field, const IndirectField& right) {
    FieldDifference sum;
    for (std::size_t i = 0; i < right.lightmap.size(); ++i)
        sum.add(field.lightmap[i], right.lightmap[i]);
    return sum.nrmse();
}

struct MeasuredEdit {
    std::vector<double> ms, nrmse; ///< per frame
    double solveMs = 0;            ///< for all sources, while idle
    RelightStats last;
};

/// Edits the light frame by frame as somebody drags it, and compares the light after each frame
/// with the converged light of a second relighter.
MeasuredEdit measureEdit(const EditsBench& o, const std::string& edit, const BenchBake& baked) {
    MeasuredEdit measured;
    Relighter relighter(baked.bake), right(baked.bake);
    SourceSolver solver(baked.bake);
    Scene scene = baked.scene;
    const Light before = scene.lights.front();
    const auto converge = [&](Relighter& r) {
        r.relight(scene, baked.trace, scene.relight.maxBounces);
    };
    converge(relighter);
    Stopwatch timer;
    while (solver.solve(relighter, scene, baked.trace, false, {}))
        continue;
    measured.solveMs = timer.lap();
    for (int k = 1; k <= o.frames; ++k) {
        scene.lights.front() = editedLight(o, edit, before, float(k) / float(o.frames));
        timer.lap();
        measured.last = relighter.relight(scene, baked.trace, o.bounces);
        measured.ms.push_back(timer.lap());
        converge(right);
        measured.nrmse.push_back(nrmseOf(relighter.field(), right.field()));
    }
    return measured;
}

constexpr Column kEditColumns[] = {{"scene", -14, "name"},
                                   {"edit", -6, "edit"},
                                   {"frames", 6, "frames"},
                                   {"surfels", 7, "surfels"},
                                   {"links", 5, "links"},
                                   {"bands", 5, "bands"},
                                   {"kind", -4, "storage"},
                                   {"median [ms]", 11, "median_ms"},
                                   {"p95", 7, "p95_ms"},
                                   {"nrmse", 8, "nrmse_median", 5},
                                   {"p95", 8, "nrmse_p95", 5},
                                   {"sources", 7, "sources_kept"},
                                   {"solved [ms]", 11, "solve_ms", 0},
                                   {"light [MiB]", 11, "light_bytes", 2, kMiB}};

Json describe(const EditsBench& o, const std::string& edit, const BenchBake& baked,
              const MeasuredEdit& measured) {
    Json row = {{"name", baked.name}, {"edit", edit}, {"frames", o.frames}};
    row.update(settingsOf(baked));
    row["bounces"] = o.bounces;
    addSpread(row, "", measured.ms);
    const Spread error = spreadOf(measured.nrmse);
    row["nrmse_median"] = error.median;
    row["nrmse_p95"] = error.p95;
    row["nrmse_max"] = *std::ranges::max_element(measured.nrmse);
    row["summed"] = measured.last.summed;
    row["sources_kept"] = measured.last.sourcesKept;
    row["solve_ms"] = measured.solveMs;
    row["light_bytes"] = measured.last.bytes;
    return row;
}

Exit runEditsBench(const EditsBench& o) {
    if (!o.json)
        printTitles(kEditColumns);
    Json rows = Json::array();
    const Result<void> done = forEachBake(o.bakes, [&](const BenchBake& baked) -> Result<void> {
        if (baked.scene.lights.empty())
            return fail("it has no light to edit; --light adds one");
        for (const std::string& edit : o.edits) {
            rows.push_back(describe(o, edit, baked, measureEdit(o, edit, baked)));
            if (!o.json)
                printRow(kEditColumns, rows.back());
        }
        return {};
    });
    if (!done)
        return failed(done.error().message);
    return writeRows(rows, o.output, "edits", o.json);
}

} // namespace

void addEditsBench(Command& bench) {
    const auto o = std::make_shared<EditsBench>();
    Command command = bench.addCommand(
        "edits", "Time and error of each frame while somebody drags a light or its colour");
    addBenchBakes(command, o->bakes);
    command.option("-o,--output", o->output, "Folder for edits.csv and edits.json").required();
    command
        .option("--edits", o->edits,
                "What is done to the first light, a list: move, or color, which changes its "
                "strength, too")
        .list()
        .oneOf({"move", "color"});
    command
        .option("--by", o->by,
                "Way of the light in all frames, x,y,z [m]; added to the direction of a sun")
        .list(3);
    command.option("--frames", o->frames, "Number of frames").within(1, 100000);
    command.option("--bounces", o->bounces, "Bounces per frame").within(1, 64);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runEditsBench(*o); });
}

} // namespace limn
