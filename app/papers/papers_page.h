// SPDX-License-Identifier: MIT
#pragma once

#include "app/papers/paper_experiments.h"

#include <string>
#include <vector>

namespace limn {

/// An experiment with its lines, or why it has none.
struct PaperTable {
    const PaperExperiment* experiment;
    std::vector<PaperLine> lines;
    std::string skipped; ///< empty: it was measured
};

/// A page of HTML that needs no other file: a table for each experiment, with charts of error over
/// time where both are measured, and its pictures, which lie in `folder`. `machine` says what
/// measured. Fails if a picture cannot be read.
Result<std::string> papersPage(const std::vector<PaperTable>& tables, const std::string& machine,
                               const std::string& folder);

/// The tables in Markdown, without pictures.
std::string papersMarkdown(const std::vector<PaperTable>& tables, const std::string& machine);

/// All figures, one a row, for CSV and JSON.
Json papersRows(const std::vector<PaperTable>& tables);

} // namespace limn
