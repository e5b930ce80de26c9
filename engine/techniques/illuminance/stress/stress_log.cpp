// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/stress_log.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr const char *kTable = "/stress.csv", *kRunning = "/stress.running";

std::string headerOf(const std::vector<Oracle>& oracles) {
    std::string header = "seed,end,ms";
    for (const Oracle& o : oracles)
        header += "," + std::string(o.name);
    return header + ",note";
}

std::string lineOf(const CaseResult& c) {
    std::string line =
        fmt::format("{},{},{:.1f}", c.seed, kCaseEndNames[std::size_t(c.end)], c.milliseconds);
    for (const Judgement& j : c.judgements)
        line += j.judged ? fmt::format(",{:.6g}/{:.6g}", j.value, j.limit) : ",";
    std::string note = c.note;
    std::replace(note.begin(), note.end(), '"', '\'');
    std::replace(note.begin(), note.end(), '\n', ' ');
    return line + ",\"" + note + "\"";
}

std::optional<CaseResult> readLine(const std::string& line, std::size_t oracles) {
    std::istringstream in(line);
    CaseResult c;
    std::string cell;
    const auto next = [&] { return bool(std::getline(in, cell, ',')); };
    if (!next())
        return {};
    c.seed = std::strtoull(cell.c_str(), nullptr, 10);
    if (!next())
        return {};
    const auto end = std::find(kCaseEndNames.begin(), kCaseEndNames.end(), cell);
    if (end == kCaseEndNames.end() || !next())
        return {};
    c.end = CaseEnd(end - kCaseEndNames.begin());
    c.milliseconds = std::strtod(cell.c_str(), nullptr);
    for (std::size_t k = 0; k < oracles; ++k) {
        if (!next())
            return {};
        Judgement j;
        if (const std::size_t slash = cell.find('/'); slash != std::string::npos)
            j = judged(std::strtod(cell.c_str(), nullptr),
                       std::strtod(cell.c_str() + slash + 1, nullptr));
        c.judgements.push_back(j);
    }
    if (!std::getline(in, cell) || cell.size() < 2 || cell.back() != '"')
        return {};
    c.note = cell.substr(1, cell.size() - 2);
    return c;
}

} // namespace

Result<StressLog> StressLog::open(const std::string& folder, const std::vector<Oracle>& oracles) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return fail(fmt::format("{}: {}", folder, error.message()));
    StressLog log;
    log.m_folder = folder;
    log.m_oracles = oracles.size();
    const std::string header = headerOf(oracles);
    std::ifstream table(folder + kTable);
    std::string line, kept = header + "\n";
    if (table && std::getline(table, line) && line != header)
        return fail(folder + kTable + ": has other oracles, take another folder");
    while (table && std::getline(table, line))
        if (std::optional<CaseResult> c = readLine(line, oracles.size())) { // skips a torn line
            log.m_cases.push_back(std::move(*c));
            kept += line + "\n";
        }
    table.close();
    if (const Result<void> written = replaceFile(folder + kTable, kept); !written)
        return tl::make_unexpected(written.error());
    std::ifstream running(folder + kRunning);
    std::uint64_t seed = 0;
    if (running >> seed) {
        CaseResult crashed{.seed = seed,
                           .end = CaseEnd::Crashed,
                           .judgements = std::vector<Judgement>(oracles.size()),
                           .note = "the process ended"};
        running.close();
        if (const Result<void> ended = log.end(crashed); !ended)
            return tl::make_unexpected(ended.error());
    }
    return log;
}

std::uint64_t StressLog::next(std::uint64_t first) const {
    std::uint64_t seed = first;
    for (const CaseResult& c : m_cases)
        seed = std::max(seed, c.seed + 1);
    return seed;
}

Result<void> StressLog::begin(std::uint64_t seed) {
    std::ofstream running(m_folder + kRunning);
    running << seed << std::endl;
    return running ? Result<void>() : fail(m_folder + kRunning + ": cannot be written");
}

Result<void> StressLog::append(const std::string& line) {
    std::ofstream table(m_folder + kTable, std::ios::app);
    table << line << std::endl;
    return table ? Result<void>() : fail(m_folder + kTable + ": cannot be written");
}

Result<void> StressLog::end(const CaseResult& result) {
    if (const Result<void> written = append(lineOf(result)); !written)
        return written;
    m_cases.push_back(result);
    std::error_code ignored;
    std::filesystem::remove(m_folder + kRunning, ignored);
    return {};
}

std::vector<OracleCount> countOracles(const std::vector<CaseResult>& cases, std::size_t oracles) {
    std::vector<OracleCount> counts(oracles);
    const auto share = [](const Judgement& j) {
        if (j.limit > 0 && !std::isnan(j.value))
            return j.value / j.limit;
        return j.value <= 0 ? 0 : std::numeric_limits<double>::infinity();
    };
    for (const CaseResult& c : cases)
        for (std::size_t k = 0; k < oracles; ++k) {
            const Judgement& j = c.judgements[k];
            OracleCount& count = counts[k];
            ++(j.judged ? count.judged : count.skipped);
            if (j.failed()) {
                ++count.failed;
                count.firstFailed = std::min(count.firstFailed.value_or(c.seed), c.seed);
            }
            const bool isWorse = !count.worstSeed || !(share(j) <= share(count.worst)) ||
                                 (share(j) == share(count.worst) && j.value > count.worst.value);
            if (j.judged && isWorse) {
                count.worst = j;
                count.worstSeed = c.seed;
            }
        }
    return counts;
}

} // namespace limn
