// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/stress/stress_case.h"

#include <string>

namespace limn {

/// Writes a case as one self-contained JSON file: seed, document and meshes. Numbers are exact.
/// Pictures and textures are left out, since generated cases have none.
Result<void> writeCase(const std::string& path, const StressCase& stressCase);

Result<StressCase> readCase(const std::string& path);

} // namespace limn
