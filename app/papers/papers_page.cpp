// SPDX-License-Identifier: MIT
#include "app/papers/papers_page.h"

#include "app/bench/svg_chart.h"

#include "engine/core/base64.h"
#include "engine/core/read_file.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace limn {

namespace {

/// The columns of a table, in the order in which lines have them.
std::vector<std::string> columnsOf(const std::vector<PaperLine>& lines) {
    std::vector<std::string> columns;
    for (const PaperLine& line : lines)
        for (const PaperFigure& figure : line.figures)
            if (std::ranges::find(columns, figure.column) == columns.end())
                columns.push_back(figure.column);
    return columns;
}

const PaperFigure* figureOf(const PaperLine& line, const std::string& column) {
    const auto figure = std::ranges::find(line.figures, column, &PaperFigure::column);
    return figure == line.figures.end() ? nullptr : &*figure;
}

/// The given number of significant digits, and all of those before the point.
std::string shortNumber(double value, int digits = 3) {
    if (value == std::round(value))
        return fmt::format("{:.0f}", value);
    const int whole = int(std::floor(std::log10(std::abs(value)))) + 1;
    return fmt::format("{:.{}f}", value, std::clamp(digits - whole, 0, 4));
}

/// "3.42 ± 0.1 (116)": measured, its noise, and printed in brackets.
std::string cellOf(const PaperFigure* figure) {
    if (!figure)
        return "";
    std::string text = figure->measured ? shortNumber(*figure->measured) : "";
    if (figure->noise > 0)
        text += " \u00b1 " + shortNumber(figure->noise, 1);
    if (figure->printed)
        text += fmt::format("{}({})", text.empty() ? "" : " ", shortNumber(*figure->printed));
    return text;
}

/// A chart of error over time where lines have both; else nothing.
std::string chartOf(const std::vector<PaperLine>& lines) {
    Chart chart{"ms of an update on the CPU", "nRMSE", {}, {}};
    for (const PaperLine& line : lines) {
        const PaperFigure* error = figureOf(line, "nRMSE");
        const PaperFigure* time = nullptr;
        for (const char* column : {"all [ms]", "update [ms]", "caches [ms]"})
            if (!time)
                time = figureOf(line, column);
        if (!error || !time)
            continue;
        const bool paper = line.name.find("paper's") != std::string::npos;
        chart.marks.push_back(
            {*time->measured, *error->measured, kInks[paper ? 1 : 0], line.name, ""});
    }
    return chart.marks.size() < 2 ? "" : svgOf(chart);
}

std::string htmlTable(const std::vector<PaperLine>& lines) {
    const std::vector<std::string> columns = columnsOf(lines);
    std::string html = "<table><tr><th></th>";
    for (const std::string& column : columns)
        html += "<th>" + escapedHtml(column) + "</th>";
    html += "</tr>\n";
    for (const PaperLine& line : lines) {
        html += "<tr><td>" + escapedHtml(line.name) + "</td>";
        for (const std::string& column : columns)
            html += "<td>" + escapedHtml(cellOf(figureOf(line, column))) + "</td>";
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

Result<std::string> picturesOf(const std::vector<PaperLine>& lines, const std::string& folder) {
    std::string html;
    for (const PaperLine& line : lines) {
        if (line.picture.empty())
            continue;
        const Result<std::string> png = readFile(folder + "/" + line.picture);
        if (!png)
            return fail(fmt::format("{}/{}: {}", folder, line.picture, png.error().message));
        html += fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\">"
                            "<figcaption>{0}</figcaption></figure>\n",
                            escapedHtml(line.name), base64(*png));
    }
    return html;
}

std::string headOf(const PaperExperiment& experiment) {
    std::string text = experiment.note;
    if (*experiment.printedOn)
        text +=
            fmt::format(" Printed figures, in brackets, are those of {}.", experiment.printedOn);
    return text;
}

constexpr const char* kHowToRead =
    "Figures in brackets are printed in the paper. After \u00b1 stands the standard error of an "
    "error, and for a time how far its 95th percentile lies above its median.";

} // namespace

Result<std::string> papersPage(const std::vector<PaperTable>& tables, const std::string& machine,
                               const std::string& folder) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>The papers' "
        "experiments</title>\n<style>body{font:15px/1.45 sans-serif;max-width:1120px;margin:2em "
        "auto;padding:0 1em}table{border-collapse:collapse;margin:.6em 0}td,th{padding:.15em "
        ".6em;text-align:right;border-bottom:1px solid #ddd;font-size:13px}td:first-child{"
        "text-align:left}svg{font:12px sans-serif}figure{display:inline-block;margin:.3em}"
        "figcaption{font-size:12px}</style>\n<h1>The papers' experiments</h1>\n<p>" +
        escapedHtml(machine) + "</p>\n<p>" + kHowToRead + "</p>\n";
    for (const PaperTable& table : tables) {
        html += fmt::format("<h2>{}, {}</h2>\n<p>{}</p>\n", table.experiment->key,
                            escapedHtml(table.experiment->title),
                            escapedHtml(headOf(*table.experiment)));
        if (!table.skipped.empty()) {
            html += "<p><b>Not measured: " + escapedHtml(table.skipped) + "</b></p>\n";
            continue;
        }
        const Result<std::string> pictures = picturesOf(table.lines, folder);
        if (!pictures)
            return pictures;
        html += htmlTable(table.lines) + chartOf(table.lines) + *pictures;
    }
    return html + "</html>\n";
}

std::string papersMarkdown(const std::vector<PaperTable>& tables, const std::string& machine) {
    std::string text = machine + "\n\n" + kHowToRead + "\n";
    for (const PaperTable& table : tables) {
        text += fmt::format("\n## {}, {}\n\n{}\n\n", table.experiment->key, table.experiment->title,
                            headOf(*table.experiment));
        if (!table.skipped.empty()) {
            text += "Not measured: " + table.skipped + "\n";
            continue;
        }
        const std::vector<std::string> columns = columnsOf(table.lines);
        text += "| |";
        for (const std::string& column : columns)
            text += " " + column + " |";
        text += "\n|---|";
        for (std::size_t k = 0; k < columns.size(); ++k)
            text += "---|";
        text += "\n";
        for (const PaperLine& line : table.lines) {
            text += "| " + line.name + " |";
            for (const std::string& column : columns)
                text += " " + cellOf(figureOf(line, column)) + " |";
            text += "\n";
        }
    }
    return text;
}

Json papersRows(const std::vector<PaperTable>& tables) {
    const auto jsonOf = [](const std::optional<double>& value) {
        return value ? Json(*value) : Json();
    };
    Json rows = Json::array();
    for (const PaperTable& table : tables)
        for (const PaperLine& line : table.lines)
            for (const PaperFigure& figure : line.figures)
                rows.push_back({{"experiment", table.experiment->key},
                                {"line", line.name},
                                {"quantity", figure.column},
                                {"measured", jsonOf(figure.measured)},
                                {"noise", figure.noise},
                                {"printed", jsonOf(figure.printed)}});
    return rows;
}

} // namespace limn
