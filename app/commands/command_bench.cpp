// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/bench/bench_techniques.h"
#include "app/papers/bench_papers.h"
#include "app/techniques/technique_program.h"

#include "engine/core/replace_file.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

std::string csvOf(const Json& rows) {
    std::string csv;
    for (const Json& row : rows) {
        if (csv.empty()) {
            for (const auto& [key, value] : row.members())
                csv += (csv.empty() ? "" : ",") + key;
            csv += '\n';
        }
        std::string line;
        for (const auto& [key, value] : row.members())
            line += (line.empty() ? "" : ",") + value.dump();
        csv += line + '\n';
    }
    return csv;
}

} // namespace

static std::string padded(const std::string& text, int width) {
    return width < 0 ? fmt::format("{0:<{1}.{1}}", text, -width)
                     : fmt::format("{:>{}}", text, width);
}

static std::string shown(const Json& value, const Column& column) {
    if (value.isNull())
        return "-";
    if (value.isString())
        return value.get<std::string>();
    if (value.isFloat() || column.scale != 1)
        return fmt::format("{:.{}f}", value.get<double>() * column.scale, column.decimals);
    return value.dump();
}

void printTitles(std::span<const Column> columns) {
    for (const Column& c : columns)
        fmt::print("{} ", padded(c.title, c.width));
    fmt::print("\n");
}

void printRow(std::span<const Column> columns, const Json& row) {
    for (const Column& c : columns)
        fmt::print("{} ", padded(shown(row[c.key], c), c.width));
    fmt::print("\n");
    std::fflush(stdout);
}

Exit writeRows(const Json& rows, const std::string& folder, const std::string& name, bool json) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return failed(fmt::format("{}: {}", folder, error.message()));
    for (const auto& [extension, text] :
         {std::pair<const char*, std::string>(".csv", csvOf(rows)), {".json", rows.dump(1) + '\n'}})
        if (const Result<void> written = replaceFile(folder + "/" + name + extension, text);
            !written)
            return failed(written.error().message);
    if (json)
        fmt::print("{}\n", Json{{"rows", rows}}.dump());
    return Exit::Done;
}

void addBenchCommand(Command& app) {
    Command bench = app.addCommand("bench", "Run a benchmark and write its table");
    bench.requireCommand();
    addPapersBench(bench);
    addTechniquesBench(bench);
    for (const TechniqueProgram* program : techniquePrograms())
        program->addBenches(bench);
}

} // namespace limn
