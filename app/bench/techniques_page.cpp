// SPDX-License-Identifier: MIT
#include "app/bench/techniques_page.h"

#include "app/bench/svg_chart.h"

#include "engine/core/base64.h"
#include "engine/files/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::array kMilliseconds = {2., 5., 10., 33., 100.};
constexpr std::array kMebibytes = {1., 4., 16., 64., 256.};

/// Techniques in the order of the rows, with their inks.
std::map<std::string, Ink> inksOf(const std::vector<Json>& rows) {
    std::map<std::string, Ink> inks;
    for (const Json& row : rows)
        inks.try_emplace(row["technique"].get<std::string>(), kInks[inks.size() % kInks.size()]);
    return inks;
}

/// A chart of error over `key` in a unit.
std::string chart(const std::vector<Json>& rows, const std::string& key, double unit,
                  const char* title) {
    Chart chart{title, "nRMSE", {}, {}};
    for (const auto& [technique, ink] : inksOf(rows))
        for (const Json& row : rows)
            if (row["technique"] == technique)
                chart.marks.push_back({row[key].get<double>() / unit, row["nrmse"].get<double>(),
                                       ink, technique + ", " + row["settings"].get<std::string>(),
                                       ""});
    return svgOf(chart);
}

std::string legend(const std::vector<Json>& rows) {
    std::string html = "<p>";
    for (const auto& [technique, ink] : inksOf(rows))
        html += fmt::format("<span style=\"color:{}\">{}</span> {} &nbsp; ", ink.color, ink.mark,
                            escapedHtml(technique));
    return html + "</p>\n";
}

template <std::size_t N>
std::string winners(const std::vector<Json>& rows, const std::string& key, double unit,
                    const char* title, const std::array<double, N>& budgets) {
    std::string html =
        fmt::format("<table><tr><th>{}</th><th>smallest error</th><th>nRMSE</th></tr>\n", title);
    for (const double budget : budgets) {
        const Json* best = bestWithin(rows, key, budget * unit);
        html += fmt::format("<tr><td>{:g}</td>", budget);
        html += best ? fmt::format("<td>{}, {}</td><td>{:.3f}</td></tr>\n",
                                   escapedHtml((*best)["technique"].get<std::string>()),
                                   escapedHtml((*best)["settings"].get<std::string>()),
                                   (*best)["nrmse"].get<double>())
                     : "<td>none</td><td></td></tr>\n";
    }
    return html + "</table>\n";
}

std::string number(const Json& value, const char* format, double unit = 1) {
    return value.isNull() ? "" : fmt::format(fmt::runtime(format), value.get<double>() / unit);
}

std::string allRows(const std::vector<Json>& rows) {
    std::string html =
        "<table><tr><th>technique</th><th>settings</th><th>device</th><th>precompute [s]</th>"
        "<th>MiB</th><th>light moves [ms]</th><th>colour</th><th>material</th><th>object</th>"
        "<th>camera</th><th>nRMSE</th><th>bias</th><th>nRMSE, one bounce</th><th>bias</th>"
        "<th>SSIM</th><th>FLIP</th><th>leak</th><th>flicker: lights</th><th>camera</th>"
        "<th>objects</th><th>lag</th>"
        "<th>difference to the CPU</th><th>largest</th></tr>\n";
    for (const Json& r : rows) {
        const auto cell = [&html](const std::string& text) { html += "<td>" + text + "</td>"; };
        html += "<tr>";
        for (const char* key : {"technique", "settings", "device"})
            cell(escapedHtml(r[key].get<std::string>()));
        cell(number(r["seconds"], "{:.2f}"));
        cell(number(r["bytes"], "{:.2f}", 1 << 20));
        for (const char* key : {"light_ms", "color_ms", "material_ms", "object_ms", "camera_ms"})
            cell(number(r[key], "{:.2f}"));
        cell(number(r["nrmse"], "{:.3f}"));
        cell(number(r["bias"], "{:+.1f} %", 0.01));
        cell(number(r["one_bounce_nrmse"], "{:.3f}"));
        cell(number(r["one_bounce_bias"], "{:+.1f} %", 0.01));
        cell(number(r["ssim"], "{:.3f}"));
        cell(number(r["flip"], "{:.3f}"));
        cell(number(r["leak"], "{:.2f} %", 0.01));
        for (const char* key : {"flicker", "camera_flicker", "object_flicker"})
            cell(number(r[key], "{:+.2f} %", 0.01));
        cell(number(r["lag"], "{:.0f}"));
        cell(number(r["cpu_difference_rms"], "{:.3f} %", 0.01));
        cell(number(r["cpu_difference_max"], "{:.3f} %", 0.01));
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

/// Devices in the order of the rows, with the rows of each.
std::vector<std::pair<std::string, std::vector<Json>>> byDevice(const std::vector<Json>& rows) {
    std::vector<std::pair<std::string, std::vector<Json>>> devices;
    for (const Json& row : rows) {
        const auto name = row["device"].get<std::string>();
        auto known = std::ranges::find(devices, name, [](const auto& d) { return d.first; });
        if (known == devices.end())
            known = devices.insert(known, {name, {}});
        known->second.push_back(row);
    }
    return devices;
}

} // namespace

const Json* bestWithin(const std::vector<Json>& rows, const std::string& key, double budget) {
    const Json* best = nullptr;
    for (const Json& row : rows)
        if (row[key].get<double>() <= budget &&
            (!best || row["nrmse"].get<double>() < (*best)["nrmse"].get<double>()))
            best = &row;
    return best;
}

Result<std::string> techniquesPage(const std::vector<PageScene>& scenes,
                                   const std::string& leakRoom) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\">"
        "<title>Techniques of bounced light</title>\n"
        "<style>body{font:15px/1.45 sans-serif;max-width:1120px;margin:2em auto;padding:0 1em}"
        "table{border-collapse:collapse;margin:.6em 0}td,th{padding:.15em .6em;text-align:right;"
        "border-bottom:1px solid "
        "#ddd;white-space:nowrap;font-size:13px}th{white-space:normal}td:nth-child(-n+3),th:nth-"
        "child(-n+3){text-align:left}"
        "figure{display:inline-block;margin:.4em}figcaption{font-size:13px}svg{font:12px "
        "sans-serif}</style>\n<h1>Techniques of bounced light</h1>\n"
        "<p>Error is that of irradiance against path tracing with all bounces, by two references "
        "of "
        "independent noise. Times are those of updates until the light is up to date everywhere, "
        "and, after the camera has turned, where it looks. They include shadow rays on the CPU, "
        "and "
        "shadow maps on a Vulkan device, but neither reading light back nor what follows the scene "
        "for all techniques: its ray-tracing data, geometry and textures. Memory is what updates "
        "read and write on the CPU, and what a device has allocated for the light. The difference "
        "to the CPU is that of irradiance, rms and at the worst pixel, relative to the CPU's mean. "
        "A "
        "scene's sky and emissive surfaces count: techniques that cannot light by them are dark "
        "there.</p>\n"
        "<p>SSIM (1: equal) and FLIP (0: equal) are those of the tone-mapped picture with direct "
        "light. Flicker and lag are measured as the editor shows light, with one update a frame. "
        "Flicker is the change of irradiance between frames, less that of path tracing, relative "
        "to the mean, while the lights, the camera or the dynamic objects move smoothly: below 0 "
        "light lags behind. It is that of the same places in all frames: for the camera, of what "
        "it sees in each of them, for objects, of static surfaces that they never hide. Lag is the "
        "number "
        "of updates after a jump of the lights until irradiance is within 5 % of what it becomes; "
        "empty: it never is, or was not within the time of the measurement. Leak is the mean "
        "irradiance in a sealed dark room over that in the "
        "lit one beside it: " +
        escapedHtml(leakRoom) + ".</p>\n";
    for (const PageScene& scene : scenes) {
        html += fmt::format("<h2>{}</h2>\n<p>{}</p>\n", escapedHtml(scene.name),
                            escapedHtml(scene.note));
        for (const auto& [device, rows] : byDevice(scene.rows)) {
            html += fmt::format("<h3>On {}</h3>\n", escapedHtml(device));
            html += legend(rows);
            html += chart(rows, "light_ms", 1, "ms after a light has moved");
            html += chart(rows, "bytes", 1 << 20, "MiB");
            html += winners(rows, "light_ms", 1, "at most [ms]", kMilliseconds);
            html += winners(rows, "bytes", 1 << 20, "at most [MiB]", kMebibytes);
        }
        html += allRows(scene.rows);
        for (const PagePicture& picture : scene.pictures) {
            const Result<std::string> png = encodePng(picture.image);
            if (!png)
                return tl::make_unexpected(png.error());
            html += fmt::format("<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\" "
                                "width=\"300\"><figcaption>{0}</figcaption></figure>\n",
                                escapedHtml(picture.caption), base64(*png));
        }
    }
    return html + "</html>\n";
}

} // namespace limn
