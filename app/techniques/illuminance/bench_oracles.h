// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/bench.h"

#include <cstdint>
#include <string>

namespace limn {

/// Options of the run that tests hostile scenes with oracles.
struct OracleBench {
    std::uint32_t scenes = 0;
    std::uint64_t firstSeed = 0;
    std::string caseFile; ///< runs this single case instead
    double caseSeconds = 30;
    std::uint32_t deviceShare = 16; ///< the device judges one seed in this many; 0: never
    std::string device;             ///< part of its name; empty: the best
    std::string output;             ///< folder
    bool json = false;
};
void addOracleOptions(Command& command, OracleBench& options);

/// Continues where an earlier run in the same folder ended. Fails if an oracle failed or a case
/// crashed.
Exit runOracleBench(const OracleBench& options);

} // namespace limn
