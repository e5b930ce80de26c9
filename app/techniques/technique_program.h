// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command.h"
#include "engine/json/json.h"
#include "engine/lighting/technique.h"

#include <span>
#include <string>

namespace limn {

struct PaperExperiment;

/// A technique's own part of the program: what can only be said or measured by someone who knows
/// the method. Everything else reads engine/techniques/technique_table.h.
struct TechniqueProgram {
    const Technique* technique;
    /// What `limn info` says of a file of precomputed data of the technique.
    Json (*describe)(const Precomputed& data);
    /// Prints a value of describe() for people. Returns false, and prints nothing, if the value
    /// needs no form of its own.
    bool (*print)(const std::string& key, const Json& value);
    /// Adds the benchmarks of the method's parts to `limn bench`.
    void (*addBenches)(Command& bench);
    /// Experiments of its papers, for `limn bench papers`; null: none.
    std::span<const PaperExperiment> (*experiments)() = nullptr;
};

std::span<const TechniqueProgram* const> techniquePrograms();

/// The part of a technique that precomputes.
const TechniqueProgram& programOf(const Technique& technique);

} // namespace limn
