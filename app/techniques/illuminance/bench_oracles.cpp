// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_oracles.h"

#include "app/techniques/illuminance/device_oracle.h"

#include "engine/core/log.h"
#include "engine/techniques/illuminance/stress/case_file.h"
#include "engine/techniques/illuminance/stress/minimise.h"
#include "engine/techniques/illuminance/stress/stress_log.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>

#include <fmt/format.h>

namespace limn {

namespace {

/// Maximum number of failing cases that are minimised per oracle.
constexpr std::uint64_t kMaxCaseFiles = 3;

volatile std::sig_atomic_t interrupted = 0;

/// Ends the run after the current case; a second signal ends the process.
void stopAfterCase(int signal) {
    interrupted = 1;
    std::signal(signal, SIG_DFL);
}

constexpr Column kOracleColumns[] = {
    {"oracle", -14, "oracle"},    {"judged", 7, "judged"},
    {"skipped", 7, "skipped"},    {"failed", 7, "failed"},
    {"worst", 12, "worst", 6},    {"limit", 10, "limit", 6},
    {"of seed", 8, "worst_seed"}, {"first failed", 12, "first_failed"},
    {"what holds", -70, "what"}};

Json rowsOf(const std::vector<CaseResult>& cases, const std::vector<Oracle>& oracles) {
    Json rows = Json::array();
    const std::vector<OracleCount> counts = countOracles(cases, oracles.size());
    for (std::size_t k = 0; k < oracles.size(); ++k) {
        const OracleCount& c = counts[k];
        Json row = {
            {"oracle", oracles[k].name}, {"judged", c.judged},      {"skipped", c.skipped},
            {"failed", c.failed},        {"worst", nullptr},        {"limit", nullptr},
            {"worst_seed", nullptr},     {"first_failed", nullptr}, {"what", oracles[k].what}};
        if (c.worstSeed) {
            row["worst"] = c.worst.value;
            row["limit"] = c.worst.limit;
            row["worst_seed"] = *c.worstSeed;
        }
        if (c.firstFailed)
            row["first_failed"] = *c.firstFailed;
        rows.push_back(std::move(row));
    }
    return rows;
}

Json endsOf(const std::vector<CaseResult>& cases) {
    Json ends = {{"cases", cases.size()}};
    for (std::size_t k = 0; k < kCaseEndNames.size(); ++k) {
        std::vector<std::uint64_t> seeds;
        for (const CaseResult& c : cases)
            if (c.end == CaseEnd(k))
                seeds.push_back(c.seed);
        ends[std::string(kCaseEndNames[k])] = seeds.size();
        if (CaseEnd(k) == CaseEnd::Slow || CaseEnd(k) == CaseEnd::Crashed)
            ends[std::string(kCaseEndNames[k]) + "_seeds"] = seeds;
    }
    return ends;
}

Exit report(const OracleBench& o, const std::vector<CaseResult>& cases,
            const std::vector<Oracle>& oracles) {
    const Json rows = rowsOf(cases, oracles), ends = endsOf(cases);
    if (const Exit exit = writeRows(rows, o.output, "stress-oracles", false); exit != Exit::Done)
        return exit;
    if (o.json) {
        fmt::print("{}\n", Json{{"rows", rows}, {"ends", ends}}.dump());
    } else {
        printTitles(kOracleColumns);
        for (const Json& row : rows)
            printRow(kOracleColumns, row);
        for (const auto& [key, value] : ends.members())
            if (!value.isArray() || !value.empty())
                fmt::print("{:<16}{}\n", key, value.dump());
    }
    std::string broken;
    for (const Json& row : rows)
        if (row["failed"] != 0)
            broken += (broken.empty() ? "" : ", ") + row["oracle"].get<std::string>();
    if (!broken.empty())
        return failed("oracles failed: " + broken);
    return ends["crashed"] == 0 ? Exit::Done : failed("cases ended the process");
}

/// Writes the minimised case for each oracle that it fails.
Result<void> keepFailing(const OracleBench& o, const StressCase& stressCase,
                         const CaseResult& result, const std::vector<Oracle>& oracles,
                         const std::vector<CaseResult>& before) {
    const std::vector<OracleCount> counts = countOracles(before, oracles.size());
    for (std::size_t k = 0; k < oracles.size(); ++k) {
        const Judgement& j = result.judgements[k];
        if (!j.failed())
            continue;
        const std::string file =
            fmt::format("{}/{}-{}.json", o.output, oracles[k].name, result.seed);
        logInfo(fmt::format("seed {}: {} is {:.4g}, at most {:.4g} may be: {}", result.seed,
                            oracles[k].name, j.value, j.limit, result.note));
        if (counts[k].failed >= kMaxCaseFiles)
            continue;
        const Result<void> written = writeCase(file, minimised(stressCase, oracles[k], o.output));
        if (!written)
            return written;
    }
    return {};
}

std::vector<Oracle> oraclesOf(const OracleBench& o) {
    std::vector<Oracle> oracles = engineOracles();
    oracles.push_back(deviceOracle(o.device, o.deviceShare));
    return oracles;
}

Exit runCaseFile(const OracleBench& o) {
    const Result<StressCase> stressCase = readCase(o.caseFile);
    if (!stressCase)
        return failed(stressCase.error().message);
    const std::vector<Oracle> oracles = oraclesOf(o);
    std::filesystem::create_directories(o.output);
    const CaseResult result = runCase(*stressCase, oracles, {o.caseSeconds, o.output});
    if (!o.json)
        fmt::print("{} in {:.0f} ms: {}\n", kCaseEndNames[std::size_t(result.end)],
                   result.milliseconds, result.note);
    return report(o, {result}, oracles);
}

} // namespace

void addOracleOptions(Command& command, OracleBench& o) {
    Option generated = command.option("--generated", o.scenes,
                                      "Judge this many hostile scenes by oracles instead");
    generated.within(1, 100000000);
    command.option("--first-seed", o.firstSeed, "Seed of the first generated scene")
        .needs(generated);
    command.option("--case", o.caseFile, "Case to judge, a file that an earlier run kept")
        .excludes(generated);
    command.option("--case-seconds", o.caseSeconds, "Time after which a case is stopped [s]")
        .within(0.1, 1e5);
    command.option("--device-share", o.deviceShare,
                   "Relight one scene in this many on the device too; 0: none");
}

Exit runOracleBench(const OracleBench& o) {
    if (!o.caseFile.empty())
        return runCaseFile(o);
    const std::vector<Oracle> oracles = oraclesOf(o);
    Result<StressLog> log = StressLog::open(o.output, oracles);
    if (!log)
        return failed(log.error().message);
    std::signal(SIGINT, stopAfterCase);
    std::signal(SIGTERM, stopAfterCase);
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t first = log->next(o.firstSeed), end = o.firstSeed + o.scenes;
    std::uint64_t seed = first;
    for (; seed < end && interrupted == 0; ++seed) {
        if (const Result<void> begun = log->begin(seed); !begun)
            return failed(begun.error().message);
        const StressCase stressCase = generatedCase(seed);
        const CaseResult result = runCase(stressCase, oracles, {o.caseSeconds, o.output});
        if (const Result<void> kept = keepFailing(o, stressCase, result, oracles, log->cases());
            !kept)
            return failed(kept.error().message);
        if (const Result<void> ended = log->end(result); !ended)
            return failed(ended.error().message);
    }
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start;
    if (!o.json && seed > first)
        fmt::print("{} cases in {:.0f} s, {:.1f} per second\n", seed - first, gone.count(),
                   double(seed - first) / gone.count());
    return report(o, log->cases(), oracles);
}

} // namespace limn
