// SPDX-License-Identifier: MIT
#pragma once

#include "app/techniques/technique_program.h"

namespace limn {

/// The program's part of the technique that lights bakes.
extern const TechniqueProgram kIlluminanceProgram;

// Each adds a benchmark of a part of the method, bench_NAME.cpp.
void addEnergyBench(CLI::App& bench, Run& run);
void addErrorBench(CLI::App& bench, Run& run);
void addFrameBench(CLI::App& bench, Run& run);
void addGlossyBench(CLI::App& bench, Run& run);
void addLinksBench(CLI::App& bench, Run& run);
void addPredictBench(CLI::App& bench, Run& run);
void addRelightBench(CLI::App& bench, Run& run);
void addStressBench(CLI::App& bench, Run& run);

} // namespace limn
