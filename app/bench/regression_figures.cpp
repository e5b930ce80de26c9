// SPDX-License-Identifier: MIT
#include "app/bench/regression_figures.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/json/json.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace limn {

static const RegressionFigure* findFigure(std::span<const RegressionFigure> figures,
                                          const RegressionFigure& wanted) {
    const auto found = std::ranges::find_if(figures, [&](const RegressionFigure& f) {
        return f.scene == wanted.scene && f.name == wanted.name;
    });
    return found == figures.end() ? nullptr : &*found;
}

double toleranceOf(const RegressionFigure& committed) {
    return std::max(4 * committed.noise, 0.005 * std::abs(committed.value));
}

static FigureVerdict judgeFigure(const RegressionFigure& committed,
                                 const RegressionFigure* measured) {
    if (!measured)
        return {FigureChange::Unmeasured, committed, {}};
    FigureVerdict verdict{FigureChange::Same, committed, *measured};
    const double growth = std::abs(measured->value) - std::abs(committed.value);
    if (!(growth <= toleranceOf(committed))) // NaN is worse
        verdict.change = FigureChange::Worse;
    else if (growth < -toleranceOf(committed))
        verdict.change = FigureChange::Better;
    return verdict;
}

std::vector<FigureVerdict> judgeFigures(std::span<const RegressionFigure> committed,
                                        std::span<const RegressionFigure> measured) {
    std::vector<FigureVerdict> verdicts;
    for (const RegressionFigure& figure : committed)
        verdicts.push_back(judgeFigure(figure, findFigure(measured, figure)));
    for (const RegressionFigure& figure : measured)
        if (!findFigure(committed, figure))
            verdicts.push_back({FigureChange::Uncommitted, {}, figure});
    return verdicts;
}

std::string describe(const FigureVerdict& verdict) {
    const RegressionFigure &c = verdict.committed, &m = verdict.measured;
    const auto values = [&](const char* change) {
        return fmt::format("{}: {} is {}: {:.4g} {}, committed {:.4g} +- {:.2g}, tolerance {:.2g}",
                           c.scene, c.name, change, m.value, m.unit, c.value, c.noise,
                           toleranceOf(c));
    };
    switch (verdict.change) {
    case FigureChange::Better:
        return values("better");
    case FigureChange::Worse:
        return values("worse");
    case FigureChange::Unmeasured:
        return fmt::format("{}: {} is committed, {:.4g} {}, but was not measured", c.scene, c.name,
                           c.value, c.unit);
    case FigureChange::Uncommitted:
        return fmt::format("{}: {} is {:.4g} {}, but none is committed", m.scene, m.name, m.value,
                           m.unit);
    case FigureChange::Same:
        break;
    }
    return values("the same");
}

/// What is wrong with a figure's JSON; empty: nothing.
static std::string figureDefect(const Json& json) {
    if (!json.isObject())
        return "must be an object";
    for (const char* key : {"scene", "name", "unit"})
        if (!json[key].isString())
            return fmt::format("{} must be a string", key);
    for (const char* key : {"value", "noise"})
        if (!json[key].isNumber() || !std::isfinite(json[key].get<double>()))
            return fmt::format("{} must be a finite number", key);
    return json["noise"].get<double>() < 0 ? "noise must not be negative" : "";
}

Result<std::vector<RegressionFigure>> readFigures(const std::string& path) {
    const Result<std::string> text = readFile(path, 1 << 20);
    if (!text)
        return fail(fmt::format("{}: {}", path, text.error().message));
    const Result<Json> json = parseJson(*text);
    if (!json)
        return fail(fmt::format("{}: {}", path, json.error().message));
    if (!json->isObject() || !(*json)["figures"].isArray())
        return fail(fmt::format("{}: figures must be an array", path));
    std::vector<RegressionFigure> figures;
    for (const Json& j : (*json)["figures"]) {
        const std::string field = fmt::format("{}: figures[{}]", path, figures.size());
        if (const std::string defect = figureDefect(j); !defect.empty())
            return fail(fmt::format("{}: {}", field, defect));
        const RegressionFigure figure{j["scene"].get<std::string>(), j["name"].get<std::string>(),
                                      j["unit"].get<std::string>(), j["value"].get<double>(),
                                      j["noise"].get<double>()};
        if (findFigure(figures, figure))
            return fail(fmt::format("{}: name: {} has a second figure {}", field, figure.scene,
                                    figure.name));
        figures.push_back(figure);
    }
    return figures;
}

static double rounded(double value, int digits) {
    return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

Result<void> writeFigures(const std::string& path, std::span<const RegressionFigure> figures) {
    std::string lines; // a figure a line, so that a change shows which figures it changes
    for (const RegressionFigure& f : figures) {
        if (!std::isfinite(f.value) || !std::isfinite(f.noise))
            return fail(fmt::format("{}: {}: {} is not finite", path, f.scene, f.name));
        const Json json{{"scene", f.scene},
                        {"name", f.name},
                        {"unit", f.unit},
                        {"value", rounded(f.value, 4)},
                        {"noise", rounded(f.noise, 2)}};
        lines += (lines.empty() ? "\n  " : ",\n  ") + json.dump();
    }
    return replaceFile(path, "{\"figures\": [" + lines + "\n]}\n");
}

} // namespace limn
