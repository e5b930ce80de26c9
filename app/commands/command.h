// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace limn {

/// What the shell sees: 0 done, 1 failed (one line on stderr), 2 bad usage.
enum class Exit : int { Done = 0, Failed = 1, Usage = 2 };

/// Every command adds itself to `app` and stores into `run` what is to be done once it was chosen.
/// One file per command: app/command_NAME.cpp.
using Run = std::function<Exit()>;

void addBakeCommand(CLI::App& app, Run& run);
void addBenchCommand(CLI::App& app, Run& run);
void addRenderCommand(CLI::App& app, Run& run);
void addReferenceCommand(CLI::App& app, Run& run);
void addCompareCommand(CLI::App& app, Run& run);
void addInfoCommand(CLI::App& app, Run& run);
void addEditCommand(CLI::App& app, Run& run);

/// Prints `limn: message` on stderr.
Exit failed(const std::string& message);

} // namespace limn
