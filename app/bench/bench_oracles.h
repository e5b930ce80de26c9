// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/bench.h"

#include <cstdint>
#include <string>

namespace limn {

/// Hostile scenes before oracles.
struct OracleBench {
    std::uint32_t scenes = 0;
    std::uint64_t firstSeed = 0;
    std::string caseFile; ///< one case instead
    double caseSeconds = 30;
    std::uint32_t deviceShare = 16; ///< the device is asked for one seed in so many; 0: never
    std::string device;             ///< part of its name; empty: the best
    std::string output;             ///< folder
    bool json = false;
};
void addOracleOptions(CLI::App& command, OracleBench& options);

/// Goes on where an earlier run in the same folder ended. Fails where an oracle did, or a case
/// crashed.
Exit runOracleBench(const OracleBench& options);

} // namespace limn
