// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"

#include <string>

namespace limn {

// Every command adds itself to the program. There is one file per command:
// app/commands/command_NAME.cpp.

void addBakeCommand(Command& program);
void addBenchCommand(Command& program);
void addRenderCommand(Command& program);
void addReferenceCommand(Command& program);
void addCompareCommand(Command& program);
void addInfoCommand(Command& program);
void addLintCommand(Command& program);
void addExplainCommand(Command& program);
void addExportCommand(Command& program);
void addSolveCommand(Command& program);
void addTuneCommand(Command& program);
void addEditCommand(Command& program); ///< adds nothing in a program without Vulkan

} // namespace limn
