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

/// Cases that were run, as a table in a folder that survives the process: stress.csv has a row per
/// case, "value/limit" per oracle, nothing where it was not judged. While a case runs,
/// stress.running holds its seed: a log that opens and finds it there counts that case as crashed.
class StressLog {
public:
    /// Reads what the folder has; makes it where it is missing. Fails on a table of other oracles.
    static Result<StressLog> open(const std::string& folder, const std::vector<Oracle>& oracles);

    const std::vector<CaseResult>& cases() const { return m_cases; }
    /// Where a run that begins with seed `first` goes on: behind all seeds that the table has.
    std::uint64_t next(std::uint64_t first) const;

    Result<void> begin(std::uint64_t seed);
    Result<void> end(const CaseResult& result);

private:
    std::string m_folder;
    std::size_t m_oracles = 0;
    std::vector<CaseResult> m_cases;

    Result<void> append(const std::string& line);
};

/// What one oracle said of all cases.
struct OracleCount {
    std::uint64_t judged = 0, skipped = 0, failed = 0;
    Judgement worst; ///< of the largest value over its limit
    std::optional<std::uint64_t> worstSeed, firstFailed;
};
std::vector<OracleCount> countOracles(const std::vector<CaseResult>& cases, std::size_t oracles);

} // namespace limn
