// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "app/commands/setting_options.h"
#include "engine/json/json.h"
#include "engine/lighting/precomputed.h"

#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// Flags that replace the document's bake settings.
struct BakeOptions {
    GivenSettings given; ///< as setBakeSetting() takes them
    const BakePreset* preset = nullptr;
    int threads = 0; ///< 0: all
};
void addBakeOptions(Command& command, BakeOptions& options);

/// Applies the options, which were checked by the command line, to `settings`.
void applyBakeOptions(const BakeOptions& options, BakeSettings& settings);

/// Whether the setting of that key was given.
bool hasOption(const BakeOptions& options, std::string_view key);

/// Every setting by its key in snake case: numbers, names, and [x, y, z] for a grid.
Json settingsJson(const BakeSettings& settings);

/// Each part's bytes by its id, and "total".
Json bytesSummary(const std::vector<LightingCounter>& bytes);

/// {"seconds", "counts", "bytes", "notes", "hash"}.
Json bakeSummary(const Precomputed& bake);

} // namespace limn
