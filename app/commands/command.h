// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace limn {

/// Exit status of the process: 0 done, 1 failed (one line on stderr), 2 bad usage.
enum class Exit : int { Done = 0, Failed = 1, Usage = 2 };

/// Action of the chosen command. Every command adds itself to `app` and stores its action in `run`
/// when it is chosen. There is one file per command: app/commands/command_NAME.cpp.
using Run = std::function<Exit()>;

void addBakeCommand(CLI::App& app, Run& run);
void addBenchCommand(CLI::App& app, Run& run);
void addRenderCommand(CLI::App& app, Run& run);
void addReferenceCommand(CLI::App& app, Run& run);
void addCompareCommand(CLI::App& app, Run& run);
void addInfoCommand(CLI::App& app, Run& run);
void addExplainCommand(CLI::App& app, Run& run);
void addExportCommand(CLI::App& app, Run& run);
void addEditCommand(CLI::App& app, Run& run);

/// Prints `limn: message` on stderr and returns Exit::Failed.
Exit failed(const std::string& message);

} // namespace limn
