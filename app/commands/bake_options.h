// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/setting_options.h"
#include "engine/lighting/precomputed.h"

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace limn {

/// Flags that replace the document's bake settings.
struct BakeOptions {
    GivenSettings given; ///< as setBakeSetting() takes them
    const BakePreset* preset = nullptr;
    int threads = 0; ///< 0: all
};
void addBakeOptions(CLI::App& command, BakeOptions& options);

/// Applies the options, which were checked by the command line, to `settings`.
void applyBakeOptions(const BakeOptions& options, BakeSettings& settings);

/// Whether the setting of that key was given.
bool hasOption(const BakeOptions& options, std::string_view key);

/// Every setting by its key in snake case: numbers, names, and [x, y, z] for a grid.
nlohmann::ordered_json settingsJson(const BakeSettings& settings);

/// Each part's bytes by its id, and "total".
nlohmann::json bytesSummary(const std::vector<LightingCounter>& bytes);

/// {"seconds", "counts", "bytes", "notes", "hash"}.
nlohmann::json bakeSummary(const Precomputed& bake);

} // namespace limn
