// SPDX-License-Identifier: MIT
#pragma once

#include "app/techniques/technique_program.h"

namespace limn {

/// The program's part of the technique that lights bakes.
extern const TechniqueProgram kIlluminanceProgram;

// Each adds a benchmark of a part of the method, bench_NAME.cpp.
void addEditsBench(Command& bench);
void addEnergyBench(Command& bench);
void addErrorBench(Command& bench);
void addFrameBench(Command& bench);
void addFrontBench(Command& bench);
void addGlossyBench(Command& bench);
void addLinksBench(Command& bench);
void addPredictBench(Command& bench);
void addRegressionBench(Command& bench);
void addRelightBench(Command& bench);
void addSkipBench(Command& bench);
void addStressBench(Command& bench);

/// Of Jendersie, Kuri, Grosch. Real-Time Global Illumination Using Precomputed Illuminance
/// Composition with Chrominance Compression. 2016
std::span<const PaperExperiment> illuminanceExperiments();

} // namespace limn
