// SPDX-License-Identifier: MIT
#pragma once

#include "app/papers/paper_run.h"

#include "engine/core/result.h"

#include <span>

namespace limn {

/// An experiment of a paper. Those on one technique alone are its TechniqueProgram's.
struct PaperExperiment {
    const char* key; ///< on the command line, such as "T2"
    const char* title;
    const char* printedOn; ///< machine of the printed figures
    const char* note;      ///< what ours measures, and where it differs
    const PaperScene* scene;
    Result<void> (*measure)(PaperRun& run);
};

/// Of Bertilsson, von Essen, Hesslow, Jonsson, Moos, Persson. Real-Time Global Illumination in
/// Web-Browsers. 2018
std::span<const PaperExperiment> browserExperiments();

/// Sponza under one fixed sun, as both papers have it.
extern const PaperScene kPaperSponza;

} // namespace limn
