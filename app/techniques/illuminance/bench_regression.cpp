// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/bench/regression_figures.h"
#include "app/commands/progress_line.h"
#include "app/techniques/illuminance/illuminance_program.h"
#include "app/techniques/illuminance/regression_scene.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace limn {

namespace {

struct RegressionBench {
    std::string output, figures; ///< empty: none
    bool update = false, json = false;
    int threads = 0; ///< 0: all
};

constexpr std::array<const char*, 5> kChangeNames = {"same", "better", "worse", "unmeasured",
                                                     "uncommitted"};

constexpr Column kRegressionColumns[] = {
    {"scene", -10, "scene"},  {"figure", -24, "name"},          {"[%]", 8, "value", 3},
    {"+-", 7, "noise", 3},    {"committed", 9, "committed", 3}, {"tolerance", 9, "tolerance", 3},
    {"change", -11, "change"}};

Json rowOf(const FigureVerdict& v) {
    const bool measured = v.change != FigureChange::Unmeasured,
               committed = v.change != FigureChange::Uncommitted;
    const RegressionFigure& named = measured ? v.measured : v.committed;
    return {{"scene", named.scene},
            {"name", named.name},
            {"unit", named.unit},
            {"value", measured ? Json(v.measured.value) : Json()},
            {"noise", measured ? Json(v.measured.noise) : Json()},
            {"committed", committed ? Json(v.committed.value) : Json()},
            {"tolerance", committed ? Json(toleranceOf(v.committed)) : Json()},
            {"change", kChangeNames[std::size_t(v.change)]}};
}

/// Says which figures changed. Returns a message about those that fail; empty: none does.
std::string judge(const RegressionBench& o, const std::vector<FigureVerdict>& verdicts) {
    std::string failures;
    bool better = false;
    for (const FigureVerdict& v : verdicts) {
        if (v.fails())
            failures += "\n  " + describe(v);
        else if (v.change == FigureChange::Better)
            fmt::print(stderr, "{}\n", describe(v));
        better |= v.change == FigureChange::Better;
    }
    const std::string update =
        fmt::format("limn bench regression --figures {} --update", o.figures);
    if (better)
        fmt::print(stderr, "Figures became better. Keep them so: run `{}` and commit the file.\n",
                   update);
    if (failures.empty())
        return {};
    return fmt::format("regression figures fail:{}\nWhere that is meant, run `{}` and say why in "
                       "the commit.",
                       failures, update);
}

Result<std::vector<RegressionFigure>> measureAll() {
    std::vector<RegressionFigure> all;
    for (const RegressionScene& scene : regressionScenes()) {
        const Result<std::vector<RegressionFigure>> figures =
            measureRegression(scene, progressOnStderr());
        endProgressLine();
        if (!figures)
            return tl::make_unexpected(figures.error());
        all.insert(all.end(), figures->begin(), figures->end());
    }
    return all;
}

Exit runRegressionBench(const RegressionBench& o) {
    const ThreadLimit threads(o.threads);
    std::vector<RegressionFigure> committed;
    if (!o.figures.empty() && !o.update) {
        Result<std::vector<RegressionFigure>> read = readFigures(o.figures);
        if (!read)
            return failed(read.error().message);
        committed = std::move(*read);
    }
    const Result<std::vector<RegressionFigure>> measured = measureAll();
    if (!measured)
        return failed(measured.error().message);
    if (o.update) {
        if (const Result<void> written = writeFigures(o.figures, *measured); !written)
            return failed(written.error().message);
        committed = *measured;
    }
    const std::vector<FigureVerdict> verdicts = judgeFigures(committed, *measured);
    Json rows = Json::array();
    for (const FigureVerdict& verdict : verdicts)
        rows.push_back(rowOf(verdict));
    if (!o.json) {
        printTitles(kRegressionColumns);
        for (const Json& row : rows)
            printRow(kRegressionColumns, row);
    }
    if (!o.output.empty()) {
        if (const Exit exit = writeRows(rows, o.output, "regression", o.json); exit != Exit::Done)
            return exit;
    } else if (o.json) {
        fmt::print("{}\n", Json{{"rows", rows}}.dump());
    }
    const std::string message = o.figures.empty() ? "" : judge(o, verdicts);
    return message.empty() ? Exit::Done : failed(message);
}

} // namespace

void addRegressionBench(Command& bench) {
    const auto o = std::make_shared<RegressionBench>();
    Command command = bench.addCommand(
        "regression", "Figures of quality of a few small scenes, compared with committed ones");
    command.option("-o,--output", o->output, "Folder for regression.csv and regression.json");
    const Option figures = command.option(
        "--figures", o->figures,
        "File of committed figures; fails where one is worse by more than its tolerance");
    command.flag("--update", o->update, "Write the measured figures to that file").needs(figures);
    command.option("--threads", o->threads, "Threads to use; 0: all").within(0, 1024);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runRegressionBench(*o); });
}

} // namespace limn
