// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/stress/stress_case.h"

#include <string>

namespace limn {

/// A case as one JSON file that needs no other: seed, document and meshes. Numbers are exact.
/// Pictures and textures are left out: generated cases have none.
Result<void> writeCase(const std::string& path, const StressCase& stressCase);

Result<StressCase> readCase(const std::string& path);

} // namespace limn
