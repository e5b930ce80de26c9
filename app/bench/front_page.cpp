// SPDX-License-Identifier: MIT
#include "app/bench/front_page.h"

#include "app/bench/front_claims.h"
#include "app/bench/svg_chart.h"
#include "app/bench/techniques_page.h"

#include "engine/measure/pareto_line.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>

namespace limn {

namespace {

/// What errors are drawn over.
struct Cost {
    const char* key;
    double unit;
    const char* title;
    std::array<double, 6> budgets;
};
constexpr Cost kTime{
    "update_ms", 1, "ms of an update of one bounce, all lights moved", {1, 2, 5, 10, 20, 50}},
    kMemory{"bytes", 1 << 20, "MiB that updates read and write", {1, 4, 16, 32, 64, 256}};

/// Indices of the rows on the Pareto line of `error` over a cost.
std::vector<std::size_t> lineOf(const std::vector<Json>& rows, const Cost& cost,
                                const char* error) {
    std::vector<CostAndError> choices;
    for (const Json& row : rows)
        choices.push_back({row[cost.key].get<double>(), row[error].get<double>()});
    return paretoLine(choices);
}

/// A colour for each number of links and a mark for each number of surfels, from few to many.
struct Inks {
    std::map<double, std::size_t> links, surfels;

    explicit Inks(const std::vector<Json>& rows) {
        for (const Json& row : rows) {
            links[row["links"].get<double>()] = 0;
            surfels[row["surfels"].get<double>()] = 0;
        }
        for (auto* numbers : {&links, &surfels})
            for (std::size_t k = 0; auto& [number, ink] : *numbers)
                ink = k++ % kInks.size();
    }
    Ink of(const Json& row) const {
        return {kInks[links.at(row["links"].get<double>())].color,
                kInks[surfels.at(row["surfels"].get<double>())].mark};
    }
    std::string legend() const {
        std::string html = "<p>Colours: ";
        for (const auto& [number, ink] : links)
            html += fmt::format("<span style=\"color:{}\">{:g} links</span> &nbsp; ",
                                kInks[ink].color, number);
        html += "Marks: ";
        for (const auto& [number, ink] : surfels)
            html += fmt::format("{} {:g} surfels &nbsp; ", kInks[ink].mark, number);
        return html + "Rings: presets. Line: no row costs less and is as right.</p>\n";
    }
};

std::string frontChart(const std::vector<Json>& rows, const Inks& inks, const Cost& cost,
                       const char* error, const char* title) {
    Chart chart{cost.title, title, {}, lineOf(rows, cost, error)};
    for (const Json& row : rows) {
        const double x = row[cost.key].get<double>() / cost.unit, y = row[error].get<double>();
        chart.marks.push_back(
            {x, y, inks.of(row),
             fmt::format("{}: {:.3g}, nRMSE {:.4f}", row["settings"].get<std::string>(), x, y),
             row["preset"].get<std::string>()});
    }
    return svgOf(chart);
}

std::string budgetTable(const std::vector<Json>& rows, const Cost& cost, const char* unit) {
    std::string html = fmt::format("<table><tr><th>at most [{}]</th><th>least error of live light"
                                   "</th><th>nRMSE</th></tr>\n",
                                   unit);
    for (const double budget : cost.budgets)
        if (const Json* best = bestWithin(rows, cost.key, budget * cost.unit))
            html += fmt::format("<tr><td>{:g}</td><td>{}</td><td>{:.4f}</td></tr>\n", budget,
                                escapedHtml((*best)["settings"].get<std::string>()),
                                (*best)["nrmse"].get<double>());
    return html + "</table>\n";
}

std::string claimList(const std::vector<Json>& rows) {
    constexpr std::array kVerdicts = {"Holds", "Does not hold", "Not decided"};
    std::string html = "<ul>\n";
    for (const PaperClaim& claim : paperClaims(rows))
        html += fmt::format("<li>\u201c{}\u201d <b>{}.</b> {}</li>\n", escapedHtml(claim.sentence),
                            kVerdicts[std::size_t(claim.verdict)], escapedHtml(claim.reason));
    return html + "</ul>\n";
}

std::string rowTable(const std::vector<Json>& rows) {
    std::string html = "<table><tr><th>settings</th><th>preset</th><th>bake [s]</th><th>MiB</th>"
                       "<th>update [ms]</th><th>median</th><th>95 %</th><th>nRMSE, live</th>"
                       "<th>\u00b1</th><th>bias</th><th>nRMSE, gathered</th><th>bias</th>"
                       "<th>on a line</th></tr>\n";
    const auto percent = [](const Json& v) {
        return v.isNull() ? "" : fmt::format("{:+.1f} %", 100 * v.get<double>());
    };
    for (const Json& r : rows) {
        const bool time = r["time_front"].get<bool>(), memory = r["memory_front"].get<bool>();
        html += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{:.1f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td>"
            "<td>{:.2f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td></tr>\n",
            escapedHtml(r["settings"].get<std::string>()),
            escapedHtml(r["preset"].get<std::string>()), r["seconds"].get<double>(),
            r["bytes"].get<double>() / (1 << 20), r["update_ms"].get<double>(),
            r["median_ms"].get<double>(), r["p95_ms"].get<double>(), r["nrmse"].get<double>(),
            r["nrmse_noise"].get<double>(), percent(r["bias"]),
            r["gathered_nrmse"].isNull() ? ""
                                         : fmt::format("{:.4f}", r["gathered_nrmse"].get<double>()),
            percent(r["gathered_bias"]),
            time && memory ? "time, memory"
            : time         ? "time"
            : memory       ? "memory"
                           : "");
    }
    return html + "</table>\n";
}

std::string scenePart(const FrontPageScene& scene) {
    std::string html =
        fmt::format("<h2>{}</h2>\n<p>{}</p>\n", escapedHtml(scene.name), escapedHtml(scene.note));
    const Inks inks(scene.rows);
    html += inks.legend();
    html += "<h3>Live light</h3>\n";
    for (const Cost& cost : {kTime, kMemory})
        html += frontChart(scene.rows, inks, cost, "nrmse", "nRMSE, live light");
    const bool gathered = std::ranges::none_of(
        scene.rows, [](const Json& row) { return row["gathered_nrmse"].isNull(); });
    if (gathered) {
        html += "<h3>Gathered pictures</h3>\n";
        for (const Cost& cost : {kTime, kMemory})
            html += frontChart(scene.rows, inks, cost, "gathered_nrmse", "nRMSE, gathered");
    }
    html += "<h3>Within a budget</h3>\n" + budgetTable(scene.rows, kTime, "ms") +
            budgetTable(scene.rows, kMemory, "MiB");
    html += "<h3>Sentences of the paper</h3>\n" + claimList(scene.rows);
    return html + "<h3>All rows</h3>\n" + rowTable(scene.rows);
}

} // namespace

void markLines(std::vector<Json>& rows) {
    for (const auto& [key, cost] : {std::pair("time_front", kTime), {"memory_front", kMemory}}) {
        for (Json& row : rows)
            row[key] = false;
        for (const std::size_t i : lineOf(rows, cost, "nrmse"))
            rows[i][key] = true;
    }
}

std::string frontPage(const std::vector<FrontPageScene>& scenes, const std::string& note) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Error over time and "
        "memory</title>\n<style>body{font:15px/1.45 sans-serif;max-width:1120px;margin:2em auto;"
        "padding:0 1em}table{border-collapse:collapse;margin:.6em 0}td,th{padding:.15em .6em;"
        "text-align:right;border-bottom:1px solid #ddd;white-space:nowrap;font-size:13px}"
        "th{white-space:normal}td:first-child,th:first-child{text-align:left}svg{font:12px "
        "sans-serif}</style>\n<h1>Error over time and memory</h1>\n<p>Each row is a bake of other "
        "settings. Errors are those of the bounced light against path tracing, by two references "
        "of independent noise: of live light, which is what the field holds, and of gathered "
        "pictures, which end with rays from each pixel and are a quarter as wide. Of gathered "
        "pictures, the noise of their "
        "own rays does not count. Times are those of an update of one bounce on the processor, of "
        "all its steps, "
        "with all lights moved; without lights, the sky changes. Memory is the bake with all that "
        "updates read and write beside it. The sentences are those of Jendersie, Kuri, Grosch. "
        "Real-Time Global Illumination Using Precomputed Illuminance Composition with Chrominance "
        "Compression. 2016; whether they hold is computed from the rows of the scene.</p>\n<p>" +
        escapedHtml(note) + "</p>\n";
    for (const FrontPageScene& scene : scenes)
        html += scenePart(scene);
    return html + "</html>\n";
}

} // namespace limn
