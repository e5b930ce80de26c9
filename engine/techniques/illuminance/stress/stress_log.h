// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/techniques/illuminance/stress/stress_case.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

inline constexpr std::array<std::string_view, 4> kCaseEndNames = {"done", "refused", "slow",
                                                                  "crashed"};

/// Log of the cases that were run, stored in a folder so that it survives a crash. stress.csv has a
/// row per case, with "value/limit" per oracle, or nothing where it was not judged. While a case
/// runs, stress.running holds its seed; a log that finds this file when it is opened counts that
/// case as crashed.
class StressLog {
public:
    /// Opens the log in `folder`, which is created if missing. Fails on a table of other oracles.
    static Result<StressLog> open(const std::string& folder, const std::vector<Oracle>& oracles);

    const std::vector<CaseResult>& cases() const { return m_cases; }
    /// The seed with which a run that begins with seed `first` continues, behind all seeds in the
    /// table.
    std::uint64_t next(std::uint64_t first) const;

    Result<void> begin(std::uint64_t seed);
    Result<void> end(const CaseResult& result);

private:
    std::string m_folder;
    std::size_t m_oracles = 0;
    std::vector<CaseResult> m_cases;

    Result<void> append(const std::string& line);
};

/// Summary of one oracle's judgements of all cases.
struct OracleCount {
    std::uint64_t judged = 0, skipped = 0, failed = 0;
    Judgement worst; ///< the one with the largest value / limit
    std::optional<std::uint64_t> worstSeed, firstFailed;
};
std::vector<OracleCount> countOracles(const std::vector<CaseResult>& cases, std::size_t oracles);

} // namespace limn
